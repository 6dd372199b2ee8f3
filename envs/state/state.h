// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace skein {

/// The columns of one aircraft's simulated state, float32 in tiles. Foot, slug, second, radian;
/// `_deg` in degrees. The first thirteen are the rigid-body state in the order of the equations
/// (and of `skein fdm` files).
enum Column : int {
  kU,
  kV,
  kW,  ///< inertial velocity in body axes, ft/s
  kP,
  kQ,
  kR,  ///< angular rates, rad/s
  kNorth,
  kEast,
  kDown,  ///< position, ft; altitude = -down
  kQ0,
  kQx,
  kQy,
  kQz,  ///< attitude quaternion, v_body = T(q) v_ned
  kNumRigidBody,

  kPower = kNumRigidBody,  ///< engine power, 0..100; 50 is military
  kPowerCommand,           ///< commanded engine power, held during a control step
  kElevator,
  kAileron,
  kRudder,
  kLeadingEdgeFlap,  ///< surface positions, deg
  kNz,
  kNy,  ///< specific forces at the cg, g; nz = -Fz/(m g), ny = Fy/(m g), read by the flight control

  // Flight control system: one column per filter state (see envs/reference/flight_control.h).
  kAlphaFilter,
  kPitchRateFilter,
  kPitchRateWashout,
  kLoadFactorFilter,
  kLoadFactorCommandFilter,
  kPitchLeadFilter,
  kPitchIntegrator,
  kRollRateFilter,
  kRollCommandFilter,
  kRollIntegrator,
  kYawRateFilter,
  kYawWashout,
  kYawLeadFilter,
  kPedalFilter,
  kLateralAccelerationFilter,
  kFlapFilter,
  kTrimAileron,
  kTrimRudder,
  kNumColumns,

  // Wind (envs/wind/wind.h): only tiles that are `windy` have the columns from here on.
  kWindNorth = kNumColumns,
  kWindEast,
  kWindDown,  ///< velocity of the air over ground, ft/s, held during a control step
  kNumRecordedColumns,
  kAirU = kNumRecordedColumns,
  kAirV,
  kAirW,  ///< velocity relative to the air in body axes, ft/s: kU, kV, kW less the wind
  kSteadyWindNorth,
  kSteadyWindEast,    ///< its part that lasts, ft/s
  kTurbulenceStdDev,  ///< standard deviation of the gusts, ft/s
  kGustForward,
  kGustRight,
  kGustRightLagged,
  kGustDown,
  kGustDownLagged,  ///< states of the gusts' filters, of unit scale (envs/wind/dryden.h)
  kNumWindyColumns,

  // Rotational gusts (envs/wind/dryden.h): only tiles that have `rotational_gusts` have these.
  kGustRollRate = kNumWindyColumns,
  kGustPitchRate,
  kGustYawRate,    ///< angular rates of the air, body axes, rad/s, held during a control step
  kGustRollState,  ///< state of the filter of kGustRollRate, of unit scale
  kGustRightSmoothed,
  kGustDownSmoothed,  ///< transverse gusts without what is short beside the wing, of unit scale
  kNumRotationalGustColumns
};

/// A view of a tile's columns: column c of aircraft i lies at base[c * stride + i]. `stride` is a
/// multiple of 16 and at least `count` rounded up to 32: kernels also process the padding lanes,
/// whose contents must be finite. A tile has kNumColumns columns, or kNumWindyColumns if it is
/// `windy`; else its air is still. One that is windy may have kNumRotationalGustColumns.
struct Tile {
  float* base = nullptr;
  std::size_t stride = 0;
  int count = 0;
  bool windy = false;
  bool rotational_gusts = false;
  /// By windy and rotational_gusts.
  int num_columns() const {
    if (rotational_gusts) return kNumRotationalGustColumns;
    return windy ? kNumWindyColumns : kNumColumns;
  }

  /// The first of the three columns of the velocity relative to the air, in body axes.
  int air_velocity() const { return windy ? kAirU : kU; }

  /// The first aircraft's entry of a column.
  float* operator[](int column) const { return base + static_cast<std::size_t>(column) * stride; }
};

/// The smallest stride for `count` aircraft: a multiple of 32 lanes, plus 16 so that columns do not
/// share cache sets.
constexpr std::size_t TileStride(int count) {
  return (static_cast<std::size_t>(count) + 31) / 32 * 32 + 16;
}

}  // namespace skein
