#pragma once

#include "envs/env_config.h"
#include "envs/worker_pool.h"

namespace skein {

/// How fast aircraft are stepped.
struct SimulatorRate {
  double step_s = 0;                ///< median time of one control step of all aircraft
  double aircraft_steps_per_s = 0;  ///< all aircraft over that median
};

/// Flight control, actuators, engine and one RK4 step of `aircraft` F-16s, spread over altitudes
/// and speeds in trimmed flight; `steps` control steps are timed after a few that are not.
SimulatorRate MeasurePlant(int aircraft, int steps, WorkerPool& pool);

/// The whole environment of `config`: observe, hold a random action for one control step, reward,
/// terminate, reset.
SimulatorRate MeasureEnvironment(const EnvConfig& config, int aircraft, int steps,
                                 WorkerPool& pool);

}  // namespace skein
