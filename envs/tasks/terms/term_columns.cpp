// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/terms/term_columns.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace skein {
namespace {

using T = TermValue;

bool Reads(const TermTaskConfig& config, T first, T last) {
  const auto is = [&](const TermNumber& number) {
    return number.value >= first && number.value <= last;
  };
  const auto any = [&](const std::vector<TermNumber>& numbers) {
    return std::any_of(numbers.begin(), numbers.end(), is);
  };
  return any(config.observed) ||
         std::any_of(config.rewards.begin(), config.rewards.end(),
                     [&](const TermReward& reward) { return any(reward.numbers); }) ||
         std::any_of(config.reached.begin(), config.reached.end(),
                     [&](const TermCondition& condition) { return is(condition.number); }) ||
         std::any_of(config.ends.begin(), config.ends.end(),
                     [&](const TermEnd& end) { return is(end.condition.number); });
}

bool HasBox(const TermTaskConfig& config) {
  return std::any_of(
      config.reached.begin(), config.reached.end(),
      [](const TermCondition& condition) { return condition.kind == TermCondition::Kind::kBox; });
}

}  // namespace

TermColumns::TermColumns(const TermTaskConfig& config) {
  num_targets = OfTarget(config, static_cast<int>(config.targets.size()));
  count = num_targets;
  const auto take = [this](int columns) { return std::exchange(count, count + columns); };
  if (Reads(config, T::kNoseAngle, T::kAttitudeAngle)) attitude = take(4);
  if (HasBox(config)) last_point = take(3);
  share = take(1);
  if (HasBox(config)) box = take(1);
}

int TermColumns::OfTarget(const TermTaskConfig& config, int index) {
  // A point is the first target, and has two columns more.
  return config.has_point() && index > 0 ? index + 2 : index;
}

double Worth(const TermUnit& unit, const ReferenceUnits& units) {
  switch (unit.reference) {
    case ReferenceUnit::kAltitudeError:
      return units.altitude_error_ft * unit.number;
    case ReferenceUnit::kAltitude:
      return units.altitude_ft * unit.number;
    case ReferenceUnit::kSpeed:
      return units.speed_ft_s * unit.number;
    default:
      return unit.number;
  }
}

}  // namespace skein
