// SPDX-License-Identifier: Apache-2.0
// What a task file rewards, when its target counts as reached, and what ends episodes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/nearest_name.h"
#include "envs/tasks/termination.h"
#include "src/config/table_reader.h"
#include "src/config/task_checks.h"
#include "src/config/task_sections.h"
#include "src/config/term_numbers.h"

namespace skein {
namespace {

using Kind = TermCondition::Kind;
using Shape = TermReward::Shape;

constexpr std::array<std::pair<const char*, Shape>, 5> kShapes = {
    {{"linear", Shape::kLinear},
     {"absolute", Shape::kAbsolute},
     {"squared", Shape::kSquared},
     {"gaussian", Shape::kGaussian},
     {"tolerance", Shape::kTolerance}}};

Shape ReadShape(TableReader& own) {
  const std::string asked = own.Text("shape", "absolute");
  std::vector<std::string> names;
  for (const auto& [name, shape] : kShapes) {
    if (asked == name) return shape;
    names.emplace_back(name);
  }
  throw Error(fmt::format("{}: unknown shape {}{}; known: {}", own.Here(), asked,
                          DidYouMean(asked, names), fmt::join(names, ", ")));
}

void ReadWidth(TableReader& own, TermReward* reward) {
  const bool is_wide = reward->shape == Shape::kGaussian || reward->shape == Shape::kTolerance;
  if (!is_wide) return;
  const std::optional<double> width = own.Number("width", kPositiveNumber);
  if (!width) throw Error(own.Here() + ": this shape needs a width");
  reward->width = *width;
  if (reward->shape == Shape::kTolerance) {
    reward->margin = own.Number("margin", {0, kMostOfTaskFile}).value_or(0);
  }
}

/// A condition on a number.
TermCondition ReadCondition(TableReader& own, const TermTaskConfig& task,
                            const std::vector<std::string>& kinds) {
  TermCondition condition;
  const toml::node* const of = own.Find("quantity");
  if (of == nullptr) throw Error(own.Here() + ": a condition needs a quantity");
  condition.number = TermNumbers(task).Read(*of, "quantity", own);
  const std::string kind = OneOf(own, kinds);
  condition.kind = kind == "within"  ? Kind::kWithin
                   : kind == "below" ? Kind::kBelow
                   : kind == "above" ? Kind::kAbove
                                     : Kind::kBeyond;
  const bool is_size = kind == "within" || kind == "beyond";
  condition.limit = own.Number(kind, is_size ? kPositiveNumber : kAnyNumber).value_or(0);
  return condition;
}

TermCondition ReadBox(TableReader& own, const TermTaskConfig& task) {
  if (!task.has_point()) {
    throw Error(own.Here() + ": box_ft is of a target that is a point, and there is none");
  }
  for (const TermCondition& other : task.reached) {
    if (other.kind == Kind::kBox) throw Error(own.Here() + ": there is a box_ft already");
  }
  TermCondition box;
  box.kind = Kind::kBox;
  box.limit = own.Number("box_ft", kPositiveNumber).value_or(0);
  box.number.value = TermValue::kPointNorth;
  return box;
}

}  // namespace

void ReadReward(const toml::table& table, const std::string& source, TermTaskConfig* task) {
  TableReader own(table, source);
  const TermNumbers numbers(*task);
  TermReward reward;
  const toml::node* const of = own.Find("quantity");
  if (of == nullptr) own.RefuseLack({"quantity"}, "a reward needs a quantity");
  if (of->is_array()) {
    for (const toml::node* node : own.Elements("quantity")) {
      reward.numbers.push_back(numbers.Read(*node, "quantity", own));
    }
  } else {
    reward.numbers.push_back(numbers.Read(*of, "quantity", own));
  }
  RequireAtMost(reward.numbers.size(), TermTaskConfig::kMaxOfNorm, own.Here(), "quantities");
  if (reward.numbers.empty()) throw Error(own.At(*of, "quantity") + " must name at least one");
  const std::optional<double> weight = own.Number("weight", kAnyNumber);
  if (!weight) own.RefuseLack({"weight"}, "a reward needs a weight; a cost has one below 0");
  reward.weight = *weight;
  reward.unit = ReadUnit(own, "unit", {});
  reward.shape = ReadShape(own);
  ReadWidth(own, &reward);
  own.RefuseOthers();
  task->rewards.push_back(reward);
}

void ReadReached(const toml::table& table, const std::string& source, TermTaskConfig* task) {
  TableReader own(table, source);
  for (const toml::node* node : own.Elements("conditions")) {
    if (!node->is_table()) throw Error(own.At(*node, "conditions") + " must be tables in braces");
    TableReader reader(*node->as_table(), source);
    task->reached.push_back(reader.Has("box_ft")
                                ? ReadBox(reader, *task)
                                : ReadCondition(reader, *task, {"within", "below", "above"}));
    reader.RefuseOthers();
  }
  RequireAtMost(task->reached.size(), TermTaskConfig::kMaxConditions, own.Here(), "conditions");
  if (task->reached.empty()) own.RefuseLack({"conditions"}, "[reached] needs conditions");
  task->dwell_s = own.Number("dwell_s", {0, 1e6}).value_or(0);
  task->earliest_step = static_cast<int>(own.WholeNumber("earliest_step", 0, 1e9).value_or(0));
  task->training_tolerance_min =
      own.Number("training_tolerance_min", Bounds::PositiveFraction()).value_or(1);
  task->training_tolerance_max = own.Number("training_tolerance_max", {1, 1000}).value_or(1);
  if (task->dwell_s > 0 && task->has_point()) {
    throw Error(own.Here() + ": dwell_s must be 0: a point is passed, not held");
  }
  own.RefuseOthers();
}

void ReadEnd(const toml::table& table, const std::string& source, TermTaskConfig* task) {
  TableReader own(table, source);
  TermEnd end;
  end.condition = ReadCondition(own, *task, {"below", "above", "beyond"});
  const std::string as = own.Text("as", "extreme_state");
  std::vector<std::string> failures;
  for (int k = static_cast<int>(Termination::kExtremeState);
       k <= static_cast<int>(Termination::kOverload); ++k) {
    failures.emplace_back(kTerminationNames[static_cast<std::size_t>(k)]);
    if (as == failures.back()) end.termination = k;
  }
  if (end.termination == 0) {
    throw Error(fmt::format("{}: it cannot end as {}{}; it can as {}", own.Here(), as,
                            DidYouMean(as, failures), fmt::join(failures, ", ")));
  }
  own.RefuseOthers();
  task->ends.push_back(end);
}

}  // namespace skein
