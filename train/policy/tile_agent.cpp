// SPDX-License-Identifier: Apache-2.0
#include "train/policy/tile_agent.h"

#include <algorithm>

namespace skein {

TileAgent::TileAgent(const Agent& agent, const VecEnv& env, int tile, std::uint64_t seed)
    : agent_(agent),
      env_(env),
      tile_(tile),
      count_(env.tile_count(tile)),
      turn_{seed, static_cast<std::uint32_t>(env.first_aircraft() + env.tile_begin(tile)), 0},
      observation_(static_cast<std::size_t>(count_) * env.observation_size()),
      state_(static_cast<std::size_t>(count_) * agent.state_size(), 0.0f),
      action_(static_cast<std::size_t>(count_) * env.action_size()) {}

const std::vector<float>& TileAgent::Act() {
  env_.Observe(tile_, observation_.data());
  agent_.Act(turn_, count_, observation_.data(), state_.data(), action_.data());
  ++turn_.policy_step;
  return action_;
}

void TileAgent::Forget(int index) {
  std::fill_n(state_.begin() + static_cast<std::int64_t>(index) * agent_.state_size(),
              agent_.state_size(), 0.0f);
}

}  // namespace skein
