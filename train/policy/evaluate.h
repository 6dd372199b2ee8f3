// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/worker_pool.h"
#include "envs/env_config.h"
#include "envs/flight_metrics.h"
#include "envs/tasks/termination.h"
#include "envs/vec_env.h"
#include "train/measures/flight_measures.h"
#include "train/policy/agent.h"
#include "train/policy/tile_agent.h"

namespace skein {

/// Which episodes are flown, and what of them is measured.
struct EvaluationOptions {
  int episodes = 1000;
  std::uint64_t seed = 0;
  int first_episode = 0;        ///< number of the first of them
  bool flight_metrics = false;  ///< measure how episodes were flown, too
  /// What all of them fly to first, in the order of VecEnv::TargetOf, angles in radians;
  /// where there is nothing, and beyond the end, what is drawn.
  std::vector<std::optional<float>> target = {};
};

/// How one episode went.
struct Episode {
  Termination termination = Termination::kNone;
  float episode_return = 0;
  std::int32_t steps = 0;  ///< control steps
  /// It reached its target, whatever came of holding it; of a mission: it was flown to its end.
  bool succeeded = false;
  std::int32_t reached_step = 0;  ///< control step at which the target counted; 0: it did not
  /// Control step at which the tolerances were entered that were then held for the dwell: without
  /// one reached_step.
  std::int32_t entered_step = 0;
  /// By FlightMetric. NaN unless asked for, and of an episode that ended as non_finite.
  std::array<float, kNumFlightMetrics> metrics{};
  FlightMeasures measures;  ///< if the flight metrics are asked for, or a hold
};

/// One episode per aircraft, by their numbers, so that short episodes are not counted more often
/// than long ones.
struct FlownEpisodes {
  std::vector<Episode> episodes;
  std::uint64_t starts = 0;  ///< HashOfStarts: equal for all agents that fly the same episodes
  bool stopped = false;      ///< the pool was asked to stop: the episodes say nothing
};

/// Means over episodes.
struct EvaluationResult {
  int episodes = 0;
  double success_rate = 0;  ///< of a mission: share flown to the end
  double return_mean = 0;
  /// Until the tolerances were entered that were then held for the dwell, over the episodes that
  /// reached their target; NaN if none did.
  double time_to_target_mean_s = 0;
  /// HoldMetrics::within, mean over the episodes that say it; NaN if none does.
  double hold_within_mean = 0;
  std::array<int, kNumTerminations> terminations{};
};

/// Initial states, targets, noise and wind of the i-th episode depend on (env, options.seed, i)
/// alone, not on the agent. If the pool is stopping, ends within a policy step. Throws Error where
/// the agent does not fit the task. Rates are not compared: `env` should be an
/// Agent::EnvironmentFor, or actions are held for another time than the agent reckons with.
FlownEpisodes FlyEpisodes(const Agent& agent, const EnvConfig& env,
                          const EvaluationOptions& options, WorkerPool& pool);

EvaluationResult Summarise(const std::vector<Episode>& episodes, double control_interval_s);

/// Both.
EvaluationResult Evaluate(const Agent& agent, const EnvConfig& env,
                          const EvaluationOptions& options, WorkerPool& pool);

/// What FlyEpisodes flies: an aircraft for every episode, its first; by the agent's low-level
/// policy if it has one. Throws Error where the agent does not fit the task.
VecEnv MakeEvaluationEnv(const Agent& agent, const EnvConfig& env,
                         const EvaluationOptions& options);
/// And who flies a tile of it; `agent` and `env` must outlive it.
TileAgent MakeEvaluationAgent(const Agent& agent, const VecEnv& env, int tile,
                              const EvaluationOptions& options);
TileAgent MakeEvaluationAgent(Agent&&, const VecEnv&, int, const EvaluationOptions&) = delete;
/// Flies the episodes of such an environment, which nobody has flown yet.
std::vector<Episode> FlyEpisodes(const Agent& agent, VecEnv& env, const EvaluationOptions& options,
                                 WorkerPool& pool);
/// FNV hash of the initial state and target of every episode of such an environment, continued from
/// that of the episodes `before` them.
std::uint64_t HashOfStarts(const VecEnv& env, std::optional<std::uint64_t> before = std::nullopt);

}  // namespace skein
