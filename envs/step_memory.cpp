// SPDX-License-Identifier: Apache-2.0
#include "envs/step_memory.h"

#include <cstddef>

namespace skein {
namespace {

std::size_t Times(std::size_t count, int size) { return count * static_cast<std::size_t>(size); }

float* RowOf(std::vector<float>& rows, std::size_t row, int size) {
  return rows.empty() ? nullptr : rows.data() + Times(row, size);
}

}  // namespace

StepMemory::StepMemory(int count, const StepRows& kept)
    : rows(kept),
      reward(static_cast<std::size_t>(count)),
      episode_return(reward.size()),
      final_observation(Times(reward.size(), rows.final_observation)),
      final_privileged(Times(reward.size(), rows.final_privileged)),
      flight_metrics(Times(reward.size(), rows.flight_metrics)),
      termination(reward.size()),
      episode_steps(reward.size()),
      first_clock(reward.size()) {}

StepOutput StepMemory::output(int first) {
  const auto row = static_cast<std::size_t>(first);
  StepOutput output;
  output.reward = reward.data() + row;
  output.termination = termination.data() + row;
  output.episode_return = episode_return.data() + row;
  output.episode_steps = episode_steps.data() + row;
  output.first_clock = first_clock.data() + row;
  output.final_observation = RowOf(final_observation, row, rows.final_observation);
  output.final_privileged = RowOf(final_privileged, row, rows.final_privileged);
  output.flight_metrics = RowOf(flight_metrics, row, rows.flight_metrics);
  return output;
}

}  // namespace skein
