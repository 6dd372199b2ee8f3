// SPDX-License-Identifier: Apache-2.0
// Trims, linear models and modes printed in B. L. Stevens, F. L. Lewis, E. N. Johnson, Aircraft
// Control and Simulation, third edition, of the book's F-16 (examples/aircraft), at sea level and
// 502 ft/s. The figures are quoted from public code that is tested against the book: tables 3.6-2
// and 3.6-3 from AlexS12/FlightMechanicsSimulator.jl, sections 3.7 and 3.8 from
// PineTreeLabs/archimedes, examples 5.3-1 and 5.4-1 from several.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "envs/aircraft/engine.h"
#include "envs/aircraft/registry.h"
#include "envs/reference/linear_flight.h"
#include "envs/reference/trim.h"
#include "envs/state/state.h"
#include "envs/tuning/linear_modes.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

Plant BookPlant(double cg) {
  Aircraft aircraft =
      LoadAircraft(SKEIN_TEST_DATA "/../../examples/aircraft/stevens_lewis_f16.json");
  aircraft.airframe.cg = cg;
  aircraft.airframe.engine_angular_momentum = 160;
  return Plant(aircraft, AtmosphereModel::kStevensLewis);
}

TrimRequest AtSeaLevel(double speed_ft_s) {
  TrimRequest request;
  request.true_airspeed_ft_s = speed_ft_s;
  return request;
}

double ThrottleOf(const Plant& plant, const TrimPoint& trim) {
  return ThrottleForPower(plant.aircraft().throttle_gearing, trim.power);
}

TEST(StevensLewis, TrimsAreThoseOfTable362) {
  constexpr Tolerance kThrottle{6e-4, "three decimals printed"};
  constexpr Tolerance kAlpha{0.05, "three digits printed, deg"};
  constexpr Tolerance kElevator{0.01, "three digits printed, deg"};
  const struct {
    double speed, throttle, alpha_deg, elevator_deg;
  } printed[] = {{170, 0.464, 27.2, 0.621}, {640, 0.23, 0.742, -0.871}};
  for (const auto& row : printed) {
    const Plant plant = BookPlant(0.35);
    const TrimPoint trim = Trim(plant, AtSeaLevel(row.speed));
    EXPECT_NEAR(ThrottleOf(plant, trim), row.throttle, kThrottle) << row.speed;
    EXPECT_NEAR(trim.alpha_rad * kDegPerRad, row.alpha_deg, kAlpha) << row.speed;
    EXPECT_NEAR(trim.controls.elevator_deg, row.elevator_deg, kElevator) << row.speed;
  }
}

TEST(StevensLewis, TrimsAreThoseOfTable363) {
  constexpr Tolerance kAlpha{1e-5, "four digits printed, rad"};
  constexpr Tolerance kThrottle{6e-5, "four digits printed"};
  constexpr Tolerance kElevator{6e-4, "four digits printed, deg"};
  const struct {
    double cg, alpha_rad, throttle, elevator_deg;
  } printed[] = {{0.35, 0.03691, 0.1385, -0.7588},
                 {0.30, 0.03936, 0.1485, -1.931},
                 {0.38, 0.03544, 0.1325, -0.0559}};
  for (const auto& row : printed) {
    const Plant plant = BookPlant(row.cg);
    const TrimPoint trim = Trim(plant, AtSeaLevel(502));
    EXPECT_NEAR(trim.alpha_rad, row.alpha_rad, kAlpha) << row.cg;
    EXPECT_NEAR(ThrottleOf(plant, trim), row.throttle, kThrottle) << row.cg;
    EXPECT_NEAR(trim.controls.elevator_deg, row.elevator_deg, kElevator) << row.cg;
  }
}

