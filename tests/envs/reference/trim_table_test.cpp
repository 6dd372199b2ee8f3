// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/trim_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "base/error.h"
#include "envs/aircraft/f16.h"
#include "envs/aircraft/registry.h"
#include "envs/reference/trim.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-9, "residual of the trims"};
constexpr Tolerance kControlRounding{1e-9, "residual of the trims, in deg and % of power"};
constexpr Tolerance kSameTrim{1e-12, "float64 rounding of the same trim"};

class TrimTableTest : public ::testing::Test {
 protected:
  TrimPoint Exact(double altitude_ft, double speed_ft_s) const {
    TrimRequest request;
    request.altitude_ft = altitude_ft;
    request.true_airspeed_ft_s = speed_ft_s;
    return Trim(plant_, request);
  }

  Plant plant_{F16(), AtmosphereModel::kStevensLewis};
};

TEST_F(TrimTableTest, HoldsTheTrimsAtItsNodes) {
  const TrimTable table(plant_, 10000, 20000, 600, 1000, 3, 5);
  for (double altitude : {10000.0, 15000.0, 20000.0}) {
    for (double speed : {600.0, 700.0, 1000.0}) {
      const TrimPoint exact = Exact(altitude, speed);
      const TrimmedStart start = table.At(altitude, speed);
      EXPECT_NEAR(start.alpha_rad, exact.alpha_rad, kRounding);
      EXPECT_NEAR(start.pitch_rad, exact.pitch_rad, kRounding);
      EXPECT_NEAR(start.bank_rad, exact.bank_rad, kRounding);
      EXPECT_NEAR(start.elevator_deg, exact.controls.elevator_deg, kControlRounding);
      EXPECT_NEAR(start.aileron_deg, exact.controls.aileron_deg, kControlRounding);
      EXPECT_NEAR(start.rudder_deg, exact.controls.rudder_deg, kControlRounding);
      EXPECT_NEAR(start.leading_edge_flap_deg, exact.controls.leading_edge_flap_deg,
                  kControlRounding);
      EXPECT_NEAR(start.power, exact.power, kControlRounding);
      const PlantOutput output = plant_.Evaluate(exact.state, exact.controls);
      EXPECT_NEAR(start.nz, output.nz, kRounding);
      EXPECT_NEAR(start.ny, output.ny, kRounding);
    }
  }
}

// Over the ranges in which Heading episodes begin, interpolation costs less than the aircraft
// notices: 0.02 deg of alpha is 0.01 g.
TEST_F(TrimTableTest, InterpolatesCloselyOverTheUsualStarts) {
  constexpr Tolerance kAlphaRad{0.02 / kDegPerRad, "bilinear between nodes"};
  constexpr Tolerance kElevatorDeg{2e-3, "bilinear between nodes"};
  constexpr Tolerance kPower{0.2, "bilinear between nodes, where power rises steeply"};
  const TrimTable table(plant_, 19000, 20000, 1000, 1200);
  std::mt19937_64 random(1);
  for (int n = 0; n < 50; ++n) {
    const double altitude = std::uniform_real_distribution<double>(19000, 20000)(random);
    const double speed = std::uniform_real_distribution<double>(1000, 1200)(random);
    const TrimPoint exact = Exact(altitude, speed);
    const TrimmedStart start = table.At(altitude, speed);
    EXPECT_NEAR(start.alpha_rad, exact.alpha_rad, kAlphaRad);
    EXPECT_NEAR(start.elevator_deg, exact.controls.elevator_deg, kElevatorDeg);
    EXPECT_NEAR(start.power, exact.power, kPower);
  }
}

TEST_F(TrimTableTest, TakesRangesOfOnePoint) {
  const TrimPoint exact = Exact(15000, 500);
  const TrimTable point(plant_, 15000, 15000, 500, 500);
  EXPECT_NEAR(point.At(15000, 500).alpha_rad, exact.alpha_rad, kSameTrim);
  EXPECT_NEAR(point.At(0, 9999).alpha_rad, exact.alpha_rad, kSameTrim);
  const TrimTable row(plant_, 15000, 15000, 500, 700);
  EXPECT_NEAR(row.At(15000, 700).alpha_rad, Exact(15000, 700).alpha_rad, kRounding);
  const TrimTable column(plant_, 10000, 15000, 500, 500);
  EXPECT_NEAR(column.At(10000, 500).alpha_rad, Exact(10000, 500).alpha_rad, kRounding);
}

// Slow starts, too, begin below the stall, which is at 15 degrees.
TEST(TrimTableOfACessna, BeginsBelowTheStall) {
  const Plant cessna(LoadAircraft("cessna172"), AtmosphereModel::kStandard1976);
  for (const double fastest : {92.0, 98.0, 200.0}) {
    const TrimTable table(cessna, 0, 0, 90, fastest);
    double last = 15 / kDegPerRad;
    for (double speed = 90; speed < fastest; speed += 1) {
      const double alpha = table.At(0, speed).alpha_rad;
      EXPECT_LT(alpha, last) << speed << " of 90 to " << fastest << " ft/s";
      last = alpha;
    }
  }
}

TEST_F(TrimTableTest, RefusesWhatCannotBeFlownAndSaysWhere) {
  try {
    const TrimTable table(plant_, 45000, 45000, 150, 900);
    FAIL() << "150 ft/s at 45000 ft cannot be flown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("45000 ft"), std::string::npos) << error.what();
  }
  EXPECT_THROW(TrimTable(plant_, 2, 1, 500, 600), Error);
  EXPECT_THROW(TrimTable(plant_, 1, 2, std::nan(""), 600), Error);
  EXPECT_THROW(TrimTable(plant_, 1, 2, 500, 600, 1, 2), Error);
}

}  // namespace
}  // namespace skein
