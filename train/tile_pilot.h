#pragma once

#include <cstdint>
#include <vector>

#include "envs/vec_env.h"
#include "train/policy.h"

namespace skein {

/// A policy at the controls of one tile: it observes, remembers and decides for every aircraft.
/// What it decides for one depends on the observations of that aircraft and, if actions are
/// sampled, on (seed, aircraft, decision).
class TilePilot {
 public:
  /// `seed` is that of sampled actions; with `deterministic` the mean action is flown. Policy and
  /// environment must outlive the pilot.
  TilePilot(const Policy& policy, const VecEnv& env, int tile, std::uint64_t seed,
            bool deterministic);

  /// Observes the tile and decides. Row-major [tile count][action_size], not clipped; valid until
  /// the next call.
  const std::vector<float>& Decide();

  /// The tile's `index`-th aircraft has begun a new episode: nothing of the old one is remembered.
  void Forget(int index);

 private:
  const Policy& policy_;
  const VecEnv& env_;
  int tile_, begin_, count_;
  std::uint64_t seed_;
  bool deterministic_;
  std::uint32_t decision_ = 0;
  std::vector<float> observation_, state_, action_, noise_, log_std_;
  std::vector<std::uint32_t> decision_low_, decision_high_;
};

}  // namespace skein
