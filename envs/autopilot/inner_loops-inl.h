// SPDX-License-Identifier: Apache-2.0
// The inner loops, as ArduPilot's AP_RollController and AP_PitchController, onto a flight control
// system that takes roll rate and load factor: roll error -> roll rate -> stick, and load factor
// demand -> pitch rate -> stick.

#include "envs/aircraft/aircraft.h"
#include "envs/autopilot/gains.h"

#if defined(SKEIN_ENVS_AUTOPILOT_INNER_LOOPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_INNER_LOOPS_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_INNER_LOOPS_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_INNER_LOOPS_INL_H_
#endif

#include "envs/autopilot/estimator-inl.h"
#include "envs/autopilot/lift-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// Integrators; zeros are the beginning.
template <class T>
struct InnerLoopMemory {
  T roll;         ///< of stick
  T load_factor;  ///< g
};

/// An integrator that stands still while its stick is at a limit.
template <class T>
HWY_INLINE T Integrated(T integrator, T change, T stick, double limit) {
  return Select(IsWithin(stick, 1), Clip(integrator + change, -limit, limit), integrator);
}

/// Roll stick, [-1, 1].
template <class T>
HWY_INLINE T RollStick(const InnerLoopGains& k, const LiftGains& lift, double dt,
                       const FlightEstimate<T>& flight, T roll_demand, InnerLoopMemory<T>& memory) {
  const T error = roll_demand - flight.roll;
  const T turned = Select(IsWithin(roll_demand, lift.max_straight_bank), error, Wrapped(error));
  const T rate = Clip(turned / k.roll_time_s, -k.max_roll_rate, k.max_roll_rate);
  const T rate_error = (rate - flight.p) / k.full_stick_roll_rate;
  const T stick = k.roll_feedforward / k.full_stick_roll_rate * rate +
                  k.roll_proportional * rate_error + memory.roll;
  memory.roll =
      Integrated(memory.roll, dt * k.roll_integral * rate_error, stick, k.roll_integrator_limit);
  return Clip(stick, -1, 1);
}

/// Pitch stick, [-1, 1].
template <class T>
HWY_INLINE T PitchStick(const InnerLoopGains& k, double dt, const FlightEstimate<T>& flight,
                        const Kinematics<T>& motion, T load_factor_demand,
                        InnerLoopMemory<T>& memory) {
  const T speed_per_g = Max(flight.speed, kLeastSpeed) / kGravityFtS2;
  const T rate = (load_factor_demand - motion.cos_pitch * motion.cos_roll) / speed_per_g;
  const T rate_error = (rate - flight.q) * speed_per_g;  // in g
  const T increment =
      load_factor_demand - 1 + k.pitch_proportional * rate_error + memory.load_factor;
  const T stick =
      increment * Select(increment < 0, 1 / k.full_forward_load_factor, 1 / k.full_aft_load_factor);
  memory.load_factor = Integrated(memory.load_factor, dt * k.pitch_integral * rate_error, stick,
                                  k.pitch_integrator_limit);
  return Clip(stick, -1, 1);
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_INNER_LOOPS_INL_H_
