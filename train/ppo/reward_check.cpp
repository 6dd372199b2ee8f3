// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/reward_check.h"

#include <cmath>
#include <cstddef>
#include <string>

#include "base/ends_with.h"
#include "base/error.h"
#include "base/field_list.h"
#include "base/number_text.h"

namespace skein {
namespace {

/// Squares of sums of so many stay below float32's largest number, 3e38.
constexpr float kLargestReward = 1e15F;

bool IsUsable(float reward) { return std::abs(reward) <= kLargestReward; }

/// Of terms of the reward, and of what ends of episodes bring.
bool IsRewardWeight(const std::string& key) {
  const bool is_of_handling = key.rfind("env.reward.", 0) == 0 && !EndsWith(key, "_sharpness");
  return is_of_handling || EndsWith(key, "_weight") || EndsWith(key, "_reward");
}

/// "; KEY = VALUE" of what multiplies them; empty if that is 1.
std::string ScaleOfRewards(const EnvConfig& env) {
  return env.reward_scale == 1 ? "" : "; env.reward_scale = " + ShortestText(env.reward_scale);
}

/// "KEY = VALUE" of the weight that is largest in magnitude, of those that this task reads.
std::string LargestWeight(TrainConfig config) {
  std::string name;
  double largest = 0;
  const auto consider = [&](const std::string& of, double weight) {
    if (!name.empty() && std::abs(weight) <= std::abs(largest)) return;
    name = of;
    largest = weight;
  };
  for (const Field& field : FieldsOf(config)) {
    double* const* weight = std::get_if<double*>(&field.place);
    if (weight == nullptr || !IsRewardWeight(field.key) || !field.IsOf(config.env.task)) continue;
    consider(field.key, **weight);
  }
  if (const auto& task = config.env.term_task; task != nullptr) {
    for (std::size_t i = 0; i < task->rewards.size(); ++i) {
      consider("the task file's [[reward]] number " + std::to_string(i + 1) + ": weight",
               task->rewards[i].weight);
    }
  }
  return name + " = " + ShortestText(largest);
}

}  // namespace

void RequireUsableRewards(const TrainConfig& config, const std::vector<float>& rewards,
                          const std::vector<float>& values) {
  for (std::size_t i = 0; i < rewards.size(); ++i) {
    if (IsUsable(rewards[i]) || !IsUsable(values[i])) continue;
    throw Error("a step's reward is " + RoundedText(rewards[i], kErrorDigits) +
                ": too large to learn from; the largest weight of the reward is " +
                LargestWeight(config) + ScaleOfRewards(config.env));
  }
}

}  // namespace skein
