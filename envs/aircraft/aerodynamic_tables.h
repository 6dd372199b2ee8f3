// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace skein {

/// Wind-tunnel tables of one aircraft on shared axes, in double precision. A table is row-major
/// with its last axis fastest: element [i][j][k] of a table of n0 x n1 x n2 lies at (i n1 + j) n2 +
/// k. Between nodes: multilinear interpolation; outside an axis: the nearest end.
///
/// Base tables hold totals with the leading-edge flap at its reference deflection, `_lef` tables
/// totals with the flap at zero (elevator zero), `_r30` and `_a20` totals with rudder or ailerons
/// deflected, `d..._lef` increments of damping derivatives from flap at reference to flap at zero.
/// How they combine: envs/reference/aerodynamics.h. Arrangement of NASA TP-1538.
struct AerodynamicTables {
  /// Axes, degrees, strictly increasing.
  std::vector<double> alpha_deg;            ///< A: full range
  std::vector<double> alpha_lef_deg;        ///< L: where the flap was tested
  std::vector<double> beta_deg;             ///< B
  std::vector<double> elevator_deg;         ///< E
  std::vector<double> elevator_coarse_deg;  ///< C

  /// [A][B][E]. Cm is multiplied by eta_el.
  std::vector<double> Cx, Cz, Cm;
  /// [A][B][C].
  std::vector<double> Cn, Cl;
  /// [A][B].
  std::vector<double> Cy;
  std::vector<double> Cy_r30, Cn_r30, Cl_r30;
  std::vector<double> Cy_a20, Cn_a20, Cl_a20;
  /// [L][B].
  std::vector<double> Cx_lef, Cz_lef, Cm_lef, Cy_lef, Cn_lef, Cl_lef;
  std::vector<double> Cy_a20_lef, Cn_a20_lef, Cl_a20_lef;
  /// [A], per radian of q chord / (2 V), p span / (2 V) or r span / (2 V).
  std::vector<double> Cxq, Czq, Cmq;
  std::vector<double> Cyp, Cyr, Cnr, Cnp, Clp, Clr;
  /// [L], per radian, as above.
  std::vector<double> dCxq_lef, dCzq_lef, dCmq_lef;
  std::vector<double> dCyp_lef, dCyr_lef, dCnr_lef, dCnp_lef, dClp_lef, dClr_lef;
  /// [A], per degree of sideslip.
  std::vector<double> dCn_beta, dCl_beta;
  /// [A], added to Cm.
  std::vector<double> dCm;
  /// [E], multiplies Cm.
  std::vector<double> eta_el;
};

}  // namespace skein
