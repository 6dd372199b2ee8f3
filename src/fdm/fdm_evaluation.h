// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "envs/air/atmosphere.h"
#include "envs/air/gravity.h"
#include "src/fdm/fdm_file.h"

namespace skein {

enum class FdmPrecision {
  kFloat64,  ///< the scalar double-precision plant
  kFloat32,  ///< the SIMD kernel of the active target
};

/// What the equations of motion are of, and how they are computed.
struct FdmModel {
  std::string aircraft = "f16";  ///< a name of envs/aircraft/registry.h
  AtmosphereModel atmosphere = AtmosphereModel::kStevensLewis;
  Gravity gravity;
  FdmPrecision precision = FdmPrecision::kFloat64;
};

/// What the equations of motion give at a point.
struct FdmPointResult {
  std::array<double, 6> coefficients{};  ///< Cx, Cy, Cz, Cl, Cm, Cn about the cg
  FdmState state_rate{};
  double alpha_deg = 0, beta_deg = 0;
  double mach = 0;
  double dynamic_pressure_psf = 0;
};

/// Evaluates every point. In float32, coefficients and rates are the kernel's; the four air data
/// are the double-precision plant's.
std::vector<FdmPointResult> EvaluatePoints(const std::vector<FdmPoint>& points,
                                           const FdmModel& model);

/// The states at trajectory.t, flown with classic RK4 steps of `dt` seconds. Throws Error if a time
/// is not a multiple of dt, or more than 1e9 of them.
std::vector<FdmState> FlyTrajectory(const FdmTrajectory& trajectory, double dt,
                                    const FdmModel& model);

}  // namespace skein
