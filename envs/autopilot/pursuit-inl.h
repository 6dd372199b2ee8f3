// SPDX-License-Identifier: Apache-2.0
// Flying to a point: L1 guidance in three dimensions, towards a target ahead of the aircraft.

#include "envs/autopilot/gains.h"

#if defined(SKEIN_ENVS_AUTOPILOT_PURSUIT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_PURSUIT_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_PURSUIT_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_PURSUIT_INL_H_
#endif

#include "envs/autopilot/estimator-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// A point relative to the aircraft in heading axes, ft, and the wind in them, ft/s.
template <class T>
struct TargetEstimate {
  T ahead, right, up;
  T wind_ahead, wind_right;
};

template <class T>
struct Acceleration {
  T lateral, vertical;  ///< across the velocity, + right and + up, ft/s^2
};

/// One step of the estimate of a point at rest. Heading axes turn with the aircraft's yaw; what the
/// airspeed does not explain of the point's motion is wind.
template <class T, class Mask>
HWY_INLINE void EstimateTarget(const EstimatorGains& k, double dt, const Kinematics<T>& motion,
                               T ahead, T right, T up, Mask begins, TargetEstimate<T>& target) {
  const T turned = dt * motion.yaw_rate;
  const T old_ahead = target.ahead, old_wind_ahead = target.wind_ahead;
  const T moved_ahead = turned * target.right - dt * (motion.ahead + target.wind_ahead);
  const T moved_right = -turned * old_ahead - dt * (motion.right + target.wind_right);
  const double wind_share = k.wind * k.wind * dt;
  const T missing_ahead = Select(begins, 0, ahead - (target.ahead + moved_ahead));
  const T missing_right = Select(begins, 0, right - (target.right + moved_right));
  target.ahead = Corrected(target.ahead, moved_ahead, ahead, k.position * dt, begins);
  target.right = Corrected(target.right, moved_right, right, k.position * dt, begins);
  target.up = Corrected(target.up, -dt * motion.up, up, k.position * dt, begins);
  target.wind_ahead = target.wind_ahead + turned * target.wind_right - wind_share * missing_ahead;
  target.wind_right = target.wind_right - turned * old_wind_ahead - wind_share * missing_right;
}

/// 2 V^2 / L1 sin(eta) towards the line of sight, eta the angle between velocity and target; as at
/// 90 deg where the target is behind. L1 is the distance within limits. On arrival, nothing.
template <class T>
HWY_INLINE Acceleration<T> Pursue(const PursuitGains& k, const Kinematics<T>& motion,
                                  const TargetEstimate<T>& target) {
  const T v_ahead = motion.ahead + target.wind_ahead, v_right = motion.right + target.wind_right;
  const T level_squared = v_ahead * v_ahead + v_right * v_right;
  const T level = Sqrt(Max(level_squared, 1));
  const T speed = Sqrt(Max(level_squared + motion.up * motion.up, kLeastSpeed * kLeastSpeed));
  const T distance = Sqrt(
      Max(target.ahead * target.ahead + target.right * target.right + target.up * target.up, 1));

  // The line of sight in the axes of the velocity: along it, to its right, up from it.
  const T level_along = (v_ahead * target.ahead + v_right * target.right) / level;
  const T right = (v_ahead * target.right - v_right * target.ahead) / (level * distance);
  const T up = (level * target.up - motion.up * level_along) / (speed * distance);
  const T along = (level * level_along + motion.up * target.up) / (speed * distance);

  const T sine = Sqrt(Max(right * right + up * up, 1e-12));
  const T strength = Select(along < 0, 1 / sine, 1);
  const T length = Clip(distance, k.min_length, k.max_length);
  const auto arrives = And(distance<k.arrival_distance, along> 0);
  const T per_sine = Select(arrives, 0, 2 * speed * speed / length * strength);
  return {per_sine * right, per_sine * up};
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_PURSUIT_INL_H_
