// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/terms/term_compiler.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "envs/tasks/task_errors.h"

namespace skein {
namespace {

using Op = TermOperation;
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

/// Builds one program. Each value is computed once, where it is first needed.
class Compiler {
 public:
  Compiler(const TermTaskConfig& config, const TermColumns& columns, const ReferenceUnits& units)
      : config_(config), columns_(columns), units_(units) {
    program_.terrain_base = static_cast<float>(config.terrain_base_ft);
    for (const TerrainWave& wave : config.terrain) {
      const auto per = [](double length) {
        return length == 0 ? 0.0f : static_cast<float>(2 * M_PI / length);
      };
      program_.terrain.push_back({static_cast<float>(wave.height_ft), per(wave.wavelength_north_ft),
                                  per(wave.wavelength_east_ft),
                                  static_cast<float>(wave.phase_rad)});
    }
  }

  /// The number in its unit.
  int Number(const TermNumber& number) {
    return Scaled(Value(number.value, number.target),
                  number.per_value / Worth(number.unit, units_));
  }

  /// The normalised error of a target; of a point that along, right of (1) and above (2) its path.
  int NormalisedError(int target, int axis = 0) {
    const TermTarget& of = config_.targets[static_cast<std::size_t>(target)];
    const bool is_point = of.draw_from == TermTarget::Draw::kPoint;
    const int error = is_point ? Value(T::kPointAlongPath) + axis : Value(T::kTargetError, target);
    return Scaled(error, 1 / Worth(of.unit, units_));
  }

  void AddResult(int number) { program_.results.push_back(number); }

  void AddRewards() {
    int sum = -1;
    for (const TermReward& reward : config_.rewards) {
      const int shaped = Shaped(reward);
      const auto weight = static_cast<float>(reward.weight);
      if (sum < 0) {
        sum = Add({Op::kScale, New(), shaped, 0, 0, weight});
      } else {
        Add({Op::kAddWeighted, sum, shaped, 0, 0, weight});
      }
    }
    AddResult(sum < 0 ? Value(T::kOne, 0, 0) : sum);
  }

  void AddReached() {
    const int reached = Add({Op::kAll, New()});
    if (config_.reached.empty()) Add({Op::kAndBelow, reached, Value(T::kOne, 0, 0), 0, 0, 0});
    for (const TermCondition& condition : config_.reached) {
      if (condition.kind == TermCondition::Kind::kBox) {
        Add({Op::kAndBox, reached, Value(T::kPointNorth), columns_.last_point, columns_.box});
      } else {
        AndCondition(condition, reached, TaskColumn(columns_.share));
      }
    }
    AddResult(reached);
    if (columns_.last_point >= 0) Add({Op::kRememberPoint, 0, columns_.last_point});
  }

  void AddEnds() {
    const int end = Add({Op::kConstant, New()});
    for (const TermEnd& of : config_.ends) {
      const int holds = Add({Op::kAll, New()});
      AndCondition(of.condition, holds, Value(T::kOne));
      Add({Op::kEndWhere, end, holds, 0, 0, static_cast<float>(of.termination)});
    }
    AddResult(end);
  }

  TermProgram Take() {
    if (program_.num_registers > TermProgram::kMaxRegisters) {
      throw Error("task " + config_.name + ": its terms need " +
                  std::to_string(program_.num_registers) + " registers, but there are " +
                  std::to_string(TermProgram::kMaxRegisters) + ": use fewer of them");
    }
    return std::move(program_);
  }

 private:
  int New(int count = 1) {
    const int first = program_.num_registers;
    program_.num_registers += count;
    return first;
  }

  int Add(const TermInstruction& instruction) {
    program_.instructions.push_back(instruction);
    return instruction.out;
  }

  int TaskColumn(int column) {
    const auto [known, is_new] = task_columns_.try_emplace(column, program_.num_registers);
    if (is_new) Add({Op::kTaskColumn, New(), column});
    return known->second;
  }

  /// Times a factor, unless that is 1.
  int Scaled(int number, double factor) {
    const auto by = static_cast<float>(factor);
    if (by == 1) return number;
    const auto [known, is_new] = scaled_.try_emplace({number, by}, program_.num_registers);
    if (is_new) Add({Op::kScale, New(), number, 0, 0, by});
    return known->second;
  }

