// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "envs/reference/plant.h"
#include "envs/reference/trim.h"

namespace skein {

/// What a row or a column of a linear model stands for.
struct ModelVariable {
  const char* name = nullptr;
  const char* unit = nullptr;
};

enum class FlapMotion {
  kFixed,      ///< the leading-edge flap is an input
  kScheduled,  ///< it follows its steady schedule (SteadyLeadingEdgeFlap) without delay
};

/// The states of a LinearFlight, in this order.
enum FlightVariable : int {
  kTrueAirspeed,
  kAngleOfAttack,
  kPitchAngle,
  kPitchRate,
  kSideslip,
  kBankAngle,
  kRollRate,
  kYawRate,
  kAltitude,
  kNumFlightVariables
};

/// The bare airframe about a steady flight in the variables of flight dynamics, for departures from
/// it:  x' = A x + B u,  y = C x + D u.
/// North, east and heading are left out: nothing depends on them. Thrust is that of the engine's
/// tables at the power that is an input; altitude and Mach number change it.
struct LinearFlight {
  std::vector<ModelVariable> states, inputs, outputs;
  Eigen::MatrixXd A, B, C, D;
};

/// By central differences, as Linearise. Where the trim needs thrust that the engine has not, the
/// difference is held constant.
LinearFlight LineariseFlight(const Plant& plant, const TrimPoint& trim, FlapMotion flap);

}  // namespace skein
