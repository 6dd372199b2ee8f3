// SPDX-License-Identifier: Apache-2.0
// Holds the numbers of floating-point operations in envs/kernels/plant_kernel.h, by which rates
// become shares of a peak, against a count: the plant kernel is compiled once more here, for one
// lane, on operations that count themselves.

#define HWY_COMPILE_ONLY_SCALAR
#define HWY_TARGET_INCLUDE "envs/kernels/plant_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <type_traits>

namespace skein::counted {

using namespace hwy::HWY_NAMESPACE;  // NOLINT: what is not counted below is Highway's

inline long operations = 0;

template <class Vector>
void Count(long number) {
  if (std::is_same_v<hwy::HWY_NAMESPACE::TFromV<Vector>, float>) operations += number;
}

// Highway's operation of that name, as `number` operations of a lane.
#define SKEIN_COUNTED(Operation, number)                    \
  template <class Vector, class... Vectors>                 \
  Vector Operation(Vector first, Vectors... others) {       \
    Count<Vector>(number);                                  \
    return hwy::HWY_NAMESPACE::Operation(first, others...); \
  }
SKEIN_COUNTED(Add, 1)
SKEIN_COUNTED(Sub, 1)
SKEIN_COUNTED(Mul, 1)
SKEIN_COUNTED(Div, 1)
SKEIN_COUNTED(Min, 1)
SKEIN_COUNTED(Max, 1)
SKEIN_COUNTED(Sqrt, 1)
SKEIN_COUNTED(MulAdd, 2)
SKEIN_COUNTED(MulSub, 2)
SKEIN_COUNTED(NegMulAdd, 2)
#undef SKEIN_COUNTED

}  // namespace skein::counted

#define SKEIN_HIGHWAY ::skein::counted
#include <gtest/gtest.h>

#include <vector>

#include "envs/aircraft/f16.h"
#include "envs/kernels/plant_kernel.cpp"  // NOLINT: instead of the library's
#include "envs/kernels/plant_kernel.h"
#include "tests/envs/test_tile.h"

namespace skein {
namespace {

constexpr int kCount = 32;  // one block of the kernel: no lane is padding

/// F-16s in level flight, all in the same cells of the tables.
TestTile LevelFlights() {
  TestTile flights(kCount);
  flights.Fill(kU, 600);
  flights.Fill(kW, 40);
  flights.Fill(kDown, -20000);
  flights.Fill(kQ0, 1);
  flights.Fill(kPower, 20);
  flights.Fill(kPowerCommand, 20);
  return flights;
}

/// Operations of `work` for each aircraft.
template <class Work>
double CountOf(const Work& work) {
  counted::operations = 0;
  work();
  return static_cast<double>(counted::operations) / kCount;
}

const KernelAircraft& KernelF16() {
  static const auto aircraft = MakeKernelAircraft(F16(), AtmosphereModel::kStevensLewis);
  return *aircraft;
}

TEST(OperationCount, OfAnRk4StepIsThePublicFigure) {
  TestTile flights = LevelFlights();
  // A step of no time: no stage finds an aircraft in another cell, whose tables it would read anew.
  const auto step = [&](int substeps) {
    return CountOf([&] { StepTile(KernelF16(), flights.tile(), 0, substeps); });
  };
  const double one = step(1);
  EXPECT_EQ(one, kFlopsPerRk4Step);
  EXPECT_GT(step(2), 1.9 * one);
  EXPECT_LT(step(2), 2 * one) << "surfaces are located once";
}

TEST(OperationCount, OfAnEvaluationIsThePublicFigure) {
  TestTile flights = LevelFlights();
  const std::vector<float> thrust(flights.stride(), 5000);
  std::vector<float> rates(flights.stride() * kNumRigidBody), coefficients(flights.stride() * 6);
  const Tile tile = flights.tile();
  const ControlColumns controls{thrust.data(), tile[kElevator], tile[kAileron], tile[kRudder],
                                tile[kLeadingEdgeFlap]};
  EXPECT_EQ(CountOf([&] {
              EvaluateTile(KernelF16(), tile, controls, rates.data(), coefficients.data());
            }),
            kFlopsPerEvaluation);
}

}  // namespace
}  // namespace skein
