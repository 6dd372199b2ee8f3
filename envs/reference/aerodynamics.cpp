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

/// The coefficients in one condition: those of the plane of symmetry, and those across it.
class BuildUp {
 public:
  BuildUp(const Aircraft& aircraft, const AerodynamicCondition& condition)
      : t_(aircraft.aerodynamics),
        airframe_(aircraft.airframe),
        condition_(condition),
        base_(t_, condition.alpha_deg, condition.beta_deg),
        base_at_flap_(t_, FlapAlpha(t_, condition.alpha_deg), condition.beta_deg),
        flap_(t_, FlapAlpha(t_, condition.alpha_deg), condition.beta_deg),
        flap_up_(1 - condition.leading_edge_flap_deg / airframe_.leading_edge_flap_reference_deg),
        cg_shift_(airframe_.cg_reference - airframe_.cg) {}

  struct Longitudinal {
    double Cx, Cz, Cm;
  };
  struct Lateral {
    double Cy, Cl, Cn;
  };
  Longitudinal EvaluateLongitudinal() const;
  Lateral EvaluateLateral() const;

 private:
  static double FlapAlpha(const AerodynamicTables& tables, double alpha_deg) {
    return std::clamp(alpha_deg, tables.alpha_lef_deg.front(), tables.alpha_lef_deg.back());
  }

  const AerodynamicTables& t_;
  const Airframe& airframe_;
  const AerodynamicCondition& condition_;
  TableReading base_, base_at_flap_;
  FlapReading flap_;
  double flap_up_;   // 1 with the flap up, 0 with the flap where the base tables have it
  double cg_shift_;  // chords; the tables' moments are about cg_reference
};

BuildUp::Longitudinal BuildUp::EvaluateLongitudinal() const {
  const double elevator_deg = condition_.elevator_deg, q_hat = condition_.q_hat;
  // Increments by the flap from base totals at elevator zero.
  const double dCx_lef = flap_.AlphaBeta(t_.Cx_lef) - base_at_flap_.AlphaBetaElevator(t_.Cx, 0);
  const double dCz_lef = flap_.AlphaBeta(t_.Cz_lef) - base_at_flap_.AlphaBetaElevator(t_.Cz, 0);
  const double dCm_lef = flap_.AlphaBeta(t_.Cm_lef) - base_at_flap_.AlphaBetaElevator(t_.Cm, 0);

  Longitudinal sum{};
  sum.Cx = base_.AlphaBetaElevator(t_.Cx, elevator_deg) + dCx_lef * flap_up_ +
           q_hat * (base_.Alpha(t_.Cxq) + flap_.Alpha(t_.dCxq_lef) * flap_up_);
  sum.Cz = base_.AlphaBetaElevator(t_.Cz, elevator_deg) + dCz_lef * flap_up_ +
           q_hat * (base_.Alpha(t_.Czq) + flap_.Alpha(t_.dCzq_lef) * flap_up_);
  const double eta_el = Interpolate(t_.eta_el, Locate(t_.elevator_deg, elevator_deg));
  sum.Cm = base_.AlphaBetaElevator(t_.Cm, elevator_deg) * eta_el + sum.Cz * cg_shift_ +
           dCm_lef * flap_up_ +
           q_hat * (base_.Alpha(t_.Cmq) + flap_.Alpha(t_.dCmq_lef) * flap_up_) +
           base_.Alpha(t_.dCm);
  return sum;
}

