// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/reward_check.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/field_list.h"
#include "base/number_text.h"

namespace skein {
namespace {

/// Squares of sums of so many stay below float32's largest number, 3e38.
constexpr float kLargestReward = 1e15F;

bool IsUsable(float reward) { return std::abs(reward) <= kLargestReward; }

bool IsRewardWeight(const std::string& key) {
  constexpr char kSuffix[] = "_weight";
  const std::size_t suffix = key.rfind(kSuffix);
  return key.rfind("env.reward", 0) == 0 ||
         (suffix != std::string::npos && suffix + sizeof kSuffix - 1 == key.size());
}

/// "KEY = VALUE" of the largest weight that this task reads.
std::string LargestWeight(TrainConfig config) {
  std::string key;
  double largest = -1;
  for (const Field& field : FieldsOf(config)) {
    double* const* weight = std::get_if<double*>(&field.place);
    if (weight == nullptr || !IsRewardWeight(field.key) || !field.IsOf(config.env.task)) continue;
    if (**weight > largest) {
      largest = **weight;
      key = field.key;
    }
  }
  return key + " = " + ShortestText(largest);
}

}  // namespace

void RequireUsableRewards(const TrainConfig& config, const std::vector<float>& rewards) {
  const auto bad = std::find_if_not(rewards.begin(), rewards.end(), IsUsable);
  if (bad == rewards.end()) return;
  throw Error("a step's reward is " + std::to_string(*bad) +
              ": too large to learn from; the largest weight of the reward is " +
              LargestWeight(config));
}

}  // namespace skein
