// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/trim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/registry.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"
#include "envs/tuning/flight_envelope.h"
#include "tests/envs/f16_at.h"
#include "tests/error_message.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

TrimRequest Level(double altitude_ft, double speed_ft_s) {
  TrimRequest request;
  request.altitude_ft = altitude_ft;
  request.true_airspeed_ft_s = speed_ft_s;
  return request;
}

// University of Minnesota model, 9843 ft and 393.72 ft/s, as found by a search (fminsearch) that
// stopped with residuals of about 1e-3 ft/s^2 and held the wings level, leaving the side force
// unbalanced.
constexpr Tolerance kSearchThrust{0.2, "residual of the published search, lbf"};
constexpr Tolerance kSearchDeflection{3e-4, "residual of the published search, deg"};
constexpr Tolerance kSearchRudder{1e-3, "side force that the published search leaves, deg"};
constexpr Tolerance kSearchAlpha{1e-5, "residual of the published search, rad"};
TEST(Trim, ReproducesThePublishedTrimOfTheMinnesotaModel) {
  const TrimPoint trim = Trim(F16At(0.30), Level(9843, 393.72));
  EXPECT_NEAR(trim.controls.thrust_lbf, 2279.085, kSearchThrust);
  EXPECT_NEAR(trim.controls.elevator_deg, -2.979732, kSearchDeflection);
  EXPECT_NEAR(trim.controls.aileron_deg, 0.008746, kSearchDeflection);
  EXPECT_NEAR(trim.controls.rudder_deg, 0.068030, kSearchRudder);
  EXPECT_NEAR(trim.alpha_rad, 0.1156095, kSearchAlpha);
}

// The same model with the centre of gravity at 0.25 chord, 10000 ft and 700 ft/s, as published with
// a model predictive low-level policy; digits as printed, found by a search as above.
TEST(Trim, ReproducesThePublishedTrimWithTheForwardCentreOfGravity) {
  constexpr Tolerance kPrintedDeflection{1e-4, "digits printed"};
  constexpr Tolerance kPrintedFlap{1e-3, "digits printed, at the search's alpha"};
  const TrimPoint trim = Trim(F16At(0.25), Level(10000, 700));
  EXPECT_NEAR(trim.controls.thrust_lbf, 2886.6468, kSearchThrust);
  EXPECT_NEAR(trim.controls.elevator_deg, -2.0385, kSearchDeflection);
  EXPECT_NEAR(trim.controls.aileron_deg, -0.087577, kPrintedDeflection);
  EXPECT_NEAR(trim.controls.rudder_deg, -0.03877, kPrintedDeflection);
  EXPECT_NEAR(trim.controls.leading_edge_flap_deg, 0.3986, kPrintedFlap);
}

// Its angle of attack is published beside it for the centre of gravity at 0.30 chord.
TEST(Trim, ReproducesThePublishedAngleOfAttackAt700FeetPerSecond) {
  constexpr Tolerance kPrintedAlpha{5e-4, "digits printed"};
  EXPECT_NEAR(Trim(F16At(0.30), Level(10000, 700)).alpha_rad * kDegPerRad, 1.0721, kPrintedAlpha);
}

// An independent implementation of this model; its pitch angle leaves the bank out of the climb
// constraint, which weighs 0.14 lbf of thrust and nothing else.
TEST(Trim, AgreesWithAnIndependentTrim) {
  constexpr Tolerance kBankInClimb{0.15, "the bank in its climb constraint, lbf"};
  constexpr Tolerance kIndependentDigits{1e-5, "digits known"};
  constexpr Tolerance kIndependentFlap{1e-4, "digits known"};
  constexpr Tolerance kBankDigits{1e-3, "digits known"};
  const TrimPoint trim = Trim(F16At(0.30), Level(15000, 500));
  EXPECT_NEAR(trim.controls.thrust_lbf, 2109.8057, kBankInClimb);
  EXPECT_NEAR(trim.controls.elevator_deg, -2.244318, kIndependentDigits);
  EXPECT_NEAR(trim.controls.aileron_deg, -0.09363, kIndependentDigits);
  EXPECT_NEAR(trim.controls.rudder_deg, 0.09423, kIndependentDigits);
  EXPECT_NEAR(trim.controls.leading_edge_flap_deg, 6.2825, kIndependentFlap);
  EXPECT_NEAR(trim.alpha_rad * kDegPerRad, 4.53134, kIndependentDigits);
  EXPECT_NEAR(trim.bank_rad * kDegPerRad, 0.757, kBankDigits);
}