BuildUp::Lateral BuildUp::EvaluateLateral() const {
  const double elevator_deg = condition_.elevator_deg;
  const double aileron = condition_.aileron_deg / airframe_.aileron_reference_deg;
  const double rudder = condition_.rudder_deg / airframe_.rudder_reference_deg;
  const double beta_deg = std::clamp(condition_.beta_deg, t_.beta_deg.front(), t_.beta_deg.back());
  const double p_hat = condition_.p_hat, r_hat = condition_.r_hat;

  // Base totals at elevator zero, from which increments are taken.
  const double Cy = base_.AlphaBeta(t_.Cy);
  const double Cn_0 = base_.AlphaBetaCoarseElevator(t_.Cn, 0);
  const double Cl_0 = base_.AlphaBetaCoarseElevator(t_.Cl, 0);
  const double Cy_flap_0 = base_at_flap_.AlphaBeta(t_.Cy);
  const double Cn_flap_0 = base_at_flap_.AlphaBetaCoarseElevator(t_.Cn, 0);
  const double Cl_flap_0 = base_at_flap_.AlphaBetaCoarseElevator(t_.Cl, 0);

  const double Cy_lef = flap_.AlphaBeta(t_.Cy_lef);
  const double Cn_lef = flap_.AlphaBeta(t_.Cn_lef);
  const double Cl_lef = flap_.AlphaBeta(t_.Cl_lef);
  const double dCy_lef = Cy_lef - Cy_flap_0;
  const double dCn_lef = Cn_lef - Cn_flap_0;
  const double dCl_lef = Cl_lef - Cl_flap_0;

  const double dCy_aileron = base_.AlphaBeta(t_.Cy_a20) - Cy;
  const double dCn_aileron = base_.AlphaBeta(t_.Cn_a20) - Cn_0;
  const double dCl_aileron = base_.AlphaBeta(t_.Cl_a20) - Cl_0;
  const double dCy_aileron_lef =
      (flap_.AlphaBeta(t_.Cy_a20_lef) - Cy_lef) - (base_at_flap_.AlphaBeta(t_.Cy_a20) - Cy_flap_0);
  const double dCn_aileron_lef =
      (flap_.AlphaBeta(t_.Cn_a20_lef) - Cn_lef) - (base_at_flap_.AlphaBeta(t_.Cn_a20) - Cn_flap_0);
  const double dCl_aileron_lef =
      (flap_.AlphaBeta(t_.Cl_a20_lef) - Cl_lef) - (base_at_flap_.AlphaBeta(t_.Cl_a20) - Cl_flap_0);

  const double dCy_rudder = base_.AlphaBeta(t_.Cy_r30) - Cy;
  const double dCn_rudder = base_.AlphaBeta(t_.Cn_r30) - Cn_0;
  const double dCl_rudder = base_.AlphaBeta(t_.Cl_r30) - Cl_0;

  Lateral sum{};
  sum.Cy = Cy + dCy_lef * flap_up_ + (dCy_aileron + dCy_aileron_lef * flap_up_) * aileron +
           dCy_rudder * rudder +
           r_hat * (base_.Alpha(t_.Cyr) + flap_.Alpha(t_.dCyr_lef) * flap_up_) +
           p_hat * (base_.Alpha(t_.Cyp) + flap_.Alpha(t_.dCyp_lef) * flap_up_);
  sum.Cl = base_.AlphaBetaCoarseElevator(t_.Cl, elevator_deg) + dCl_lef * flap_up_ +
           (dCl_aileron + dCl_aileron_lef * flap_up_) * aileron + dCl_rudder * rudder +
           r_hat * (base_.Alpha(t_.Clr) + flap_.Alpha(t_.dClr_lef) * flap_up_) +
           p_hat * (base_.Alpha(t_.Clp) + flap_.Alpha(t_.dClp_lef) * flap_up_) +
           base_.Alpha(t_.dCl_beta) * beta_deg;
  sum.Cn = base_.AlphaBetaCoarseElevator(t_.Cn, elevator_deg) + dCn_lef * flap_up_ -
           sum.Cy * cg_shift_ * airframe_.chord_ft / airframe_.span_ft +
           (dCn_aileron + dCn_aileron_lef * flap_up_) * aileron + dCn_rudder * rudder +
           r_hat * (base_.Alpha(t_.Cnr) + flap_.Alpha(t_.dCnr_lef) * flap_up_) +
           p_hat * (base_.Alpha(t_.Cnp) + flap_.Alpha(t_.dCnp_lef) * flap_up_) +
           base_.Alpha(t_.dCn_beta) * beta_deg;
  return sum;
}

}  // namespace

AerodynamicCoefficients EvaluateAerodynamics(const Aircraft& aircraft,
                                             const AerodynamicCondition& condition) {
  const BuildUp build_up(aircraft, condition);
  const BuildUp::Longitudinal longitudinal = build_up.EvaluateLongitudinal();
  const BuildUp::Lateral lateral = build_up.EvaluateLateral();
  AerodynamicCoefficients coefficients;
  coefficients << longitudinal.Cx, lateral.Cy, longitudinal.Cz, lateral.Cl, longitudinal.Cm,
      lateral.Cn;
  return coefficients;
}

}  // namespace skein