  int FlightColumn(Op operation, int column) { return Add({operation, New(), column}); }

  /// The register of a value, by its place among those that its operation gives.
  int Value(T value, int target = 0, float constant = 1) {
    const auto key = std::make_pair(value, value == T::kTargetError ? target
                                           : value == T::kOne       ? static_cast<int>(constant)
                                                                    : 0);
    const auto known = values_.find(key);
    if (known != values_.end()) return known->second;
    const int number = value == T::kTargetError ? TargetError(target)
                       : value == T::kOne       ? Add({Op::kConstant, New(), 0, 0, 0, constant})
                                                : FlightValue(value);
    return values_[key] = number;
  }

  /// Of an operation that gives `count` values at once, of which `first` is the first.
  int OneOf(T value, T first, int count, TermInstruction instruction) {
    const int offset = static_cast<int>(value) - static_cast<int>(first);
    const auto key = std::make_pair(first, -1);  // of the group, not of its first value
    auto group = values_.find(key);
    if (group == values_.end()) {
      instruction.out = New(count);
      Add(instruction);
      group = values_.emplace(key, instruction.out).first;
    }
    return group->second + offset;
  }

  int Angle(T sine, T cosine) {
    const int a = Value(sine), b = Value(cosine);
    return Add({Op::kAngle, New(), a, b});
  }

  int FlightValue(T value) {
    if (value >= T::kU && value <= T::kR) {
      return FlightColumn(Op::kFlightColumn,
                          kU + static_cast<int>(value) - static_cast<int>(T::kU));
    }
    if (value >= T::kWindNorth && value <= T::kWindDown) {
      return FlightColumn(Op::kWindColumn,
                          kWindNorth + static_cast<int>(value) - static_cast<int>(T::kWindNorth));
    }
    if (value >= T::kElevator && value <= T::kLateralLoadFactor) {
      return FlightColumn(Op::kFlightColumn,
                          kElevator + static_cast<int>(value) - static_cast<int>(T::kElevator));
    }
    if (value >= T::kSinRoll && value <= T::kCosPitch) {
      return OneOf(value, T::kSinRoll, 4, {Op::kAttitude});
    }
    if (value >= T::kTrueAirspeed && value <= T::kCosBeta) {
      return OneOf(value, T::kTrueAirspeed, 5, {Op::kAirVelocity});
    }
    if (value >= T::kEquivalentAirspeed && value <= T::kMach) {
      const int speed = Value(T::kTrueAirspeed);
      return OneOf(value, T::kEquivalentAirspeed, 3, {Op::kAirData, 0, speed});
    }
    if (value >= T::kRollRateDeg && value <= T::kYawRateDeg) {
      const int rate =
          static_cast<int>(T::kP) + static_cast<int>(value) - static_cast<int>(T::kRollRateDeg);
      return Scaled(Value(static_cast<T>(rate)), kDegPerRad);
    }
    if (value >= T::kPointNorth && value <= T::kPointAbovePath) return PointValue(value);
    return SingleValue(value);
  }

  int SingleValue(T value) {
    switch (value) {
      case T::kNorth:
        return FlightColumn(Op::kFlightColumn, kNorth);
      case T::kEast:
        return FlightColumn(Op::kFlightColumn, kEast);
      case T::kAltitude:
        return FlightColumn(Op::kMinusColumn, kDown);
      case T::kPower:
        return FlightColumn(Op::kFlightColumn, kPower);
      case T::kRoll:
        return Add({Op::kRoll, New()});
      case T::kPitch:
        return Add({Op::kPitch, New()});
      case T::kYaw:
        return Add({Op::kYaw, New()});
      case T::kAlpha:
        return Angle(T::kSinAlpha, T::kCosAlpha);
      case T::kBeta:
        return Angle(T::kSinBeta, T::kCosBeta);
      case T::kClimbRate:
        return Add({Op::kClimbRate, New()});
      case T::kTerrain: {
        const int north = Value(T::kNorth), east = Value(T::kEast);
        return Add({Op::kTerrain, New(), north, east});
      }
      case T::kHeightAboveTerrain: {
        const int altitude = Value(T::kAltitude), terrain = Value(T::kTerrain);
        return Add({Op::kSubtract, New(), altitude, terrain});
      }
      case T::kNoseAngle:
        return Add({Op::kNoseAngle, New(), columns_.attitude});
      case T::kAttitudeAngle:
        return Add({Op::kAttitudeAngle, New(), columns_.attitude});
      default:
        throw Error("task " + config_.name + ": a term reads what has no operation");
    }
  }

