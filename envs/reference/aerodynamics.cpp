// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/aerodynamics.h"

#include <algorithm>

#include "envs/aircraft/table_lookup.h"

namespace skein {
namespace {

/// Reads tables at one alpha and beta. Functions are named by the tables' axes.
class TableReading {
 public:
  TableReading(const AerodynamicTables& tables, double alpha_deg, double beta_deg)
      : tables_(tables),
        num_beta_(static_cast<int>(tables.beta_deg.size())),
        alpha_(Locate(tables.alpha_deg, alpha_deg)),
        beta_(Locate(tables.beta_deg, beta_deg)) {}

  double Alpha(const std::vector<double>& table) const { return Interpolate(table, alpha_); }

  double AlphaBeta(const std::vector<double>& table) const {
    return Interpolate(table, alpha_, beta_, num_beta_);
  }

  double AlphaBetaElevator(const std::vector<double>& table, double elevator_deg) const {
    return Interpolate(table, alpha_, beta_, num_beta_, Locate(tables_.elevator_deg, elevator_deg),
                       static_cast<int>(tables_.elevator_deg.size()));
  }

  double AlphaBetaCoarseElevator(const std::vector<double>& table, double elevator_deg) const {
    return Interpolate(table, alpha_, beta_, num_beta_,
                       Locate(tables_.elevator_coarse_deg, elevator_deg),
                       static_cast<int>(tables_.elevator_coarse_deg.size()));
  }

 private:
  const AerodynamicTables& tables_;
  int num_beta_;
  GridCell alpha_, beta_;
};

/// Reads the leading-edge flap tables: totals and increments with the flap at zero.
class FlapReading {
 public:
  FlapReading(const AerodynamicTables& tables, double alpha_deg, double beta_deg)
      : num_beta_(static_cast<int>(tables.beta_deg.size())),
        alpha_(Locate(tables.alpha_lef_deg, alpha_deg)),
        beta_(Locate(tables.beta_deg, beta_deg)) {}

  double Alpha(const std::vector<double>& table) const { return Interpolate(table, alpha_); }

  double AlphaBeta(const std::vector<double>& table) const {
    return Interpolate(table, alpha_, beta_, num_beta_);
  }

