// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "envs/vec_env.h"
#include "train/policy/agent.h"

namespace skein {

/// An agent that flies one tile: its actions for every aircraft, and what it remembers of each. An
/// action depends on the observations of its aircraft and, if it is drawn at random, on (seed,
/// aircraft, policy step).
class TileAgent {
 public:
  /// Agent and environment must outlive it.
  TileAgent(const Agent& agent, const VecEnv& env, int tile, std::uint64_t seed);
  TileAgent(Agent&&, const VecEnv&, int, std::uint64_t) = delete;

  /// Observes the tile and takes a policy step. Row-major [tile count][action_size], not clipped;
  /// valid until the next call.
  const std::vector<float>& Act();

  /// What the latest Act observed, row-major [tile count][observation_size].
  const std::vector<float>& observation() const { return observation_; }

  /// The tile's `index`-th aircraft has begun a new episode: nothing of the old one is remembered.
  void Forget(int index);

 private:
  const Agent& agent_;
  const VecEnv& env_;
  int tile_, count_;
  Agent::Turn turn_;
  std::vector<float> observation_, state_, action_;
};

}  // namespace skein
