// SPDX-License-Identifier: Apache-2.0
#include "train/export/policy_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "envs/step_memory.h"
#include "envs/vec_env.h"
#include "train/policy/agent.h"
#include "train/policy/tile_agent.h"

namespace skein {
namespace {

void AppendRow(const std::vector<float>& rows, int row, int size, std::vector<float>* out) {
  const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(row) * size;
  out->insert(out->end(), begin, begin + size);
}

/// Where `part` is one flight's.
void Append(const PolicyTrace& part, PolicyTrace* whole) {
  whole->observations.insert(whole->observations.end(), part.observations.begin(),
                             part.observations.end());
  whole->actions.insert(whole->actions.end(), part.actions.begin(), part.actions.end());
  whole->begins.insert(whole->begins.end(), part.begins.begin(), part.begins.end());
}

}  // namespace

PolicyTrace RecordTrace(const RecurrentPolicy& policy, const EnvConfig& env, int flights, int steps,
                        std::uint64_t seed) {
  VecEnv flown(policy.EnvironmentFor(env), flights, seed, flights, policy.low_level());
  const Agent agent = Agent::MeanOf(policy);
  agent.CheckFits(flown);
  TileAgent tile(agent, flown, 0, seed);
  StepMemory memory(flights);
  PolicyTrace empty;
  empty.observation_size = policy.observation_size();
  empty.action_size = policy.action_size();
  std::vector<PolicyTrace> parts(static_cast<std::size_t>(flights), empty);
  std::vector<float> begins(parts.size(), 1.0f);
  for (int step = 0; step < steps; ++step) {
    const std::vector<float>& actions = tile.Act();
    for (int i = 0; i < flights; ++i) {
      PolicyTrace& part = parts[static_cast<std::size_t>(i)];
      AppendRow(tile.observation(), i, empty.observation_size, &part.observations);
      AppendRow(actions, i, empty.action_size, &part.actions);
      part.begins.push_back(begins[static_cast<std::size_t>(i)]);
    }
    flown.Step(0, actions.data(), memory.output());
    for (int i = 0; i < flights; ++i) {
      const auto index = static_cast<std::size_t>(i);
      begins[index] = memory.termination[index] == 0 ? 0.0f : 1.0f;
      if (begins[index] > 0) tile.Forget(i);
    }
  }
  PolicyTrace trace = empty;
  for (const PolicyTrace& part : parts) Append(part, &trace);
  for (float& action : trace.actions) action = std::clamp(action, -1.0f, 1.0f);
  return trace;
}

double LargestError(const PolicyTrace& trace, const std::vector<float>& actions) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (actions.size() != trace.actions.size()) return kInfinite;
  double largest = 0;
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const double error = std::abs(static_cast<double>(actions[i]) - trace.actions[i]);
    if (!std::isfinite(error)) return kInfinite;
    largest = std::max(largest, error);
  }
  return largest;
}

}  // namespace skein
