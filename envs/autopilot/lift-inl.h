// SPDX-License-Identifier: Apache-2.0
// Where the lift should point: from wanted accelerations across the flight path to bank and load
// factor.

#include <cmath>

#include "envs/aircraft/aircraft.h"
#include "envs/autopilot/gains.h"

#if defined(SKEIN_ENVS_AUTOPILOT_LIFT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_LIFT_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_LIFT_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_LIFT_INL_H_
#endif

#include "envs/autopilot/estimator-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

template <class T>
struct LiftDemand {
  T roll;         ///< rad
  T load_factor;  ///< g
};

/// `lateral` (+ right) and `vertical` (+ up) are wanted changes of the velocity, ft/s^2; holding
/// the path against gravity comes on top. The vertical has precedence. With `over_bank` the lift
/// goes where it is wanted, which may be down: a dive begins by rolling over. Otherwise the wings
/// stay within `max_bank`, and level while the nose is pushed over, since lift that points down
/// would drag it the wrong way round.
template <class T>
HWY_INLINE LiftDemand<T> PointLift(const LiftGains& k, const Kinematics<T>& motion, T lateral,
                                   T vertical) {
  constexpr double kG = kGravityFtS2;
  const double most = k.max_load_factor * kG;
  const T cos_climb = Sqrt(Max(1 - motion.sin_climb * motion.sin_climb, 0));
  const T up =
      kG * cos_climb + Clip(vertical, k.min_vertical_acceleration, k.max_vertical_acceleration);
  const T used = Clip(up, k.min_load_factor * kG, k.vertical_share * most);
  const T left = Sqrt(most * most - used * used);
  const T across = Clip(lateral, -left, left);

  LiftDemand<T> demand;
  const T banked = Clip(ArcTangent(across, Max(up, 0.3 * kG)), -k.max_bank, k.max_bank);
  demand.roll = banked * Clip((up / kG + 0.2) / 0.6, 0, 1);
  if (k.over_bank) {
    const auto nearly_straight =
        And(up > -1.2 * kG, Abs(across) < Select(up > 0, 0.3 * kG, 0.8 * kG));
    demand.roll = Select(nearly_straight, demand.roll, ArcTangent(across, up));
    demand.load_factor = (up * motion.cos_roll + across * motion.sin_roll) / kG;
  } else {
    const T upright = Max(motion.cos_roll, std::cos(Radians(82)));
    demand.load_factor = up / kG * Select(up > 0, 1 / upright, Max(motion.cos_roll, 0.2));
  }
  demand.load_factor = Clip(demand.load_factor, k.min_load_factor, k.max_load_factor);
  return demand;
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_LIFT_INL_H_
