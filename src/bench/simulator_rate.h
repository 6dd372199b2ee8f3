// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/worker_pool.h"
#include "envs/env_config.h"

namespace skein {

/// How fast aircraft are stepped.
struct SimulatorRate {
  double step_s = 0;                ///< median time of one control step of all aircraft
  double aircraft_steps_per_s = 0;  ///< all aircraft over that median
  std::vector<double> seconds;      ///< of every step, in their order
};

/// One RK4 step (0.02 s, four evaluations of the tables, the equations of motion and the engine) of
/// `aircraft` F-16s, spread over altitudes and speeds in trimmed flight, with flight control and
/// actuators before it or without; `steps` steps are timed after a few that are not.
enum class PlantPart { kRk4, kFlightControlAndRk4 };
SimulatorRate MeasurePlant(PlantPart part, int aircraft, int steps, WorkerPool& pool);

/// The whole environment of each configuration: observe, hold actions that were drawn once for its
/// action_repeat control steps, reward, terminate, reset; `steps` times. Rates are of a control
/// step. They take turns of a few steps, so that what else the machine does slows all alike.
std::vector<SimulatorRate> MeasureEnvironments(const std::vector<EnvConfig>& configs, int aircraft,
                                               int steps, WorkerPool& pool);

}  // namespace skein