class TrimmedFlight : public ::testing::TestWithParam<TrimRequest> {};

// Steady flight is steady: speed, climb and turn rate are those asked for, and ten seconds later
// the aircraft still flies so (its modes are slow or stable at these points).
TEST_P(TrimmedFlight, StaysAsAskedFor) {
  constexpr Tolerance kSteady{1e-7, "residuals grown over ten seconds"};
  constexpr Tolerance kResidual{1e-10, "residual at which the search ends"};
  constexpr Tolerance kSpeedRounding{1e-9, "float64 rounding of 1000 ft/s"};
  constexpr Tolerance kRounding{1e-12, "float64 rounding"};
  const TrimRequest& request = GetParam();
  const Plant plant = F16At(0.30);
  const TrimPoint trim = Trim(plant, request);
  EXPECT_LT(trim.residual, kResidual);
  // The atmosphere changes under a climb: the balance is instantaneous there.
  const PlantOutput now = plant.Evaluate(trim.state, trim.controls);
  EXPECT_LT(now.state_rate.head<6>().cwiseAbs().maxCoeff(), kResidual);
  EXPECT_NEAR(now.air.true_airspeed_ft_s, request.true_airspeed_ft_s, kSpeedRounding);
  EXPECT_NEAR(-now.state_rate[kDown],
              request.true_airspeed_ft_s * std::sin(request.flight_path_angle_rad), kSpeedRounding);
  EXPECT_NEAR(now.air.beta_rad, 0, kRounding);
  if (request.flight_path_angle_rad == 0) {
    RigidBodyState state = trim.state;
    for (int i = 0; i < 500; ++i) state = plant.StepRk4(state, trim.controls, 0.02);
    EXPECT_LT((state.head<6>() - trim.state.head<6>()).norm(), kSteady);
    const double yaw = EulerFromQuaternion(state.segment<4>(kQ0)).yaw;
    EXPECT_NEAR(std::remainder(yaw - 10 * request.turn_rate_rad_s, 2 * M_PI), 0, kSteady);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Conditions, TrimmedFlight,
    ::testing::Values(TrimRequest{15000, 500, 0, 0}, TrimRequest{20000, 900, 0, 0},
                      TrimRequest{35000, 900, 0, 0}, TrimRequest{15000, 700, 0.1, 0},
                      TrimRequest{15000, 700, -0.15, 0}, TrimRequest{15000, 600, 0, 0.1},
                      TrimRequest{15000, 600, 0, -0.1}, TrimRequest{5000, 700, 0.1, 0.2}));

// Turns without sideslip: tan(bank) = V turn rate / g for a level one, to what the fuselage's side
// force and the inclination of the thrust leave (the asymmetric tables alone ask for half a degree
// of bank).
TEST(Trim, TurnsAreNearlySymmetric) {
  constexpr Tolerance kAsymmetryDeg{1.5, "asymmetric tables, side force and inclined thrust"};
  constexpr Tolerance kAsymmetryAlphaRad{2e-4, "asymmetric tables"};
  constexpr Tolerance kAsymmetryElevatorDeg{0.02, "asymmetric tables"};
  constexpr Tolerance kAsymmetryThrust{1e-3, "asymmetric tables, relative"};
  const Plant plant = F16At(0.30);
  for (double turn_rate : {0.02, 0.05, 0.1}) {
    TrimRequest request = Level(15000, 600);
    request.turn_rate_rad_s = turn_rate;
    const TrimPoint right = Trim(plant, request);
    request.turn_rate_rad_s = -turn_rate;
    const TrimPoint left = Trim(plant, request);
    const double bank_deg = std::atan(600 * turn_rate / kGravityFtS2) * kDegPerRad;
    EXPECT_NEAR(right.bank_rad * kDegPerRad, bank_deg, kAsymmetryDeg);
    EXPECT_NEAR(left.bank_rad * kDegPerRad, -bank_deg, kAsymmetryDeg);
    EXPECT_NEAR(right.alpha_rad, left.alpha_rad, kAsymmetryAlphaRad);
    EXPECT_NEAR(right.controls.elevator_deg, left.controls.elevator_deg, kAsymmetryElevatorDeg);
    EXPECT_NEAR(right.controls.thrust_lbf / left.controls.thrust_lbf, 1, kAsymmetryThrust);
  }
}

TEST(Trim, ClimbingTakesTheThrustOfTheSlope) {
  constexpr Tolerance kChangeOfDrag{0.02, "drag changes with the load, of the weight's share"};
  const Plant plant = F16At(0.30);
  const double weight = plant.aircraft().airframe.mass_slug * kGravityFtS2;
  TrimRequest request = Level(15000, 600);
  const double level = Trim(plant, request).controls.thrust_lbf;
  for (double angle : {-0.1, 0.05, 0.1}) {
    request.flight_path_angle_rad = angle;
    const double thrust = Trim(plant, request).controls.thrust_lbf;
    EXPECT_NEAR(thrust - level, weight * std::sin(angle), kChangeOfDrag * weight * std::abs(angle));
  }
}

TEST(Trim, PowerGivesTheThrustOrAllThereIs) {
  constexpr Tolerance kThrustRounding{1e-6, "float64 rounding there and back"};
  const Plant plant = F16At(0.30);
  const TrimPoint easy = Trim(plant, Level(15000, 500));
  const double mach = plant.Evaluate(easy.state, easy.controls).air.mach;
  EXPECT_NEAR(Thrust(plant.aircraft().engine, easy.power, 15000, mach), easy.controls.thrust_lbf,
              kThrustRounding);
  EXPECT_EQ(Trim(plant, Level(40000, 320)).power, 100);
}

TEST(Trim, StartingFromANeighbourGivesTheSameFlight) {
  constexpr Tolerance kStateRounding{1e-8, "residual at which the search ends"};
  constexpr Tolerance kThrustRounding{1e-6, "residual at which the search ends, lbf"};
  const Plant plant = F16At(0.35);
  const TrimPoint neighbour = Trim(plant, Level(20000, 650));
  const TrimPoint direct = Trim(plant, Level(21000, 600));
  const TrimPoint warm = Trim(plant, Level(21000, 600), neighbour);
  EXPECT_LT((direct.state - warm.state).norm(), kStateRounding);
  EXPECT_NEAR(direct.controls.thrust_lbf, warm.controls.thrust_lbf, kThrustRounding);
}

class TrimOfEveryAircraft : public ::testing::TestWithParam<std::string> {
 protected:
  double Stall() const {
    const Airframe& airframe = plant_.aircraft().airframe;
    const double lift = GreatestLiftAtSeaLevel().coefficient;
    return std::sqrt(
        2 * airframe.mass_slug * plant_.gravity().At(0) /
        (AirAt(plant_.atmosphere(), 0).density_slug_ft3 * airframe.wing_area_ft2 * lift));
  }

  GreatestLift GreatestLiftAtSeaLevel() const {
    return FindGreatestLift(plant_, 0, Fastest() / 2, 0.5);
  }

  double Fastest() const {
    return plant_.aircraft().engine.mach.back() * AirAt(plant_.atmosphere(), 0).sound_speed_ft_s;
  }

  const Plant plant_{LoadAircraft(GetParam()), AtmosphereModel::kStandard1976};
};

// Faster level flight takes less lift, hence less alpha on the near side of the stall. Beyond it
// alpha would rise with speed.
TEST_P(TrimOfEveryAircraft, LessAlphaAtEveryFasterSpeed) {
  constexpr double kSpeedStep = 2;
  // The tail's load takes a part of the lift, and the Aerosonde's elevator ends at half above.
  constexpr double kSlowestOverStall = 1.6;
  const double stall = Stall(), stall_alpha = GreatestLiftAtSeaLevel().alpha_deg / kDegPerRad;
  double slowest = 0, last = stall_alpha;
  for (double speed = 1.02 * stall; speed < Fastest(); speed += kSpeedStep) {
    SCOPED_TRACE(std::to_string(speed) + " ft/s");
    const std::string failure = MessageOf([&] {
      const double alpha = Trim(plant_, Level(0, speed)).alpha_rad;
      if (slowest == 0) slowest = speed;
      EXPECT_LT(alpha, last);
      last = alpha;
    });
    // Flight has a slowest speed, and no gap above it.
    EXPECT_TRUE(failure.empty() || slowest == 0) << failure;
  }
  EXPECT_GT(slowest, 0);
  EXPECT_LT(slowest, kSlowestOverStall * stall);
}

// What climbs climbs, and what dives dives, or it is refused.
TEST_P(TrimOfEveryAircraft, SteepFlightGoesWhereItWasAskedTo) {
  constexpr Tolerance kSpeedRounding{1e-4,
                                     "near the vertical the sine hardly knows the angle, ft/s"};
  const double speed = 2 * Stall();
  for (const double path_deg : {-90, -84, -60, 60, 84, 90}) {
    SCOPED_TRACE(path_deg);
    TrimRequest request = Level(0, speed);
    request.flight_path_angle_rad = path_deg / kDegPerRad;
    const std::string failure = MessageOf([&] {
      const TrimPoint trim = Trim(plant_, request);
      EXPECT_NEAR(-plant_.Evaluate(trim.state, trim.controls).state_rate[kDown],
                  speed * std::sin(request.flight_path_angle_rad), kSpeedRounding);
    });
    EXPECT_TRUE(failure.empty() || std::abs(path_deg) > 80) << failure;
  }
}

INSTANTIATE_TEST_SUITE_P(Aircraft, TrimOfEveryAircraft, ::testing::ValuesIn(AircraftNames()),
                         [](const auto& test) { return test.param; });

// The same speed has two flights: which one is found is what the start asks for.
TEST(Trim, StaysBeyondTheStallOnlyWhereItStartsThere) {
  constexpr Tolerance kStateRounding{1e-8, "residual at which the search ends"};
  constexpr double kStallAlphaDeg = 15;
  const Plant plant(LoadAircraft("cessna172"), AtmosphereModel::kStandard1976);
  const TrimPoint below = Trim(plant, Level(0, 98));
  EXPECT_LT(below.alpha_rad * kDegPerRad, kStallAlphaDeg);
  const TrimPoint from_faster = Trim(plant, Level(0, 98), Trim(plant, Level(0, 200)));
  EXPECT_LT((from_faster.state - below.state).norm(), kStateRounding);

  TrimPoint start = below;
  start.alpha_rad = 17 / kDegPerRad;
  start.controls.thrust_lbf *= 2;
  const TrimPoint beyond = Trim(plant, Level(0, 98), start);
  EXPECT_GT(beyond.alpha_rad * kDegPerRad, kStallAlphaDeg);
  EXPECT_GT(beyond.controls.thrust_lbf, below.controls.thrust_lbf);
  const TrimPoint slower = Trim(plant, Level(0, 96), beyond);
  EXPECT_GT(slower.alpha_rad * kDegPerRad, kStallAlphaDeg);
}

TEST(Trim, RefusesWhatCannotBeFlownAndSaysWhere) {
  const Plant plant = F16At(0.30);
  const std::string slow = MessageOf([&] { Trim(plant, Level(45000, 150)); });
  EXPECT_THAT(slow, testing::HasSubstr("45000 ft"));
  EXPECT_THAT(slow, testing::HasSubstr("150 ft/s"));
  TrimRequest vertical = Level(10000, 600);
  for (const double path_deg : {90, -90}) {
    vertical.flight_path_angle_rad = path_deg / kDegPerRad;
    EXPECT_THAT(MessageOf([&] { Trim(plant, vertical); }), testing::HasSubstr("vertical"));
  }
  EXPECT_THROW(Trim(plant, Level(15000, 0)), Error);
  EXPECT_THROW(Trim(plant, Level(15000, std::nan(""))), Error);
}

}  // namespace
}  // namespace skein
