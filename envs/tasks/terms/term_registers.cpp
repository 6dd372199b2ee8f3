// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/terms/term_registers.h"

#include <cmath>
#include <string>

#include "base/error.h"

namespace skein {

using Op = TermOperation;
using T = TermValue;

TermRegisters::TermRegisters(const TermTaskConfig& config, const TermColumns& columns)
    : config_(config), columns_(columns) {
  program_.terrain_base = static_cast<float>(config.terrain_base_ft);
  for (const TerrainWave& wave : config.terrain) {
    const auto per = [](double length) {
      return length == 0 ? 0.0f : static_cast<float>(2 * M_PI / length);
    };
    program_.terrain.push_back({static_cast<float>(wave.height_ft), per(wave.wavelength_north_ft),
                                per(wave.wavelength_east_ft), static_cast<float>(wave.phase_rad)});
  }
}

int TermRegisters::New(int count) {
  const int first = program_.num_registers;
  program_.num_registers += count;
  return first;
}

int TermRegisters::Add(const TermInstruction& instruction) {
  program_.instructions.push_back(instruction);
  return instruction.out;
}

int TermRegisters::TaskColumn(int column) {
  const auto [known, is_new] = task_columns_.try_emplace(column, program_.num_registers);
  if (is_new) Add({Op::kTaskColumn, New(), column});
  return known->second;
}

int TermRegisters::Scaled(int number, double factor) {
  const auto by = static_cast<float>(factor);
  if (by == 1) return number;
  const auto [known, is_new] = scaled_.try_emplace({number, by}, program_.num_registers);
  if (is_new) Add({Op::kScale, New(), number, 0, 0, by});
  return known->second;
}

int TermRegisters::FlightColumn(Op operation, int column) {
  return Add({operation, New(), column});
}

int TermRegisters::Value(T value, int target, float constant) {
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

int TermRegisters::OneOf(T value, T first, int count, TermInstruction instruction) {
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

int TermRegisters::Angle(T sine, T cosine) {
  const int a = Value(sine), b = Value(cosine);
  return Add({Op::kAngle, New(), a, b});
}

int TermRegisters::FlightValue(T value) {
  if (value >= T::kU && value <= T::kR) {
    return FlightColumn(Op::kFlightColumn, kU + static_cast<int>(value) - static_cast<int>(T::kU));
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

int TermRegisters::SingleValue(T value) {
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

int TermRegisters::PointValue(T value) {
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

int TermRegisters::TargetError(int target) {
  const TermNumber& quantity = config_.targets[static_cast<std::size_t>(target)].quantity;
  const int asked = TaskColumn(TermColumns::OfTarget(config_, target));
  const int is = Value(quantity.value);
  return Add({IsWrapped(quantity.value) ? Op::kWrappedError : Op::kSubtract, New(), asked, is});
}

TermProgram TermRegisters::Take() {
  if (program_.num_registers > TermProgram::kMaxRegisters) {
    throw Error("task " + config_.name + ": its terms need " +
                std::to_string(program_.num_registers) + " registers, but there are " +
                std::to_string(TermProgram::kMaxRegisters) + ": use fewer of them");
  }
  return std::move(program_);
}

}  // namespace skein