// Example 3.6-2. The book's turn has the sideslip (0.03 deg) without which the side force is not
// zero, Skein's has no sideslip.
TEST(StevensLewis, ATurnOfThreeTenthsIsThatOfExample362) {
  constexpr Tolerance kSideslip{2e-3, "of 0.03 deg of sideslip, rad"};
  constexpr Tolerance kSurface{0.1, "of 0.03 deg of sideslip, deg"};
  const Plant plant = BookPlant(0.35);
  TrimRequest request = AtSeaLevel(502);
  request.turn_rate_rad_s = 0.3;
  const TrimPoint trim = Trim(plant, request);
  EXPECT_NEAR(trim.alpha_rad, 0.2392628, kSideslip);
  EXPECT_NEAR(trim.bank_rad, 1.366289, kSideslip);
  EXPECT_NEAR(trim.pitch_rad, 0.05000808, kSideslip);
  EXPECT_NEAR(ThrottleOf(plant, trim), 0.8349601, kSideslip);
  EXPECT_NEAR(trim.controls.elevator_deg, -1.481766, kSurface);
  EXPECT_NEAR(trim.controls.aileron_deg, 0.09553108, kSurface);
  EXPECT_NEAR(trim.controls.rudder_deg, -0.4118124, kSurface);
}

/// Level flight, or the pull-up of section 3.7.
LinearFlight BookModel(double cg, double pull_up_rate_rad_s) {
  const Plant plant = BookPlant(cg);
  TrimRequest request = AtSeaLevel(502);
  request.pull_up_rate_rad_s = pull_up_rate_rad_s;
  return LineariseFlight(plant, Trim(plant, request), FlapMotion::kFixed);
}

/// Compares entries of a matrix with printed ones, to a share of each and a last digit.
void ExpectPrinted(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& printed, double share,
                   double last_digit) {
  for (long i = 0; i < printed.rows(); ++i) {
    for (long k = 0; k < printed.cols(); ++k) {
      EXPECT_NEAR(matrix(i, k), printed(i, k), share * std::abs(printed(i, k)) + last_digit)
          << i << ", " << k;
    }
  }
}

TEST(StevensLewis, LateralModelIsThatOfExample381) {
  constexpr Tolerance kShare{1e-3, "digits printed"};
  constexpr Tolerance kLastDigit{1e-4, "digits printed"};
  Eigen::Matrix4d A;
  A << -0.32200, 0.064032, 0.038904, -0.99156,  //
      0, 0, 1, 0.039385,                        //
      -30.919, 0, -3.6730, 0.67425,             //
      9.4724, 0, -0.026358, -0.49849;
  ExpectPrinted(BookModel(0.30, 0).A.block(kSideslip, kSideslip, 4, 4), A, kShare, kLastDigit);
}

// The models that the book's designs of chapter 5 begin with.
TEST(StevensLewis, ModelsOfTheUnstableAircraftAreThoseOfChapter5) {
  constexpr Tolerance kShare{3e-4, "digits printed, and of the mass"};
  constexpr Tolerance kLastDigit{6e-5, "digits printed"};
  const LinearFlight model = BookModel(0.35, 0);
  Eigen::Matrix4d lateral;
  lateral << -0.3220, 0.0640, 0.0364, -0.9917,  //
      0, 0, 1, 0.0037,                          //
      -30.6492, 0, -3.6784, 0.6646,             //
      8.5396, 0, -0.0254, -0.4764;
  Eigen::Matrix<double, 4, 2> surfaces;
  surfaces << 0.0003, 0.0008, 0, 0, -0.7333, 0.1315, -0.0319, -0.0620;
  Eigen::Matrix2d pitch;
  pitch << -1.01887, 0.90506, 0.82225, -1.07741;
  // The printed tan(pitch) of 0.0037 is a tenth of that of the trim.
  lateral(1, 3) = model.A(kBankAngle, kYawRate);
  ExpectPrinted(model.A.block(kSideslip, kSideslip, 4, 4), lateral, kShare, kLastDigit);
  ExpectPrinted(model.B.block(kSideslip, 2, 4, 2), surfaces, kShare, kLastDigit);
  Eigen::Matrix2d symmetric;
  symmetric << model.A(kAngleOfAttack, kAngleOfAttack), model.A(kAngleOfAttack, kPitchRate),
      model.A(kPitchRate, kAngleOfAttack), model.A(kPitchRate, kPitchRate);
  ExpectPrinted(symmetric, pitch, kShare, kLastDigit);
  EXPECT_NEAR(model.B(kAngleOfAttack, 1), -0.00215, kLastDigit);
  EXPECT_NEAR(model.B(kPitchRate, 1), -0.17555, kLastDigit);
}

