// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "envs/aircraft/aircraft.h"

namespace skein {

/// Where the tables are read: flow angles and surface positions in degrees, body rates made
/// dimensionless.
struct AerodynamicCondition {
  double alpha_deg = 0, beta_deg = 0;
  double elevator_deg = 0, aileron_deg = 0, rudder_deg = 0, leading_edge_flap_deg = 0;
  double p_hat = 0;  ///< p span / (2 V)
  double q_hat = 0;  ///< q chord / (2 V)
  double r_hat = 0;  ///< r span / (2 V)
};

/// Cx, Cy, Cz, Cl, Cm, Cn in body axes about the centre of gravity.
using AerodynamicCoefficients = Eigen::Matrix<double, 6, 1>;

/// The coefficients' build-up of NASA TP-1538 (Nguyen et al., 1979), as arranged for the University
/// of Minnesota model (Russell, 2003), with two of its rules stated once:
/// - The pitch damping of Cz takes the flap increment of Czq. (The Minnesota code takes that of
///   Cz.)
/// - Flap increments are flap-zero totals minus base totals. Both are read with alpha clamped to
///   the range of the flap tables, which is shorter than that of the
///   base tables.
AerodynamicCoefficients EvaluateAerodynamics(const Aircraft& aircraft,
                                             const AerodynamicCondition& condition);

}  // namespace skein
