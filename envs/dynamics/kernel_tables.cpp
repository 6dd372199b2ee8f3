#include "envs/dynamics/kernel_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "envs/aircraft/table_lookup.h"
#include "simd/error.h"

namespace skein {
namespace {

constexpr double kDegToRad = 0.017453292519943295;
constexpr double kMaxBetaDeg = 45;

using Values = std::vector<double>;

void RequireSameNodes(const Values& part, const Values& whole, const char* name) {
  Values expected;
  for (const double node : whole) {
    if (part.front() <= node && node <= part.back()) expected.push_back(node);
  }
  if (part != expected) {
    throw Error(std::string("axis ") + name +
                " must have exactly the nodes of the full axis within its range");
  }
}

void RequireSize(const Values& table, std::size_t size, const char* name) {
  if (table.size() != size) {
    throw Error(std::string("aerodynamic table ") + name + " has " + std::to_string(table.size()) +
                " values; its axes ask for " + std::to_string(size));
  }
}

/// The tables' values at nodes of the alpha x beta grid.
class Nodes {
 public:
  explicit Nodes(const AerodynamicTables& tables) : t_(tables) {
    const std::size_t A = t_.alpha_deg.size(), L = t_.alpha_lef_deg.size();
    const std::size_t B = t_.beta_deg.size();
    const std::size_t E = t_.elevator_deg.size(), C = t_.elevator_coarse_deg.size();
    for (const std::size_t size : {A, L, B, E, C}) {
      if (size < 2) throw Error("an aerodynamic axis has fewer than two nodes");
    }
    RequireSameNodes(t_.alpha_lef_deg, t_.alpha_deg, "alpha_lef_deg");
    for (const double node : t_.elevator_coarse_deg) {
      const Values& fine = t_.elevator_deg;
      if (std::find(fine.begin(), fine.end(), node) == fine.end()) {
        throw Error("axis elevator_coarse_deg has the node " + std::to_string(node) +
                    ", which elevator_deg lacks");
      }
    }
    RequireSize(t_.Cx, A * B * E, "Cx");
    RequireSize(t_.Cz, A * B * E, "Cz");
    RequireSize(t_.Cm, A * B * E, "Cm");
    RequireSize(t_.Cn, A * B * C, "Cn");
    RequireSize(t_.Cl, A * B * C, "Cl");
    for (const Values* table :
         {&t_.Cy, &t_.Cy_r30, &t_.Cn_r30, &t_.Cl_r30, &t_.Cy_a20, &t_.Cn_a20, &t_.Cl_a20}) {
      RequireSize(*table, A * B, "of alpha and beta");
    }
    for (const Values* table : {&t_.Cx_lef, &t_.Cz_lef, &t_.Cm_lef, &t_.Cy_lef, &t_.Cn_lef,
                                &t_.Cl_lef, &t_.Cy_a20_lef, &t_.Cn_a20_lef, &t_.Cl_a20_lef}) {
      RequireSize(*table, L * B, "of the flap");
    }
    RequireSize(t_.eta_el, E, "eta_el");
    first_flap_alpha_ = static_cast<int>(
        std::find(t_.alpha_deg.begin(), t_.alpha_deg.end(), t_.alpha_lef_deg.front()) -
        t_.alpha_deg.begin());
  }

  /// The nearest alpha node within the flap tables.
  int FlapAlpha(int alpha) const {
    const int last = first_flap_alpha_ + static_cast<int>(t_.alpha_lef_deg.size()) - 1;
    return std::clamp(alpha, first_flap_alpha_, last);
  }

  double Plane(const Values& table, int alpha, int beta) const { return table[Index(alpha, beta)]; }
  double Fine(const Values& table, int alpha, int beta, double elevator_deg) const {
    const int layers = static_cast<int>(t_.elevator_deg.size());
    return Interpolate(table.data() + Index(alpha, beta) * layers,
                       Locate(t_.elevator_deg, elevator_deg), 1);
  }
  double Coarse(const Values& table, int alpha, int beta, double elevator_deg) const {
    const int layers = static_cast<int>(t_.elevator_coarse_deg.size());
    return Interpolate(table.data() + Index(alpha, beta) * layers,
                       Locate(t_.elevator_coarse_deg, elevator_deg), 1);
  }
  /// `alpha` is a node of the full axis, within the flap tables' range.
  double Flap(const Values& table, int alpha, int beta) const {
    return table[Index(alpha - first_flap_alpha_, beta)];
  }
  double FlapAlone(const Values& table, int alpha) const {
    return table[FlapAlpha(alpha) - first_flap_alpha_];
  }