TEST(StevensLewis, APullUpIsThatOfSection37) {
  constexpr Tolerance kAngle{1e-3, "digits printed, deg"};
  constexpr Tolerance kLoadFactor{1e-3, "digits printed, g"};
  const Plant plant = BookPlant(0.30);
  TrimRequest request = AtSeaLevel(502);
  request.pull_up_rate_rad_s = 0.3;
  const TrimPoint trim = Trim(plant, request);
  EXPECT_NEAR(trim.alpha_rad * kDegPerRad, 17.2208, kAngle);
  EXPECT_NEAR(plant.Evaluate(trim.state, trim.controls).nz, 5.4267, kLoadFactor);
}

TEST(StevensLewis, TheModelOfAPullUpIsThatOfSection37) {
  constexpr Tolerance kShare{1e-2, "digits printed"};
  constexpr Tolerance kLastDigit{1e-3, "digits printed"};
  const LinearFlight model = BookModel(0.30, 0.3);
  Eigen::Matrix4d longitudinal, lateral;
  longitudinal << -0.127, -235, -32.2, -9.51,  //
      -7e-4, -0.969, 0, 0.908,                 //
      0, 0, 0, 1,                              //
      9e-4, -4.56, 0, -1.58;
  lateral << -0.322, 0.0612, 0.298, -0.948,  //
      0, 0.093, 1.0, 0.310,                  //
      -62.5, 0, -3.0, 1.99,                  //
      7.67, 0, -0.262, -0.629;
  ExpectPrinted(model.A.block(0, 0, 4, 4), longitudinal, kShare, kLastDigit);
  ExpectPrinted(model.A.block(kSideslip, kSideslip, 4, 4), lateral, kShare, kLastDigit);
  EXPECT_NEAR(model.B(kTrueAirspeed, 0), 0.314, kLastDigit);
  EXPECT_NEAR(model.B(kTrueAirspeed, 1), -0.244, kLastDigit);
  EXPECT_NEAR(model.B(kPitchRate, 1), -0.199, kLastDigit);
  EXPECT_NEAR(model.B(kRollRate, 2), -0.645, kLastDigit);
  EXPECT_NEAR(model.B(kYawRate, 3), -0.0657, kLastDigit);
  // Load factor by speed, alpha, pitch rate and elevator.
  EXPECT_NEAR(model.C(0, kTrueAirspeed), 0.0208, kLastDigit);
  EXPECT_NEAR(model.C(0, kAngleOfAttack), 15.2, kShare * 15.2);
  EXPECT_NEAR(model.C(0, kPitchRate), 1.45, kShare * 1.45);
  EXPECT_NEAR(model.D(0, 1), 0.0333, kLastDigit);
}

// With the centre of gravity aft, the short period is two real modes, of which one grows.
TEST(StevensLewis, AnUnstableAircraftHasARealShortPeriod) {
  const std::vector<FlightMode> modes = FindFlightModes(BookModel(0.38, 0));
  const auto is_short = [](const FlightMode& mode) { return mode.name == "short period, real"; };
  EXPECT_EQ(std::count_if(modes.begin(), modes.end(), is_short), 2);
  const auto grows = std::find_if(modes.begin(), modes.end(), [](const FlightMode& mode) {
    return std::isfinite(mode.time_to_double_s());
  });
  ASSERT_NE(grows, modes.end());
  EXPECT_TRUE(is_short(*grows)) << grows->name;
}

TEST(StevensLewis, ModesAreThoseOfSection38) {
  constexpr Tolerance kDigits{1.5e-3, "digits printed, and what couples the axes"};
  const struct {
    std::string name;
    std::complex<double> eigenvalue;
  } printed[] = {{"short period", {-1.2039, 1.4922}},
                 {"phugoid", {-0.0087, 0.0739}},
                 {"Dutch roll", {-0.4399, 3.220}},
                 {"roll", {-3.601, 0}},
                 {"spiral", {-0.0128, 0}}};
  const std::vector<FlightMode> modes = FindFlightModes(BookModel(0.30, 0));
  ASSERT_EQ(modes.size(), std::size(printed));
  for (std::size_t i = 0; i < modes.size(); ++i) {
    EXPECT_EQ(modes[i].name, printed[i].name);
    EXPECT_LT(std::abs(modes[i].eigenvalue - printed[i].eigenvalue),
              kDigits * std::max(0.1, std::abs(printed[i].eigenvalue)))
        << modes[i].name << ": " << modes[i].eigenvalue;
  }
}

}  // namespace
}  // namespace skein
