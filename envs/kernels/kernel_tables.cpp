// SPDX-License-Identifier: Apache-2.0
#include "envs/kernels/kernel_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/table_lookup.h"

namespace skein {
namespace {

constexpr double kDegToRad = 0.017453292519943295;
constexpr double kMaxBetaDeg = 45;
constexpr int kMaxSlots = 1 << 24;  // kernels find slots in float32

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

/// The values of one line's functions at one node of the grid.
using Quad = std::array<double, kPatchesPerLine>;

/// A SurfaceLine at node (i, j).
Quad SurfaceIncrements(const AerodynamicTables& t, const Nodes& nodes, int line, int i, int j) {
  const double Cy = nodes.Plane(t.Cy, i, j);
  const double Cn = nodes.Coarse(t.Cn, i, j, 0);
  const double Cl = nodes.Coarse(t.Cl, i, j, 0);
  // Flap increments: both terms at the alpha that the flap tables reach.
  const int f = nodes.FlapAlpha(i);
  const double flap_Cy = nodes.Flap(t.Cy_lef, f, j), base_Cy = nodes.Plane(t.Cy, f, j);
  const double flap_Cn = nodes.Flap(t.Cn_lef, f, j), base_Cn = nodes.Coarse(t.Cn, f, j, 0);
  const double flap_Cl = nodes.Flap(t.Cl_lef, f, j), base_Cl = nodes.Coarse(t.Cl, f, j, 0);
  Quad quad{};
  switch (line) {
    case kLateralFlap:
      quad[kPatchCy] = flap_Cy - base_Cy;
      quad[kPatchCn] = flap_Cn - base_Cn;
      quad[kPatchCl] = flap_Cl - base_Cl;
      quad[kPatchCmFlap] = nodes.Flap(t.Cm_lef, f, j) - nodes.Fine(t.Cm, f, j, 0);
      break;
    case kLateralAileron:
      quad[kPatchCy] = nodes.Plane(t.Cy_a20, i, j) - Cy;
      quad[kPatchCn] = nodes.Plane(t.Cn_a20, i, j) - Cn;
      quad[kPatchCl] = nodes.Plane(t.Cl_a20, i, j) - Cl;
      break;
    case kLateralAileronFlap:
      quad[kPatchCy] =
          (nodes.Flap(t.Cy_a20_lef, f, j) - flap_Cy) - (nodes.Plane(t.Cy_a20, f, j) - base_Cy);
      quad[kPatchCn] =
          (nodes.Flap(t.Cn_a20_lef, f, j) - flap_Cn) - (nodes.Plane(t.Cn_a20, f, j) - base_Cn);
      quad[kPatchCl] =
          (nodes.Flap(t.Cl_a20_lef, f, j) - flap_Cl) - (nodes.Plane(t.Cl_a20, f, j) - base_Cl);
      break;
    case kLateralRudder:
      quad[kPatchCy] = nodes.Plane(t.Cy_r30, i, j) - Cy;
      quad[kPatchCn] = nodes.Plane(t.Cn_r30, i, j) - Cn;
      quad[kPatchCl] = nodes.Plane(t.Cl_r30, i, j) - Cl;
      break;
    case kLongitudinalFlap:
      quad[kPatchCx] = nodes.Flap(t.Cx_lef, f, j) - nodes.Fine(t.Cx, f, j, 0);
      quad[kPatchCz] = nodes.Flap(t.Cz_lef, f, j) - nodes.Fine(t.Cz, f, j, 0);
      break;
  }
  return quad;
}

/// The lateral or longitudinal functions at node (i, j) and an elevator angle.
Quad LateralAt(const AerodynamicTables& t, const Nodes& nodes, int i, int j, double elevator_deg) {
  const double beta_deg = t.beta_deg[j];
  Quad quad{};
  quad[kPatchCy] = nodes.Plane(t.Cy, i, j);
  quad[kPatchCn] = nodes.Coarse(t.Cn, i, j, elevator_deg) + t.dCn_beta[i] * beta_deg;
  quad[kPatchCl] = nodes.Coarse(t.Cl, i, j, elevator_deg) + t.dCl_beta[i] * beta_deg;
  return quad;
}

Quad LongitudinalAt(const AerodynamicTables& t, const Nodes& nodes, int i, int j,
                    double elevator_deg) {
  Quad quad{};
  quad[kPatchCx] = nodes.Fine(t.Cx, i, j, elevator_deg);
  quad[kPatchCz] = nodes.Fine(t.Cz, i, j, elevator_deg);
  quad[kPatchCm] = nodes.Fine(t.Cm, i, j, elevator_deg);
  return quad;
}

/// An ElevatorLine of interval k at node (i, j).
Quad ElevatorFunctions(const AerodynamicTables& t, const Nodes& nodes, int line, int i, int j,
                       int k) {
  const auto at = line == kLateralBase || line == kLateralElevator ? LateralAt : LongitudinalAt;
  Quad quad = at(t, nodes, i, j, t.elevator_deg[k]);
  if (line == kLateralElevator || line == kLongitudinalElevator) {
    const Quad high = at(t, nodes, i, j, t.elevator_deg[k + 1]);
    for (int n = 0; n < kPatchesPerLine; ++n) quad[n] = high[n] - quad[n];
  }
  return quad;
}

/// The line of patches of cell (i, j) for functions given at nodes.
template <class FunctionsAt>
PatchLine MakePatchLine(const FunctionsAt& functions_at, int i, int j) {
  const Quad corner = functions_at(i, j), alpha = functions_at(i + 1, j);
  const Quad beta = functions_at(i, j + 1), both = functions_at(i + 1, j + 1);
  PatchLine line;
  for (int n = 0; n < kPatchesPerLine; ++n) {
    const auto set = [&](PatchTerm term, double value) {
      line.slot[term * kPatchesPerLine + n] = static_cast<float>(value);
    };
    set(kCorner, corner[n]);
    set(kAlongAlpha, alpha[n] - corner[n]);
    set(kAlongBeta, beta[n] - corner[n]);
    set(kAlongBoth, (both[n] - beta[n]) - (alpha[n] - corner[n]));
  }
  return line;
}

void FillCells(const Values& values, CellTable* table) {
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    table->value[i] = static_cast<float>(values[i]);
    table->step[i] = static_cast<float>(values[i + 1] - values[i]);
  }
}

void FillAlphaFunctions(const AerodynamicTables& t, const Nodes& nodes, KernelAircraft* kernel) {
  const std::size_t A = t.alpha_deg.size(), L = t.alpha_lef_deg.size();
  const auto full = [&](const Values& table, int function) {
    RequireSize(table, A, "of alpha");
    FillCells(table, &kernel->alpha_functions[function]);
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
    FillCells(extended, &kernel->flap_dampings[function]);
  };
  flap(t.dCxq_lef, kAlphaCxq);
  flap(t.dCzq_lef, kAlphaCzq);
  flap(t.dCmq_lef, kAlphaCmq);
  flap(t.dCyp_lef, kAlphaCyp);
  flap(t.dCyr_lef, kAlphaCyr);
  flap(t.dCnp_lef, kAlphaCnp);
  flap(t.dCnr_lef, kAlphaCnr);
  flap(t.dClp_lef, kAlphaClp);
  flap(t.dClr_lef, kAlphaClr);
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

  const int alpha_cells = kernel->alpha.last_cell + 1;
  const int beta_cells = kernel->beta.last_cell + 1;
  const int elevator_cells = kernel->elevator.last_cell + 1;
  const int lines_per_cell = kNumSurfaceLines + kNumElevatorLines * elevator_cells;
  const int slots = lines_per_cell * PatchLine::kNumSlots * alpha_cells * beta_cells;
  if (slots >= kMaxSlots) {
    throw Error("the aerodynamic tables make " + std::to_string(slots) +
                " numbers; the kernels count to " + std::to_string(kMaxSlots));
  }
  kernel->slots_per_cell = static_cast<float>(lines_per_cell * PatchLine::kNumSlots);
  kernel->slots_per_beta = kernel->slots_per_cell * static_cast<float>(alpha_cells);
  kernel->slots.reserve(static_cast<std::size_t>(slots));
  const auto append = [kernel](const PatchLine& line) {
    kernel->slots.insert(kernel->slots.end(), std::begin(line.slot), std::end(line.slot));
  };
  for (int j = 0; j < beta_cells; ++j) {
    for (int i = 0; i < alpha_cells; ++i) {
      for (int line = 0; line < kNumSurfaceLines; ++line) {
        append(MakePatchLine(
            [&](int alpha, int beta) {
              return SurfaceIncrements(tables, nodes, line, alpha, beta);
            },
            i, j));
      }
      for (int line = 0; line < kNumElevatorLines * elevator_cells; ++line) {
        append(MakePatchLine(
            [&](int alpha, int beta) {
              return ElevatorFunctions(tables, nodes, line % kNumElevatorLines, alpha, beta,
                                       line / kNumElevatorLines);
            },
            i, j));
      }
    }
  }
  FillAlphaFunctions(tables, nodes, kernel);
  FillCells(tables.eta_el, &kernel->elevator_effect);
}

}  // namespace skein
