// SPDX-License-Identifier: Apache-2.0
// An autopilot for each task, of the parts beside this file. Law<T>::Act is one control step of one
// aircraft (T = double) or of a vector of them (T = Lanes): it reads an observation, updates the
// memory, in which zeros are the beginning of an episode, and writes throttle, pitch, roll and yaw.

#include "envs/actions.h"
#include "envs/aircraft/f16_units.h"
#include "envs/autopilot/gains.h"

#if defined(SKEIN_ENVS_AUTOPILOT_LAWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_LAWS_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_LAWS_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_LAWS_INL_H_
#endif

#include "envs/autopilot/inner_loops-inl.h"
#include "envs/autopilot/l1-inl.h"
#include "envs/autopilot/lift-inl.h"
#include "envs/autopilot/pursuit-inl.h"
#include "envs/autopilot/sequencer-inl.h"
#include "envs/autopilot/tecs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// What autopilots of all tasks remember.
template <class T>
struct CommonMemory {
  T clock;
  FlightEstimate<T> flight;
  TecsMemory<T> tecs;
  InnerLoopMemory<T> inner_loop;
};

/// The actions that bring about `lateral` and `vertical` accelerations, ft/s^2, and the throttle of
/// the last outer step. The flight control system coordinates turns: the pedals stay centred.
template <class T>
HWY_INLINE void StickActions(const AutopilotGains& k, double dt, const Kinematics<T>& motion,
                             T lateral, T vertical, CommonMemory<T>& memory, T* action) {
  const LiftDemand<T> lift = PointLift(k.lift, motion, lateral, vertical);
  action[0] = 2 * memory.tecs.throttle - 1;
  action[1] =
      PitchStick(k.inner_loop, dt, memory.flight, motion, lift.load_factor, memory.inner_loop);
  action[2] = RollStick(k.inner_loop, k.lift, dt, memory.flight, lift.roll, memory.inner_loop);
  action[3] = 0;
}

/// The estimate of a task's speed error, target minus actual, ft/s: it changes as the speed does.
template <class T, class Mask>
HWY_INLINE void EstimateSpeedError(const EstimatorGains& k, double dt,
                                   const FlightEstimate<T>& flight, T measured, Mask begins,
                                   T& speed_error) {
  speed_error = Corrected(speed_error, -dt * flight.acceleration, measured * kSpeedUnitFtS,
                          k.damping * k.speed * dt, begins);
}

template <class T>
struct HeadingLaw {
  struct Memory {
    CommonMemory<T> common;
    T altitude_error, yaw_error, speed_error;  ///< estimates, target minus actual, ft, rad, ft/s
    T lateral;                                 ///< ft/s^2, between outer steps
    T climb;                                   ///< rad, between outer steps
  };

  static HWY_INLINE void Act(const AutopilotGains& k, const AutopilotTiming& timing,
                             const T* observation, Memory& memory, T* action) {
    const double dt = timing.dt;
    const auto now = Tick(timing.control_steps_per_outer_step, memory.common.clock);
    const Measurement<T> measured = MeasurementOf(observation);
    FlightEstimate<T>& flight = memory.common.flight;
    const Kinematics<T> motion = Estimate(k.estimator, dt, measured, now.begins, flight);
    memory.altitude_error =
        Corrected(memory.altitude_error, -dt * motion.up, measured.errors[0] * kAltitudeErrorUnitFt,
                  k.estimator.altitude * dt, now.begins);
    memory.yaw_error = CorrectedAngle(memory.yaw_error, -dt * motion.yaw_rate, measured.errors[1],
                                      k.estimator.attitude * dt, now.begins);
    EstimateSpeedError(k.estimator, dt, flight, measured.errors[2], now.begins, memory.speed_error);

    const T climb_rate = ClimbRateFor(k.tecs, memory.altitude_error, flight.speed);
    Assign(now.is_outer_step, memory.lateral, TurnToHeading(k.l1, memory.yaw_error, flight.speed));
    Assign(now.is_outer_step, memory.climb, ArcSine(climb_rate / Max(flight.speed, kLeastSpeed)));
    UpdateThrottle(k.tecs, timing.outer_dt(), flight, motion,
                   {memory.speed_error, memory.altitude_error, climb_rate}, now,
                   memory.common.tecs);

    const T vertical = flight.speed * (memory.climb - motion.climb) / k.lift.flight_path_time_s;
    StickActions(k, dt, motion, memory.lateral, vertical, memory.common, action);
  }
};