 private:
  int num_beta_;
  GridCell alpha_, beta_;
};

}  // namespace

AerodynamicCoefficients EvaluateAerodynamics(const Aircraft& aircraft,
                                             const AerodynamicCondition& condition) {
  const AerodynamicTables& t = aircraft.aerodynamics;
  const Airframe& airframe = aircraft.airframe;

  const TableReading base(t, condition.alpha_deg, condition.beta_deg);
  const double flap_alpha_deg =
      std::clamp(condition.alpha_deg, t.alpha_lef_deg.front(), t.alpha_lef_deg.back());
  const TableReading base_at_flap(t, flap_alpha_deg, condition.beta_deg);
  const FlapReading flap(t, flap_alpha_deg, condition.beta_deg);
  const double beta_deg = std::clamp(condition.beta_deg, t.beta_deg.front(), t.beta_deg.back());

  const double elevator_deg = condition.elevator_deg;
  const double aileron = condition.aileron_deg / airframe.aileron_reference_deg;
  const double rudder = condition.rudder_deg / airframe.rudder_reference_deg;
  // 1 with the flap up, 0 with the flap where the base tables have it.
  const double flap_up =
      1 - condition.leading_edge_flap_deg / airframe.leading_edge_flap_reference_deg;
  const double p_hat = condition.p_hat, q_hat = condition.q_hat, r_hat = condition.r_hat;

  // Base totals at elevator zero, from which increments are taken.
  const double Cy = base.AlphaBeta(t.Cy);
  const double Cn_0 = base.AlphaBetaCoarseElevator(t.Cn, 0);
  const double Cl_0 = base.AlphaBetaCoarseElevator(t.Cl, 0);
  const double Cx_flap_0 = base_at_flap.AlphaBetaElevator(t.Cx, 0);
  const double Cz_flap_0 = base_at_flap.AlphaBetaElevator(t.Cz, 0);
  const double Cm_flap_0 = base_at_flap.AlphaBetaElevator(t.Cm, 0);
  const double Cy_flap_0 = base_at_flap.AlphaBeta(t.Cy);
  const double Cn_flap_0 = base_at_flap.AlphaBetaCoarseElevator(t.Cn, 0);
  const double Cl_flap_0 = base_at_flap.AlphaBetaCoarseElevator(t.Cl, 0);

  const double Cy_lef = flap.AlphaBeta(t.Cy_lef);
  const double Cn_lef = flap.AlphaBeta(t.Cn_lef);
  const double Cl_lef = flap.AlphaBeta(t.Cl_lef);
  const double dCx_lef = flap.AlphaBeta(t.Cx_lef) - Cx_flap_0;
  const double dCz_lef = flap.AlphaBeta(t.Cz_lef) - Cz_flap_0;
  const double dCm_lef = flap.AlphaBeta(t.Cm_lef) - Cm_flap_0;
  const double dCy_lef = Cy_lef - Cy_flap_0;
  const double dCn_lef = Cn_lef - Cn_flap_0;
  const double dCl_lef = Cl_lef - Cl_flap_0;

  const double dCy_aileron = base.AlphaBeta(t.Cy_a20) - Cy;
  const double dCn_aileron = base.AlphaBeta(t.Cn_a20) - Cn_0;
  const double dCl_aileron = base.AlphaBeta(t.Cl_a20) - Cl_0;
  const double dCy_aileron_lef =
      (flap.AlphaBeta(t.Cy_a20_lef) - Cy_lef) - (base_at_flap.AlphaBeta(t.Cy_a20) - Cy_flap_0);
  const double dCn_aileron_lef =
      (flap.AlphaBeta(t.Cn_a20_lef) - Cn_lef) - (base_at_flap.AlphaBeta(t.Cn_a20) - Cn_flap_0);
  const double dCl_aileron_lef =
      (flap.AlphaBeta(t.Cl_a20_lef) - Cl_lef) - (base_at_flap.AlphaBeta(t.Cl_a20) - Cl_flap_0);

  const double dCy_rudder = base.AlphaBeta(t.Cy_r30) - Cy;
  const double dCn_rudder = base.AlphaBeta(t.Cn_r30) - Cn_0;
  const double dCl_rudder = base.AlphaBeta(t.Cl_r30) - Cl_0;

  const double Cx = base.AlphaBetaElevator(t.Cx, elevator_deg) + dCx_lef * flap_up +
                    q_hat * (base.Alpha(t.Cxq) + flap.Alpha(t.dCxq_lef) * flap_up);
  const double Cz = base.AlphaBetaElevator(t.Cz, elevator_deg) + dCz_lef * flap_up +
                    q_hat * (base.Alpha(t.Czq) + flap.Alpha(t.dCzq_lef) * flap_up);
  const double Cy_total =
      Cy + dCy_lef * flap_up + (dCy_aileron + dCy_aileron_lef * flap_up) * aileron +
      dCy_rudder * rudder + r_hat * (base.Alpha(t.Cyr) + flap.Alpha(t.dCyr_lef) * flap_up) +
      p_hat * (base.Alpha(t.Cyp) + flap.Alpha(t.dCyp_lef) * flap_up);
  const double Cl = base.AlphaBetaCoarseElevator(t.Cl, elevator_deg) + dCl_lef * flap_up +
                    (dCl_aileron + dCl_aileron_lef * flap_up) * aileron + dCl_rudder * rudder +
                    r_hat * (base.Alpha(t.Clr) + flap.Alpha(t.dClr_lef) * flap_up) +
                    p_hat * (base.Alpha(t.Clp) + flap.Alpha(t.dClp_lef) * flap_up) +
                    base.Alpha(t.dCl_beta) * beta_deg;

  // The tables' moments are about cg_reference: move them to the centre of gravity.
  const double cg_shift = airframe.cg_reference - airframe.cg;
  const double eta_el = Interpolate(t.eta_el, Locate(t.elevator_deg, elevator_deg));
  const double Cm =
      base.AlphaBetaElevator(t.Cm, elevator_deg) * eta_el + Cz * cg_shift + dCm_lef * flap_up +
      q_hat * (base.Alpha(t.Cmq) + flap.Alpha(t.dCmq_lef) * flap_up) + base.Alpha(t.dCm);
  const double Cn = base.AlphaBetaCoarseElevator(t.Cn, elevator_deg) + dCn_lef * flap_up -
                    Cy_total * cg_shift * airframe.chord_ft / airframe.span_ft +
                    (dCn_aileron + dCn_aileron_lef * flap_up) * aileron + dCn_rudder * rudder +
                    r_hat * (base.Alpha(t.Cnr) + flap.Alpha(t.dCnr_lef) * flap_up) +
                    p_hat * (base.Alpha(t.Cnp) + flap.Alpha(t.dCnp_lef) * flap_up) +
                    base.Alpha(t.dCn_beta) * beta_deg;

  AerodynamicCoefficients coefficients;
  coefficients << Cx, Cy_total, Cz, Cl, Cm, Cn;
  return coefficients;
}

}  // namespace skein
