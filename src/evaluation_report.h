#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "envs/env_config.h"
#include "envs/worker_pool.h"
#include "src/program_config.h"
#include "train/evaluate.h"
#include "train/policy.h"

namespace skein {

/// One policy flown both ways on the same fresh episodes.
struct EvaluationReport {
  EvaluationResult deterministic;  ///< with the mean action
  EvaluationResult sampled;        ///< with sampled actions
};

/// Flies `episodes` episodes of each kind; clocks are not staggered.
EvaluationReport EvaluateBothWays(const Policy& policy, const EnvConfig& env, int episodes,
                                  std::uint64_t seed, WorkerPool& pool);

/// Keys: episodes, success_rate, return_mean, time_to_target_mean (s; null if no episode
/// succeeded), terminations (count by kind).
nlohmann::ordered_json ToJson(const EvaluationResult& result);

/// The document of `skein eval --json` and evaluation.json: policy, task, mode, seed, the keys
/// above for the mode asked for, both modes in full, and the environment's settings.
nlohmann::ordered_json ToJson(const EvaluationReport& report, const std::string& policy,
                              const ProgramConfig& config, std::uint64_t seed, bool deterministic);

/// A few lines for people, without a newline at the end.
std::string ToText(const EvaluationReport& report);

}  // namespace skein