  int PointValue(T value) {
    if (value <= T::kPointUp) {
      // Side by side, as operations on a point take them.
      const auto key = std::make_pair(T::kPointNorth, -1);
      auto group = values_.find(key);
      if (group == values_.end()) {
        const int axes[] = {Value(T::kNorth), Value(T::kEast), Value(T::kAltitude)};
        const int targets[] = {TaskColumn(0), TaskColumn(1), TaskColumn(2)};
        const int first = New(3);
        for (int k = 0; k < 3; ++k) Add({Op::kSubtract, first + k, targets[k], axes[k]});
        group = values_.emplace(key, first).first;
      }
      return group->second + static_cast<int>(value) - static_cast<int>(T::kPointNorth);
    }
    const int north = Value(T::kPointNorth);
    if (value <= T::kPointRight) {
      return OneOf(value, T::kPointAhead, 2, {Op::kPointHeading, 0, north, north + 1});
    }
    return OneOf(value, T::kPointAlongPath, 3, {Op::kPointPath, 0, north, north + 1, north + 2});
  }

  int TargetError(int target) {
    const TermNumber& quantity = config_.targets[static_cast<std::size_t>(target)].quantity;
    const int asked = TaskColumn(TermColumns::OfTarget(config_, target));
    const int is = Value(quantity.value);
    return Add({IsWrapped(quantity.value) ? Op::kWrappedError : Op::kSubtract, New(), asked, is});
  }

  int Shaped(const TermReward& reward) {
    std::vector<int> numbers;
    for (const TermNumber& number : reward.numbers) numbers.push_back(Number(number));
    int x = numbers.back();
    if (numbers.size() > 1) {
      x = Add({Op::kSquare, New(), numbers.back()});
      for (std::size_t k = numbers.size() - 1; k-- > 0;) Add({Op::kAddSquare, x, numbers[k]});
      x = Add({Op::kRoot, New(), x});
    }
    x = Scaled(x, 1 / Worth(reward.unit, units_));
    const double width = reward.width;
    switch (reward.shape) {
      case TermReward::Shape::kAbsolute:
        return Add({Op::kAbsolute, New(), x});
      case TermReward::Shape::kSquared:
        return Add({Op::kSquare, New(), x});
      case TermReward::Shape::kGaussian:
        return Add({Op::kGaussian, New(), x, 0, 0, static_cast<float>(-0.5 / (width * width))});
      case TermReward::Shape::kTolerance: {
        // Without a margin it is a step.
        const double slope = reward.margin > 0 ? 1 / reward.margin : 1e20;
        return Add(
            {Op::kTolerance, New(), x, 0, 0, static_cast<float>(width), static_cast<float>(slope)});
      }
      default:
        return x;
    }
  }

  /// `out` and the condition; `share` is what its tolerance is multiplied with.
  void AndCondition(const TermCondition& condition, int out, int share) {
    const TermNumber& number = condition.number;
    const int x = Value(number.value, number.target);
    const auto limit =
        static_cast<float>(condition.limit / number.per_value * Worth(number.unit, units_));
    switch (condition.kind) {
      case TermCondition::Kind::kWithin:
        Add({Op::kAndWithin, out, x, share, 0, limit});
        return;
      case TermCondition::Kind::kBelow:
        Add({Op::kAndBelow, out, x, 0, 0, limit});
        return;
      case TermCondition::Kind::kAbove:
        Add({Op::kAndAbove, out, x, 0, 0, limit});
        return;
      case TermCondition::Kind::kBeyond:
        Add({Op::kAndBeyond, out, x, 0, 0, limit});
        return;
      case TermCondition::Kind::kBox:
        return;
    }
  }

  const TermTaskConfig& config_;
  const TermColumns& columns_;
  const ReferenceUnits& units_;
  TermProgram program_;
  std::map<std::pair<T, int>, int> values_;
  std::map<int, int> task_columns_;
  std::map<std::pair<int, float>, int> scaled_;
};

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
