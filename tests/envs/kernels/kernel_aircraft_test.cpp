// SPDX-License-Identifier: Apache-2.0
#include "envs/kernels/kernel_aircraft.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/f16.h"
#include "envs/kernels/kernel_airframe.h"
#include "envs/kernels/plant_kernel.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

std::shared_ptr<const KernelAircraft> Make(const Aircraft& aircraft) {
  return MakeKernelAircraft(aircraft, AtmosphereModel::kStevensLewis);
}

/// The axis' own formula in double precision.
double Position(const KernelAxis& axis, double x) {
  const auto limit = [](double value, float low, float high) {
    return std::clamp<double>(value, low, high);
  };
  return axis.offset + axis.cells_per_unit * limit(x, axis.low, axis.high) +
         axis.inner_more_cells_per_unit * limit(x, axis.inner_low, axis.inner_high);
}

constexpr Tolerance kPlace{5e-6, "float32 constants times some tens of degrees"};

void ExpectNodesAtIntegers(const std::vector<double>& nodes) {
  const KernelAxis axis = MakeKernelAxis(nodes, "test");
  EXPECT_EQ(axis.last_cell, static_cast<int>(nodes.size()) - 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_NEAR(Position(axis, nodes[i]), static_cast<double>(i), kPlace) << nodes[i];
  }
  const double middle = (nodes[0] + nodes[1]) / 2;
  EXPECT_NEAR(Position(axis, middle), 0.5, kPlace);
  EXPECT_NEAR(Position(axis, nodes.front() - 100), 0, kPlace);
  EXPECT_NEAR(Position(axis, nodes.back() + 100), static_cast<double>(nodes.size()) - 1, kPlace);
}

TEST(KernelAxis, NodesLieAtIntegersAndTheEndsClamp) {
  const Aircraft aircraft = F16();
  for (const auto& nodes : {aircraft.aerodynamics.alpha_deg, aircraft.aerodynamics.beta_deg,
                            aircraft.aerodynamics.elevator_deg, aircraft.engine.mach}) {
    ExpectNodesAtIntegers(nodes);
  }
  ExpectNodesAtIntegers({0, 1});
  ExpectNodesAtIntegers({-3, -1, 0, 1, 2});        // wide cells below only
  ExpectNodesAtIntegers({0.5, 0.6, 0.7, 1, 1.3});  // wide cells above only
}

TEST(KernelAircraft, AnotherAirframeIsAsIfMadeWithIt) {
  Aircraft aircraft = F16();
  const auto before = Make(aircraft);
  aircraft.airframe.cg += 0.05;
  aircraft.airframe.engine_angular_momentum = 160;
  const KernelConstants expected = Make(aircraft)->constants;
  const auto equals = [](const KernelConstants& a, const KernelConstants& b) {
    return std::memcmp(&a, &b, sizeof(KernelConstants)) == 0;
  };
  const KernelConstants own = before->constants;
  EXPECT_FALSE(equals(own, expected));
  // One that others hold stays as it is.
  EXPECT_TRUE(equals(WithAirframe(before, aircraft.airframe)->constants, expected));
  EXPECT_TRUE(equals(before->constants, own));
  EXPECT_TRUE(equals(WithAirframe(Make(F16()), aircraft.airframe)->constants, expected));
}

TEST(KernelAxis, OtherArrangementsAreErrors) {
  EXPECT_THROW(MakeKernelAxis({0}, "short"), Error);
  EXPECT_THROW(MakeKernelAxis({0, 1, 1, 2}, "repeated"), Error);
  EXPECT_THROW(MakeKernelAxis({0, 2, 1}, "falling"), Error);
  EXPECT_THROW(MakeKernelAxis({0, 1, 3, 6}, "three widths"), Error);
  EXPECT_THROW(MakeKernelAxis({0, 1, 3, 4}, "wide inside"), Error);
}