template <class T>
struct ControlLaw {
  struct Memory {
    CommonMemory<T> common;
    ControlErrorEstimate<T> error;
    SequencerMemory<T> sequencer;
    T lateral;  ///< ft/s^2, between outer steps
    T pitch;    ///< rad, between outer steps
  };

  static HWY_INLINE void Act(const AutopilotGains& k, const AutopilotTiming& timing,
                             const T* observation, Memory& memory, T* action) {
    const double dt = timing.dt;
    const auto now = Tick(timing.control_steps_per_outer_step, memory.common.clock);
    const Measurement<T> measured = MeasurementOf(observation);
    FlightEstimate<T>& flight = memory.common.flight;
    const Kinematics<T> motion = Estimate(k.estimator, dt, measured, now.begins, flight);
    memory.error.pitch = Corrected(memory.error.pitch, -dt * motion.pitch_rate, measured.errors[0],
                                   k.estimator.attitude * dt, now.begins);
    memory.error.yaw = CorrectedAngle(memory.error.yaw, -dt * motion.yaw_rate, measured.errors[1],
                                      k.estimator.attitude * dt, now.begins);
    EstimateSpeedError(k.estimator, dt, flight, measured.errors[2], now.begins, memory.error.speed);

    const SequencerDemand<T> demand = Sequence(k.sequencer, timing.outer_dt(), flight, motion,
                                               memory.error, now, memory.sequencer);
    Assign(now.is_outer_step, memory.lateral, TurnToHeading(k.l1, memory.error.yaw, flight.speed));
    Assign(now.is_outer_step, memory.pitch, demand.pitch);
    // Height is no target: the energy that is wanted is kinetic.
    UpdateThrottle(k.tecs, timing.outer_dt(), flight, motion, {demand.speed_error, 0, motion.up},
                   now, memory.common.tecs);

    const T vertical = flight.speed * (memory.pitch - flight.pitch) / k.lift.pitch_time_s;
    StickActions(k, dt, motion, memory.lateral, vertical, memory.common, action);
  }
};

template <class T>
struct TrackingLaw {
  struct Memory {
    CommonMemory<T> common;
    TargetEstimate<T> target;
    T held_speed;  ///< ft/s
  };

  static HWY_INLINE void Act(const AutopilotGains& k, const AutopilotTiming& timing,
                             const T* observation, Memory& memory, T* action) {
    const double dt = timing.dt;
    const auto now = Tick(timing.control_steps_per_outer_step, memory.common.clock);
    const Measurement<T> measured = MeasurementOf(observation);
    FlightEstimate<T>& flight = memory.common.flight;
    const Kinematics<T> motion = Estimate(k.estimator, dt, measured, now.begins, flight);
    EstimateTarget(k.estimator, dt, motion, measured.errors[0] * kAltitudeErrorUnitFt,
                   measured.errors[1] * kAltitudeErrorUnitFt,
                   measured.errors[2] * kAltitudeErrorUnitFt, now.begins, memory.target);
    Assign(now.begins, memory.held_speed, flight.speed);

    UpdateThrottle(k.tecs, timing.outer_dt(), flight, motion,
                   {memory.held_speed - flight.speed, 0, motion.up}, now, memory.common.tecs);
    const Acceleration<T> wanted = Pursue(k.pursuit, motion, memory.target);
    StickActions(k, dt, motion, wanted.lateral, wanted.vertical, memory.common, action);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_LAWS_INL_H_
