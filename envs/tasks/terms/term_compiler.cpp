// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/terms/term_compiler.h"

#include <vector>

#include "envs/tasks/task_errors.h"
#include "envs/tasks/terms/term_registers.h"

namespace skein {
namespace {

using Op = TermOperation;
using T = TermValue;

/// Builds one program out of terms.
class Compiler {
 public:
  Compiler(const TermTaskConfig& config, const TermColumns& columns, const ReferenceUnits& units)
      : config_(config), columns_(columns), units_(units), registers_(config, columns) {}

  /// The number in its unit.
  int Number(const TermNumber& number) {
    return registers_.Scaled(registers_.Value(number.value, number.target),
                             number.per_value / Worth(number.unit, units_));
  }

  /// The normalised error of a target; of a point that along, right of (1) and above (2) its path.
  int NormalisedError(int target, int axis = 0) {
    const TermTarget& of = config_.targets[static_cast<std::size_t>(target)];
    const bool is_point = of.draw_from == TermTarget::Draw::kPoint;
    const int error = is_point ? registers_.Value(T::kPointAlongPath) + axis
                               : registers_.Value(T::kTargetError, target);
    return registers_.Scaled(error, 1 / Worth(of.unit, units_));
  }

  void AddResult(int number) { registers_.AddResult(number); }

  void AddRewards() {
    int sum = -1;
    for (const TermReward& reward : config_.rewards) {
      const int shaped = Shaped(reward);
      const auto weight = static_cast<float>(reward.weight);
      if (sum < 0) {
        sum = registers_.Add({Op::kScale, registers_.New(), shaped, 0, 0, weight});
      } else {
        registers_.Add({Op::kAddWeighted, sum, shaped, 0, 0, weight});
      }
    }
    registers_.AddResult(sum < 0 ? registers_.Value(T::kOne, 0, 0) : sum);
  }

  void AddReached() {
    const int reached = registers_.Add({Op::kAll, registers_.New()});
    if (config_.reached.empty()) {
      registers_.Add({Op::kAndBelow, reached, registers_.Value(T::kOne, 0, 0), 0, 0, 0});
    }
    for (const TermCondition& condition : config_.reached) {
      if (condition.kind == TermCondition::Kind::kBox) {
        registers_.Add({Op::kAndBox, reached, registers_.Value(T::kPointNorth), columns_.last_point,
                        columns_.box});
      } else {
        AndCondition(condition, reached, registers_.TaskColumn(columns_.share));
      }
    }
    registers_.AddResult(reached);
    if (columns_.last_point >= 0) registers_.Add({Op::kRememberPoint, 0, columns_.last_point});
  }

  void AddEnds() {
    const int end = registers_.Add({Op::kConstant, registers_.New()});
    for (const TermEnd& of : config_.ends) {
      const int holds = registers_.Add({Op::kAll, registers_.New()});
      AndCondition(of.condition, holds, registers_.Value(T::kOne));
      registers_.Add({Op::kEndWhere, end, holds, 0, 0, static_cast<float>(of.termination)});
    }
    registers_.AddResult(end);
  }

  TermProgram Take() { return registers_.Take(); }

 private:
  int Shaped(const TermReward& reward) {
    std::vector<int> numbers;
    for (const TermNumber& number : reward.numbers) numbers.push_back(Number(number));
    int x = numbers.back();
    if (numbers.size() > 1) {
      x = registers_.Add({Op::kSquare, registers_.New(), numbers.back()});
      for (std::size_t k = numbers.size() - 1; k-- > 0;) {
        registers_.Add({Op::kAddSquare, x, numbers[k]});
      }
      x = registers_.Add({Op::kRoot, registers_.New(), x});
    }
    x = registers_.Scaled(x, 1 / Worth(reward.unit, units_));
    const double width = reward.width;
    switch (reward.shape) {
      case TermReward::Shape::kAbsolute:
        return registers_.Add({Op::kAbsolute, registers_.New(), x});
      case TermReward::Shape::kSquared:
        return registers_.Add({Op::kSquare, registers_.New(), x});
      case TermReward::Shape::kGaussian:
        return registers_.Add(
            {Op::kGaussian, registers_.New(), x, 0, 0, static_cast<float>(-0.5 / (width * width))});
      case TermReward::Shape::kTolerance: {
        // Without a margin it is a step.
        const double slope = reward.margin > 0 ? 1 / reward.margin : 1e20;
        return registers_.Add({Op::kTolerance, registers_.New(), x, 0, 0, static_cast<float>(width),
                               static_cast<float>(slope)});
      }
      default:
        return x;
    }
  }

  /// `out` and the condition; `share` is what its tolerance is multiplied with.
  void AndCondition(const TermCondition& condition, int out, int share) {
    const TermNumber& number = condition.number;
    const int x = registers_.Value(number.value, number.target);
    const auto limit =
        static_cast<float>(condition.limit / number.per_value * Worth(number.unit, units_));
    switch (condition.kind) {
      case TermCondition::Kind::kWithin:
        registers_.Add({Op::kAndWithin, out, x, share, 0, limit});
        return;
      case TermCondition::Kind::kBelow:
        registers_.Add({Op::kAndBelow, out, x, 0, 0, limit});
        return;
      case TermCondition::Kind::kAbove:
        registers_.Add({Op::kAndAbove, out, x, 0, 0, limit});
        return;
      case TermCondition::Kind::kBeyond:
        registers_.Add({Op::kAndBeyond, out, x, 0, 0, limit});
        return;
      case TermCondition::Kind::kBox:
        return;
    }
  }

  const TermTaskConfig& config_;
  const TermColumns& columns_;
  const ReferenceUnits& units_;
  TermRegisters registers_;
};

}  // namespace

TermPrograms CompileTerms(const TermTaskConfig& config, const TermColumns& columns,
                          const ReferenceUnits& units) {
  Compiler observed(config, columns, units), errors(config, columns, units);
  for (const TermNumber& number : config.observed) observed.AddResult(observed.Number(number));
  for (int target = 0, k = 0;
       k < kNumTaskErrors && target < static_cast<int>(config.targets.size()); ++target) {
    const bool is_point =
        config.targets[static_cast<std::size_t>(target)].draw_from == TermTarget::Draw::kPoint;
    for (int axis = 0; axis < (is_point ? 3 : 1); ++axis, ++k) {
      errors.AddResult(errors.NormalisedError(target, axis));
    }
  }
  Compiler reward(config, columns, units);
  reward.AddRewards();
  reward.AddReached();
  reward.AddEnds();
  return {observed.Take(), errors.Take(), reward.Take()};
}

}  // namespace skein