 private:
  std::size_t Index(int alpha, int beta) const {
    return static_cast<std::size_t>(alpha) * t_.beta_deg.size() + beta;
  }

  const AerodynamicTables& t_;
  int first_flap_alpha_ = 0;
};

/// Values of a node's first line.
void FillPlane(const AerodynamicTables& t, const Nodes& nodes, int i, int j, double* v) {
  const double Cy = nodes.Plane(t.Cy, i, j);
  const double Cn = nodes.Coarse(t.Cn, i, j, 0);
  const double Cl = nodes.Coarse(t.Cl, i, j, 0);
  v[kPlaneCy] = Cy;
  v[kPlaneCyAileron] = nodes.Plane(t.Cy_a20, i, j) - Cy;
  v[kPlaneCnAileron] = nodes.Plane(t.Cn_a20, i, j) - Cn;
  v[kPlaneClAileron] = nodes.Plane(t.Cl_a20, i, j) - Cl;
  v[kPlaneCyRudder] = nodes.Plane(t.Cy_r30, i, j) - Cy;
  v[kPlaneCnRudder] = nodes.Plane(t.Cn_r30, i, j) - Cn;
  v[kPlaneClRudder] = nodes.Plane(t.Cl_r30, i, j) - Cl;

  // Flap increments: both terms at the alpha that the flap tables reach.
  const int f = nodes.FlapAlpha(i);
  v[kPlaneCxFlap] = nodes.Flap(t.Cx_lef, f, j) - nodes.Fine(t.Cx, f, j, 0);
  v[kPlaneCzFlap] = nodes.Flap(t.Cz_lef, f, j) - nodes.Fine(t.Cz, f, j, 0);
  v[kPlaneCmFlap] = nodes.Flap(t.Cm_lef, f, j) - nodes.Fine(t.Cm, f, j, 0);
  const double flap_Cy = nodes.Flap(t.Cy_lef, f, j), base_Cy = nodes.Plane(t.Cy, f, j);
  const double flap_Cn = nodes.Flap(t.Cn_lef, f, j), base_Cn = nodes.Coarse(t.Cn, f, j, 0);
  const double flap_Cl = nodes.Flap(t.Cl_lef, f, j), base_Cl = nodes.Coarse(t.Cl, f, j, 0);
  v[kPlaneCyFlap] = flap_Cy - base_Cy;
  v[kPlaneCnFlap] = flap_Cn - base_Cn;
  v[kPlaneClFlap] = flap_Cl - base_Cl;
  v[kPlaneCyAileronFlap] =
      (nodes.Flap(t.Cy_a20_lef, f, j) - flap_Cy) - (nodes.Plane(t.Cy_a20, f, j) - base_Cy);
  v[kPlaneCnAileronFlap] =
      (nodes.Flap(t.Cn_a20_lef, f, j) - flap_Cn) - (nodes.Plane(t.Cn_a20, f, j) - base_Cn);
  v[kPlaneClAileronFlap] =
      (nodes.Flap(t.Cl_a20_lef, f, j) - flap_Cl) - (nodes.Plane(t.Cl_a20, f, j) - base_Cl);
}

/// Values of a node's line of elevator interval k.
void FillElevator(const AerodynamicTables& t, const Nodes& nodes, int i, int j, int k, double* v) {
  const double low = t.elevator_deg[k], high = t.elevator_deg[k + 1];
  const auto fine = [&](const Values& table, int slot, int step_slot) {
    v[slot] = nodes.Fine(table, i, j, low);
    v[step_slot] = nodes.Fine(table, i, j, high) - v[slot];
  };
  fine(t.Cx, kElevatorCx, kElevatorCxStep);
  fine(t.Cz, kElevatorCz, kElevatorCzStep);
  fine(t.Cm, kElevatorCm, kElevatorCmStep);
  const auto coarse = [&](const Values& table, double per_beta, int slot, int step_slot) {
    const double value = nodes.Coarse(table, i, j, low);
    v[slot] = value + per_beta * t.beta_deg[j];
    v[step_slot] = nodes.Coarse(table, i, j, high) - value;
  };
  coarse(t.Cn, t.dCn_beta[i], kElevatorCn, kElevatorCnStep);
  coarse(t.Cl, t.dCl_beta[i], kElevatorCl, kElevatorClStep);
}

void FillCells(const Values& values, CellTable* table) {
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    table->value[i] = static_cast<float>(values[i]);
    table->step[i] = static_cast<float>(values[i + 1] - values[i]);
  }
}

void FillAlphaFunctions(const AerodynamicTables& t, const Nodes& nodes, CellTable* functions) {
  const std::size_t A = t.alpha_deg.size(), L = t.alpha_lef_deg.size();
  const auto full = [&](const Values& table, int function) {
    RequireSize(table, A, "of alpha");
    FillCells(table, &functions[function]);
  };
  full(t.Cxq, kAlphaCxq);
  full(t.Czq, kAlphaCzq);
  full(t.Cmq, kAlphaCmq);
  full(t.Cyp, kAlphaCyp);
  full(t.Cyr, kAlphaCyr);
  full(t.Cnp, kAlphaCnp);
  full(t.Cnr, kAlphaCnr);
  full(t.Clp, kAlphaClp);
  full(t.Clr, kAlphaClr);
  full(t.dCm, kAlphaCm);
  const auto flap = [&](const Values& table, int function) {
    RequireSize(table, L, "of the flap's alpha");
    Values extended(A);
    for (std::size_t i = 0; i < A; ++i) extended[i] = nodes.FlapAlone(table, static_cast<int>(i));
    FillCells(extended, &functions[function]);
  };
  flap(t.dCxq_lef, kAlphaCxqFlap);
  flap(t.dCzq_lef, kAlphaCzqFlap);
  flap(t.dCmq_lef, kAlphaCmqFlap);
  flap(t.dCyp_lef, kAlphaCypFlap);
  flap(t.dCyr_lef, kAlphaCyrFlap);
  flap(t.dCnp_lef, kAlphaCnpFlap);
  flap(t.dCnr_lef, kAlphaCnrFlap);
  flap(t.dClp_lef, kAlphaClpFlap);
  flap(t.dClr_lef, kAlphaClrFlap);
}

}  // namespace

