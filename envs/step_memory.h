// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "envs/step_output.h"

namespace skein {

/// What a StepMemory keeps beside what every step writes: the size of its rows, 0 for none.
struct StepRows {
  int final_observation = 0;  ///< VecEnv::observation_size()
  int final_privileged = 0;   ///< VecEnv::privileged_size(); needs final_observation
  int flight_metrics = 0;     ///< kNumFlightMetrics
};

/// The arrays that a StepOutput points to, of `count` aircraft: a tile's, or all of an environment.
/// Zero at first. Not to be resized.
struct StepMemory {
  /// Of `count` aircraft, with the rows that `kept` gives a size.
  explicit StepMemory(int count, const StepRows& kept = {});

  /// For the tile that begins with the aircraft `first` of these; nothing is checked. Rows that are
  /// not kept are null, and so is the observer.
  StepOutput output(int first = 0);

  StepRows rows;  ///< what is kept, as given
  /// [count], as StepOutput's members of these names are described.
  std::vector<float> reward, episode_return;
  std::vector<float> final_observation, final_privileged, flight_metrics;  ///< row-major; or empty
  std::vector<std::uint8_t> termination;                                   ///< [count]
  std::vector<std::int32_t> episode_steps, first_clock;  ///< [count], control steps
};

}  // namespace skein