/// Otherwise the kernels would look for cells where no table is.
TEST(KernelAxis, CellsThatFloat32CannotTellApartAreErrors) {
  constexpr double kFarFromZero = 40.1;
  const auto nodes_apart = [](double width) {
    std::vector<double> nodes;
    for (int k = 0; k < 20; ++k) nodes.push_back(kFarFromZero + k * width);
    return nodes;
  };
  EXPECT_THROW(MakeKernelAxis(nodes_apart(3 * 0x1p-37), "tiny"), Error);
  EXPECT_NO_THROW(MakeKernelAxis(nodes_apart(0.1), "small"));
}

TEST(KernelAircraft, IncrementsBeyondTheFlapTablesAreThoseAtTheirEnd) {
  const auto kernel = Make(F16());
  const std::vector<double>& alpha = kernel->source.aerodynamics.alpha_deg;
  const int last_flap = static_cast<int>(std::find(alpha.begin(), alpha.end(), 45) - alpha.begin());
  const int lines_per_cell = static_cast<int>(kernel->slots_per_cell) / PatchLine::kNumSlots;
  const int alpha_cells = static_cast<int>(kernel->slots_per_beta / kernel->slots_per_cell);
  const int beta_cells = static_cast<int>(kernel->source.aerodynamics.beta_deg.size()) - 1;
  ASSERT_LT(last_flap, alpha_cells);
  for (int j = 0; j < beta_cells; ++j) {
    for (int i = last_flap; i < alpha_cells; ++i) {
      for (const int which : {kLateralFlap, kLateralAileronFlap, kLongitudinalFlap}) {
        const auto line_of = [&](int alpha_cell) {
          const int at = (j * alpha_cells + alpha_cell) * lines_per_cell + which;
          return kernel->slots.data() + at * PatchLine::kNumSlots;
        };
        const float *const end = line_of(last_flap), *const line = line_of(i);
        for (int n = 0; n < kPatchesPerLine; ++n) {
          const auto term = [&](const float* patches, PatchTerm of) {
            return patches[of * kPatchesPerLine + n];
          };
          EXPECT_EQ(term(line, kCorner), term(end, kCorner));
          EXPECT_EQ(term(line, kAlongBeta), term(end, kAlongBeta));
          EXPECT_EQ(term(line, kAlongAlpha), 0);
          EXPECT_EQ(term(line, kAlongBoth), 0);
        }
      }
    }
  }
}

TEST(KernelAircraft, TablesThatDoNotFitAreErrors) {
  const auto expect_error = [](void (*spoil)(Aircraft*)) {
    Aircraft aircraft = F16();
    spoil(&aircraft);
    EXPECT_THROW(Make(aircraft), Error);
  };
  EXPECT_NO_THROW(Make(F16()));
  expect_error([](Aircraft* a) { a->aerodynamics.Cx.pop_back(); });
  expect_error([](Aircraft* a) { a->aerodynamics.Cl_a20_lef.push_back(0); });
  expect_error([](Aircraft* a) { a->aerodynamics.Clr.pop_back(); });
  expect_error([](Aircraft* a) { a->aerodynamics.dClr_lef.clear(); });
  expect_error([](Aircraft* a) { a->aerodynamics.eta_el.clear(); });
  expect_error([](Aircraft* a) { a->aerodynamics.dCn_beta.clear(); });
  expect_error([](Aircraft* a) { a->engine.idle_lbf.pop_back(); });
  expect_error([](Aircraft* a) { a->engine.mach.back() += 1; });
  expect_error([](Aircraft* a) { a->aerodynamics.alpha_deg[3] += 1; });
  expect_error([](Aircraft* a) { a->aerodynamics.alpha_lef_deg[3] += 1; });
  expect_error([](Aircraft* a) { a->aerodynamics.elevator_coarse_deg[1] = 5; });
  expect_error([](Aircraft* a) {
    for (double& beta : a->aerodynamics.beta_deg) beta *= 2;
  });
}

}  // namespace
}  // namespace skein
