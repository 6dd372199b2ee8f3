// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace skein {

/// What terms can read of a flight, in ft, s, rad and the units of envs/state/state.h.
enum class TermValue : std::uint8_t {
  kOne,
  // Columns of the state.
  kNorth,
  kEast,
  kAltitude,
  kU,
  kV,
  kW,
  kP,
  kQ,
  kR,
  kPower,
  kElevator,
  kAileron,
  kRudder,
  kLeadingEdgeFlap,
  kLoadFactor,
  kLateralLoadFactor,
  kWindNorth,
  kWindEast,
  kWindDown,
  // Attitude.
  kSinRoll,
  kCosRoll,
  kSinPitch,
  kCosPitch,
  kRoll,
  kPitch,
  kYaw,
  kRollRateDeg,
  kPitchRateDeg,
  kYawRateDeg,  ///< deg/s, as recorded flights have them
  // Air.
  kTrueAirspeed,
  kSinAlpha,
  kCosAlpha,
  kSinBeta,
  kCosBeta,
  kAlpha,
  kBeta,
  kEquivalentAirspeed,
  kAirspeedRatio,
  kMach,
  // Over the ground.
  kClimbRate,
  kTerrain,
  kHeightAboveTerrain,
  // The point of the task relative to the aircraft.
  kPointNorth,
  kPointEast,
  kPointUp,
  kPointAhead,
  kPointRight,
  kPointAlongPath,
  kPointRightOfPath,
  kPointAbovePath,
  // Of the attitude that target pitch and yaw make.
  kNoseAngle,
  kAttitudeAngle,
  kTargetError  ///< a target less what it is
};

/// How the name of a number is made.
struct TermName {
  const char* name;
  TermValue value;
  double per_value;  ///< what one of the value is in the name's unit
  bool is_recorded;  ///< a column of recorded flights: targets are compared with it
  bool is_angle;     ///< recorded in degrees
};

/// Names of numbers, but those of targets' errors.
const std::vector<TermName>& TermNames();

/// Whether differences of the value go the short way round.
bool IsWrapped(TermValue value);

/// Whether delayed sensors show the value: what load factors and winds were is not remembered.
bool IsRemembered(TermValue value);
/// Whether it is of the position or the velocity over the ground.
bool IsOverGround(TermValue value);

}  // namespace skein
