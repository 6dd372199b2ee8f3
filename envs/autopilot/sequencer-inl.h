// SPDX-License-Identifier: Apache-2.0
// The order in which Control's targets are brought about: speed and yaw first, the nose last. Nose
// up the aircraft cannot gain speed, nose down it cannot lose it.

#include "envs/aircraft/aircraft.h"
#include "envs/autopilot/gains.h"

#if defined(SKEIN_ENVS_AUTOPILOT_SEQUENCER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_SEQUENCER_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_SEQUENCER_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_SEQUENCER_INL_H_
#endif

#include "envs/autopilot/clock-inl.h"
#include "envs/autopilot/estimator-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

template <class T>
struct SequencerMemory {
  T seconds_at_target;  ///< since the nose was sent to its target; 0 while speed and yaw come first
  T yaw_error;          ///< at the last outer step, rad
};

/// Target minus actual, rad and ft/s.
template <class T>
struct ControlErrorEstimate {
  T pitch, yaw, speed;
};

/// What pitch and throttle are to do now.
template <class T>
struct SequencerDemand {
  T pitch;        ///< rad
  T speed_error;  ///< ft/s
};

/// The speed error that is foreseen for when the nose will have moved to `pitch` at its usual rate:
/// gravity brakes or helps on the way.
template <class T>
HWY_INLINE T ForeseenSpeedError(const SequencerGains& k, const ControlErrorEstimate<T>& error,
                                T pitch) {
  T sine, cosine;
  SinCos(pitch, sine, cosine);
  const T seconds = 0.5 * (Abs(error.pitch) / k.pitch_rate + 1);
  return error.speed + k.speed_lead * kGravityFtS2 * sine * seconds;
}

/// The pitch that serves the speed: nose down to gain it, up to lose it, up near the ground.
template <class T>
HWY_INLINE T PitchForSpeed(const SequencerGains& k, const FlightEstimate<T>& flight,
                           const Kinematics<T>& motion, T speed_error) {
  const T climb = Clip(-k.pitch_per_speed * speed_error, -k.max_speed_pitch, k.max_speed_pitch);
  const T pitch = climb + flight.alpha * motion.cos_roll;
  return Select(flight.altitude < k.low_altitude, Max(pitch, k.low_altitude_pitch), pitch);
}

/// An outer step, every `dt` seconds, of the aircraft whose outer loops run now.
template <class T, class Mask>
HWY_INLINE SequencerDemand<T> Sequence(const SequencerGains& k, double dt,
                                       const FlightEstimate<T>& flight, const Kinematics<T>& motion,
                                       const ControlErrorEstimate<T>& error, const Now<Mask>& now,
                                       SequencerMemory<T>& memory) {
  const T target = flight.pitch + error.pitch;
  if (!k.enabled) return {target, error.speed};

  const T foreseen = ForeseenSpeedError(k, error, target);
  const T yaw_moved = Select(now.begins, 0, Wrapped(error.yaw - memory.yaw_error));
  const auto is_ready =
      And(IsWithin(yaw_moved, k.max_yaw_rate * dt),
          And(IsWithin(error.yaw, k.yaw_tolerance), IsWithin(foreseen, k.speed_tolerance)));
  const auto has_arrived =
      And(IsWithin(error.yaw, k.lost_yaw), IsWithin(error.speed, k.lost_speed));
  const T seconds = memory.seconds_at_target;
  const auto stays = And(seconds > 0, Or(seconds < k.patience_s, has_arrived));
  const auto at_target = Or(stays, And(Not(seconds > 0), is_ready));

  Assign(now.is_outer_step, memory.seconds_at_target, Select(at_target, seconds + dt, 0));
  Assign(now.is_outer_step, memory.yaw_error, error.yaw);
  return {Select(at_target, target, PitchForSpeed(k, flight, motion, foreseen)),
          Select(at_target, error.speed, foreseen)};
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_SEQUENCER_INL_H_
