// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/terms/term_values.h"

#include "envs/aircraft/aircraft.h"

namespace skein {

const std::vector<TermName>& TermNames() {
  using T = TermValue;
  constexpr double kDeg = kDegPerRad;
  static const std::vector<TermName> names = {
      {"one", T::kOne, 1, false, false},
      {"north_ft", T::kNorth, 1, true, false},
      {"east_ft", T::kEast, 1, true, false},
      {"altitude_ft", T::kAltitude, 1, true, false},
      {"u_fps", T::kU, 1, true, false},
      {"v_fps", T::kV, 1, true, false},
      {"w_fps", T::kW, 1, true, false},
      {"roll_deg", T::kRoll, kDeg, true, true},
      {"roll_rad", T::kRoll, 1, false, true},
      {"pitch_deg", T::kPitch, kDeg, true, true},
      {"pitch_rad", T::kPitch, 1, false, true},
      {"yaw_deg", T::kYaw, kDeg, true, true},
      {"yaw_rad", T::kYaw, 1, false, true},
      {"p_deg_s", T::kRollRateDeg, 1, true, false},
      {"q_deg_s", T::kPitchRateDeg, 1, true, false},
      {"r_deg_s", T::kYawRateDeg, 1, true, false},
      {"p_rad_s", T::kP, 1, false, false},
      {"q_rad_s", T::kQ, 1, false, false},
      {"r_rad_s", T::kR, 1, false, false},
      {"alpha_deg", T::kAlpha, kDeg, true, true},
      {"alpha_rad", T::kAlpha, 1, false, true},
      {"beta_deg", T::kBeta, kDeg, true, true},
      {"beta_rad", T::kBeta, 1, false, true},
      {"true_airspeed_fps", T::kTrueAirspeed, 1, true, false},
      {"equivalent_airspeed_fps", T::kEquivalentAirspeed, 1, false, false},
      {"airspeed_ratio", T::kAirspeedRatio, 1, false, false},
      {"mach", T::kMach, 1, true, false},
      {"climb_rate_fps", T::kClimbRate, 1, false, false},
      {"wind_north_fps", T::kWindNorth, 1, true, false},
      {"wind_east_fps", T::kWindEast, 1, true, false},
      {"wind_down_fps", T::kWindDown, 1, true, false},
      {"load_factor_g", T::kLoadFactor, 1, true, false},
      {"lateral_load_factor_g", T::kLateralLoadFactor, 1, true, false},
      {"power", T::kPower, 1, true, false},
      {"elevator_deg", T::kElevator, 1, true, false},
      {"aileron_deg", T::kAileron, 1, true, false},
      {"rudder_deg", T::kRudder, 1, true, false},
      {"leading_edge_flap_deg", T::kLeadingEdgeFlap, 1, true, false},
      {"sin_roll", T::kSinRoll, 1, false, false},
      {"cos_roll", T::kCosRoll, 1, false, false},
      {"sin_pitch", T::kSinPitch, 1, false, false},
      {"cos_pitch", T::kCosPitch, 1, false, false},
      {"sin_alpha", T::kSinAlpha, 1, false, false},
      {"cos_alpha", T::kCosAlpha, 1, false, false},
      {"sin_beta", T::kSinBeta, 1, false, false},
      {"cos_beta", T::kCosBeta, 1, false, false},
      {"terrain_ft", T::kTerrain, 1, true, false},
      {"height_above_terrain_ft", T::kHeightAboveTerrain, 1, true, false},
      {"point_north_ft", T::kPointNorth, 1, false, false},
      {"point_east_ft", T::kPointEast, 1, false, false},
      {"point_up_ft", T::kPointUp, 1, false, false},
      {"point_ahead_ft", T::kPointAhead, 1, false, false},
      {"point_right_ft", T::kPointRight, 1, false, false},
      {"point_along_path_ft", T::kPointAlongPath, 1, false, false},
      {"point_right_of_path_ft", T::kPointRightOfPath, 1, false, false},
      {"point_above_path_ft", T::kPointAbovePath, 1, false, false},
      {"nose_angle_rad", T::kNoseAngle, 1, false, true},
      {"nose_angle_deg", T::kNoseAngle, kDeg, false, true},
      {"attitude_angle_rad", T::kAttitudeAngle, 1, false, true},
      {"attitude_angle_deg", T::kAttitudeAngle, kDeg, false, true}};
  return names;
}

bool IsWrapped(TermValue value) {
  return value == TermValue::kYaw || value == TermValue::kRoll || value == TermValue::kAlpha;
}

bool IsRemembered(TermValue value) {
  switch (value) {
    case TermValue::kLoadFactor:
    case TermValue::kLateralLoadFactor:
    case TermValue::kWindNorth:
    case TermValue::kWindEast:
    case TermValue::kWindDown:
      return false;
    default:
      return true;
  }
}

bool IsOverGround(TermValue value) {
  switch (value) {
    case TermValue::kNorth:
    case TermValue::kEast:
    case TermValue::kU:
    case TermValue::kV:
    case TermValue::kW:
    case TermValue::kClimbRate:
    case TermValue::kTerrain:
    case TermValue::kHeightAboveTerrain:
      return true;
    default:
      return value >= TermValue::kPointNorth && value <= TermValue::kPointAbovePath;
  }
}

}  // namespace skein
