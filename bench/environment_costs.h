// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/plant_parts.h"
#include "bench/report.h"

namespace skein::bench {

// What the parts of an environment's control step do for one aircraft, counted in their kernels;
// see Cost for the rules.

/// envs/kernels/flight_control_kernel.cpp, mode full.
inline constexpr Cost kFlightControlCost{57             // sensors
                                             + 11       // sticks, throttle
                                             + 2        // sensed alpha
                                             + 14 * 5   // filters
                                             + 52       // pitch
                                             + 37       // roll
                                             + 30       // yaw
                                             + 10       // flap
                                             + 4 * 9,   // surfaces
                                         4 * (9         // sensors
                                              + 4       // sticks, throttle
                                              + 14      // filters
                                              + 2 + 3   // integrators, trims
                                              + 4)      // surfaces
                                             + 4 * 8};  // density's cubic

/// envs/tasks/heading.cpp and envs/tasks/reward_and_termination.cpp.
inline constexpr Cost kJudgeCost{67 + 8     // errors; reward
                                     + 82   // is everything finite?
                                     + 19   // limits
                                     + 4,   // sums of rewards
                                 4 * (12    // task: targets, position, attitude, velocity, clock
                                      + 4   // clock, endings, verdict
                                      + 39  // every column
                                      + 5 + 2)};  // limits; sums of rewards

/// The same and envs/tasks/observation.cpp, without noise.
inline constexpr Cost kObserveCost{67 + 2          // errors
                                       + 29        // attitude
                                       + 51        // air data
                                       + 5,        // controls
                                   4 * (11         // errors
                                        + 19       // state
                                        + 2 * 24)  // to rows
                                       + 4 * 8};   // density's cubic

/// A control step of the environment: flight control, actuators, RK4 with engine, reward,
/// terminations, observation. Noise and the few episodes that begin are not in it.
inline constexpr Cost kControlStepCost{
    kFlightControlCost.flops + kRk4Cost.flops + kJudgeCost.flops + kObserveCost.flops,
    kFlightControlCost.bytes_loaded + kRk4Cost.bytes_loaded + kJudgeCost.bytes_loaded +
        kObserveCost.bytes_loaded};

}  // namespace skein::bench
