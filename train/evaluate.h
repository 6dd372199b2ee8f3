#pragma once

#include <array>
#include <cstdint>

#include "envs/env_config.h"
#include "envs/termination.h"
#include "envs/vec_env.h"
#include "envs/worker_pool.h"
#include "train/policy.h"
#include "train/tile_pilot.h"

namespace skein {

struct EvaluationOptions {
  int episodes = 1000;
  std::uint64_t seed = 0;
  bool deterministic = true;  ///< the mean action; false samples from the policy
};

/// Over exactly one episode per aircraft, so that short episodes are not counted more often than
/// long ones.
struct EvaluationResult {
  int episodes = 0;
  double success_rate = 0;
  double return_mean = 0;
  double time_to_target_mean_s = 0;  ///< over successful episodes; NaN if none
  std::array<int, kNumTerminations> terminations{};
};

/// If the pool is stopping, ends within a decision, and the result says nothing.
EvaluationResult Evaluate(const Policy& policy, const EnvConfig& env,
                          const EvaluationOptions& options, WorkerPool& pool);

/// What Evaluate flies: an aircraft for every episode, its first; by the policy's controller if it
/// has one. Throws Error where the policy does not fit the task.
VecEnv MakeEvaluationEnv(const Policy& policy, const EnvConfig& env,
                         const EvaluationOptions& options);
/// And who flies a tile of it.
TilePilot MakeEvaluationPilot(const Policy& policy, const VecEnv& env, int tile,
                              const EvaluationOptions& options);

}  // namespace skein