void FillAerodynamics(const AerodynamicTables& tables, KernelAircraft* kernel) {
  const Nodes nodes(tables);
  RequireSize(tables.dCn_beta, tables.alpha_deg.size(), "dCn_beta");
  RequireSize(tables.dCl_beta, tables.alpha_deg.size(), "dCl_beta");
  kernel->alpha = MakeKernelAxis(tables.alpha_deg, "alpha_deg");
  kernel->beta = MakeKernelAxis(tables.beta_deg, "beta_deg");
  kernel->elevator = MakeKernelAxis(tables.elevator_deg, "elevator_deg");
  if (tables.beta_deg.front() < -kMaxBetaDeg || tables.beta_deg.back() > kMaxBetaDeg) {
    throw Error("axis beta_deg goes beyond the kernels' 45 degrees of sideslip");
  }
  if (kernel->alpha.last_cell >= CellTable::kMaxCells ||
      kernel->elevator.last_cell >= CellTable::kMaxCells) {
    throw Error("axes alpha_deg and elevator_deg may have at most " +
                std::to_string(CellTable::kMaxCells + 1) + " nodes in the kernels");
  }
  kernel->tan_beta_low = static_cast<float>(std::tan(tables.beta_deg.front() * kDegToRad));
  kernel->tan_beta_high = static_cast<float>(std::tan(tables.beta_deg.back() * kDegToRad));

  const int num_alpha = static_cast<int>(tables.alpha_deg.size());
  const int num_beta = static_cast<int>(tables.beta_deg.size());
  const int lines_per_node = static_cast<int>(tables.elevator_deg.size());
  kernel->lines_per_node = static_cast<float>(lines_per_node);
  kernel->lines_per_beta = static_cast<float>(lines_per_node * num_alpha);
  kernel->lines.resize(static_cast<std::size_t>(lines_per_node) * num_alpha * num_beta);
  const auto fill = [&](int i, int j, int line, double* values) {
    if (line == 0) {
      FillPlane(tables, nodes, i, j, values);
    } else {
      FillElevator(tables, nodes, i, j, line - 1, values);
    }
  };
  for (int j = 0; j < num_beta; ++j) {
    for (int i = 0; i < num_alpha; ++i) {
      for (int line = 0; line < lines_per_node; ++line) {
        double here[16] = {}, next[16] = {};
        fill(i, j, line, here);
        fill(std::min(i + 1, num_alpha - 1), j, line, next);
        NodeLine& node = kernel->lines[(j * num_alpha + i) * lines_per_node + line];
        for (int slot = 0; slot < 16; ++slot) {
          node.value[slot] = static_cast<float>(here[slot]);
          node.alpha_step[slot] = static_cast<float>(next[slot] - here[slot]);
        }
      }
    }
  }
  FillAlphaFunctions(tables, nodes, kernel->alpha_functions);
  FillCells(tables.eta_el, &kernel->elevator_effect);
}

}  // namespace skein
