// SPDX-License-Identifier: Apache-2.0
#include "envs/flight_reset.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/choice_error.h"
#include "envs/air/gravity.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16.h"
#include "envs/state/attitude.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

FreshFlight DrawOf(const FlightReset& reset, std::uint32_t episode) {
  simd::RandomStream random({7, 0, episode, 0, simd::RandomPurpose::kInitialState});
  return reset.Draw(&random);
}

double At(const FreshFlight& flight, int column) {
  return flight.columns[static_cast<std::size_t>(column)];
}

RigidBodyState BodyOf(const FreshFlight& flight) {
  RigidBodyState state;
  for (int i = 0; i < kNumRigidBody; ++i) state[i] = At(flight, i);
  return state;
}

SurfaceAngles SurfacesOf(const FreshFlight& flight) {
  return {At(flight, kElevator), At(flight, kAileron), At(flight, kRudder),
          At(flight, kLeadingEdgeFlap)};
}

/// What the float64 plant makes of a fresh flight.
PlantOutput EvaluateFresh(const Plant& plant, const FreshFlight& flight) {
  const RigidBodyState state = BodyOf(flight);
  const SurfaceAngles surfaces = SurfacesOf(flight);
  Controls controls;
  controls.thrust_lbf = Thrust(plant.aircraft().engine, At(flight, kPower), -At(flight, kDown),
                               MeasureAir(plant.atmosphere(), state).mach);
  controls.elevator_deg = surfaces.elevator_deg;
  controls.aileron_deg = surfaces.aileron_deg;
  controls.rudder_deg = surfaces.rudder_deg;
  controls.leading_edge_flap_deg = surfaces.leading_edge_flap_deg;
  return plant.Evaluate(state, controls);
}

constexpr int kDraws = 400;

constexpr Tolerance kFloat32{1e-6, "float32 rounding"};
constexpr Tolerance kPullError{0.1, "lift of the pitch rate, and its curve over alpha"};
constexpr Tolerance kStartRounding{1e-3, "float32 rounding of 2e4 ft and 1000 ft/s"};

/// Holds that they lie in [-1, 1], with the moments of a uniform variable there.
void ExpectUniform(const std::vector<double>& shares) {
  double sum = 0, squares = 0;
  for (const double share : shares) {
    EXPECT_LE(std::abs(share), 1 + kFloat32);
    sum += share;
    squares += share * share;
  }
  const auto count = static_cast<double>(shares.size());
  EXPECT_NEAR(sum / count, 0, kStandardErrors * std::sqrt(1.0 / 3 / count));
  EXPECT_NEAR(squares / count, 1.0 / 3, kStandardErrors * std::sqrt(4.0 / 45 / count));
}

TEST(FlightResetTest, DrawsAltitudeAndSpeedUniformly) {
  EnvConfig config;
  config.initial.altitude_ft = {15000, 25000};
  config.initial.true_airspeed_fps = {700, 1100};
  const FlightReset reset(config, F16());
  double altitude_sum = 0, speed_sum = 0, product_sum = 0;
  for (std::uint32_t episode = 0; episode < kDraws; ++episode) {
    const FreshFlight flight = DrawOf(reset, episode);
    // In units of the ranges' halves, from their middles. Float32 rounds at their ends.
    const double altitude = (-At(flight, kDown) - 20000) / 5000;
    const double speed = (BodyOf(flight).segment<3>(kU).norm() - 900) / 200;
    const double kEnd = 1 + kFloat32;
    EXPECT_LE(std::abs(altitude), kEnd);
    EXPECT_LE(std::abs(speed), kEnd);
    EXPECT_NEAR(flight.start.altitude_ft, -At(flight, kDown), kStartRounding);
    EXPECT_NEAR(flight.start.true_airspeed_ft_s, 900 + 200 * speed, kStartRounding);
    altitude_sum += altitude;
    speed_sum += speed;
    product_sum += altitude * speed;
  }
  // Of the mean of a uniform variable on [-1, 1], and of the product of two independent ones.
  const double mean_tolerance = kStandardErrors * std::sqrt(1.0 / 3 / kDraws);
  EXPECT_NEAR(altitude_sum / kDraws, 0, mean_tolerance);
  EXPECT_NEAR(speed_sum / kDraws, 0, mean_tolerance);
  EXPECT_NEAR(product_sum / kDraws, 0, kStandardErrors * std::sqrt(1.0 / 9 / kDraws));
}

TEST(FlightResetTest, TrainingBeginsLowerAndEvaluationsDoNot) {
  EnvConfig config;
  config.initial.training_altitude_min_ft = 5000;
  const FlightReset training(config, F16()), evaluation(EvaluationConfig(config), F16()),
      plain(EnvConfig{}, F16());
  int low = 0;
  for (std::uint32_t episode = 0; episode < kDraws; ++episode) {
    const double altitude = DrawOf(training, episode).start.altitude_ft;
    EXPECT_GE(altitude, 5000);
    EXPECT_LE(altitude, 20000);
    low += altitude < 12500;
    EXPECT_EQ(DrawOf(evaluation, episode).columns, DrawOf(plain, episode).columns);
  }
  EXPECT_NEAR(low, kDraws / 2.0, 4 * std::sqrt(kDraws / 4.0));  // four standard deviations

  config.initial.training_altitude_min_ft = 19500;  // raises nothing
  EXPECT_EQ(DrawOf(FlightReset(config, F16()), 3).columns, DrawOf(plain, 3).columns);
}

TEST(FlightResetTest, TrainingBeginsSlowerAndEvaluationsDoNot) {
  EnvConfig config, slow;
  config.initial.training_true_airspeed_min_fps = slow.initial.true_airspeed_fps.min = 500;
  FlightReset training(config, F16()), slower(slow, F16());
  const FlightReset evaluation(EvaluationConfig(config), F16()), plain(EnvConfig{}, F16());
  for (const double share : {0.0, 0.5, 1.0}) {
    training.SetShare(share);
    slower.SetShare(share);
    for (std::uint32_t episode = 0; episode < kDraws; ++episode) {
      EXPECT_EQ(DrawOf(training, episode).columns, DrawOf(slower, episode).columns);
    }
  }
  for (std::uint32_t episode = 0; episode < kDraws; ++episode) {
    EXPECT_EQ(DrawOf(evaluation, episode).columns, DrawOf(plain, episode).columns);
  }

  config.initial.training_true_airspeed_min_fps = 1100;  // raises nothing
  EXPECT_EQ(DrawOf(FlightReset(config, F16()), 3).columns, DrawOf(plain, 3).columns);
}

/// Holds that flights of `config` begin as others do but for `angle`, which is uniformly up to
/// `most_rad` beside, and that evaluations begin as others do.
void ExpectBegunAside(const EnvConfig& config, double EulerAngles::*angle, double most_rad) {
  const FlightReset training(config, F16()), evaluation(EvaluationConfig(config), F16()),
      plain(EnvConfig{}, F16());
  std::vector<double> shares;
  for (std::uint32_t episode = 0; episode < kDraws; ++episode) {
    const FreshFlight aside = DrawOf(training, episode), level = DrawOf(plain, episode);
    const EulerAngles attitude = EulerFromQuaternion(BodyOf(aside).segment<4>(kQ0));
    EulerAngles expected = EulerFromQuaternion(BodyOf(level).segment<4>(kQ0));
    shares.push_back((attitude.*angle - expected.*angle) / most_rad);
    expected.*angle = attitude.*angle;
    EXPECT_NEAR(attitude.roll, expected.roll, kFloat32);
    EXPECT_NEAR(attitude.pitch, expected.pitch, kFloat32);
    EXPECT_NEAR(attitude.yaw, expected.yaw, kFloat32);
    for (int column = 0; column < kNumColumns; ++column) {
      if (column >= kQ0 && column <= kQz) continue;
      EXPECT_EQ(At(aside, column), At(level, column)) << column;
    }
    EXPECT_EQ(aside.start.pitch_rad, level.start.pitch_rad);
    EXPECT_EQ(DrawOf(evaluation, episode).columns, level.columns);
  }
  ExpectUniform(shares);
}

TEST(FlightResetTest, TrainingBeginsBankedAndEvaluationsDoNot) {
  EnvConfig config;
  config.initial.training_bank_max_deg = 90;
  ExpectBegunAside(config, &EulerAngles::roll, M_PI / 2);
}

TEST(FlightResetTest, TrainingBeginsInClimbsAndDescentsAndEvaluationsDoNot) {
  EnvConfig config;
  config.initial.training_climb_max_deg = 30;
  ExpectBegunAside(config, &EulerAngles::pitch, M_PI / 6);
}

TEST(FlightResetTest, PullsKeepAwayFromTheLoadFactorThatEndsFlights) {
  EnvConfig config;
  config.initial.training_load_factor_max = 7;
  EXPECT_EQ(config.starting_load_factor_max(), 7) << "of the F-16's 10 g";
  config.termination.max_load_factor = 5;
  constexpr double kMost = 3.5;
  EXPECT_DOUBLE_EQ(config.starting_load_factor_max(), kMost);
  const FlightReset reset(config, F16());
  double most = 0;
  for (std::uint32_t episode = 0; episode < kDraws; ++episode) {
    most = std::max(most, static_cast<double>(At(DrawOf(reset, episode), kNz)));
  }
  EXPECT_LT(most, kMost);
  EXPECT_GT(most, 0.9 * kMost);
  config.termination.max_load_factor = 1.2;
  EXPECT_EQ(config.starting_load_factor_max(), 1);
}

TEST(FlightResetTest, TrainingBeginsInAPullAndEvaluationsDoNot) {
  EnvConfig config;
  config.initial.training_load_factor_max = 7;
  const FlightReset training(config, F16()), evaluation(EvaluationConfig(config), F16()),
      plain(EnvConfig{}, F16());
  const Plant plant(F16(), config.atmosphere);
  std::vector<double> shares;
  for (std::uint32_t episode = 0; episode < kDraws; ++episode) {
    const FreshFlight pulled = DrawOf(training, episode), level = DrawOf(plain, episode);
    const double more_g = At(pulled, kNz) - At(level, kNz);
    shares.push_back(more_g / 3 - 1);
    const double flown_g = EvaluateFresh(plant, pulled).nz - EvaluateFresh(plant, level).nz;
    EXPECT_NEAR(flown_g, more_g, kPullError * more_g + kFloat32);
    const RigidBodyState state = BodyOf(pulled), before = BodyOf(level);
    EXPECT_NEAR(state.segment<3>(kU).norm(), before.segment<3>(kU).norm(), kStartRounding);
    EXPECT_NEAR(state[kQ], more_g * kGravityFtS2 / before.segment<3>(kU).norm(), kFloat32);
    EXPECT_EQ(state.segment<4>(kQ0), before.segment<4>(kQ0));
    for (const int column : {kElevator, kAileron, kRudder, kLeadingEdgeFlap, kPower, kNy}) {
      EXPECT_EQ(At(pulled, column), At(level, column)) << column;
    }
    EXPECT_EQ(DrawOf(evaluation, episode).columns, level.columns);
  }
  ExpectUniform(shares);
}

// Load factors are in multiples of kGravityFtS2: so is what bends the path.
TEST(FlightResetTest, APullBendsThePathByItsLoadFactorInAnyGravity) {
  for (const double gravity_ft_s2 : {20.0, kGravityFtS2, 40.0}) {
    EnvConfig config;
    config.gravity.at_sea_level_ft_s2 = gravity_ft_s2;
    const FlightReset plain(config, F16());
    config.initial.training_load_factor_max = 5;
    const FlightReset training(config, F16());
    for (std::uint32_t episode = 0; episode < 20; ++episode) {
      const FreshFlight pulled = DrawOf(training, episode), level = DrawOf(plain, episode);
      const double more_g = At(pulled, kNz) - At(level, kNz);
      EXPECT_NEAR(At(pulled, kQ) * BodyOf(level).segment<3>(kU).norm() / kGravityFtS2, more_g,
                  kStartRounding)
          << gravity_ft_s2;
    }
  }
}

TEST(FlightResetTest, NamesTheStartsThatAreNoSteadyFlight) {
  EnvConfig config;
  config.initial.true_airspeed_fps.min = 100;  // below the stall
  config.termination.min_mach = 0;
  try {
    FlightReset(config, F16());
    FAIL() << "it flew";
  } catch (const ChoiceError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("flights cannot begin in all of env.initial: no ", 0),
              0u)
        << error.what();
  }
}

TEST(FlightResetTest, RefusesStartsThatEndAtOnce) {
  EnvConfig config;
  config.termination.max_mach = 1.1;  // 1200 ft/s at 20,000 ft is Mach 1.16
  EXPECT_THROW(FlightReset(config, F16()), ChoiceError);
  config.termination.max_mach = 1.2;
  config.termination.min_mach = 0.95;  // 1000 ft/s at 19,000 ft is Mach 0.96
  EXPECT_NO_THROW(FlightReset(config, F16()));
  config.initial.training_altitude_min_ft = 10000;  // Mach 0.93
  EXPECT_THROW(FlightReset(config, F16()), ChoiceError);
  config.initial.training_altitude_min_ft = 0;
  config.termination.min_mach = 0.97;
  EXPECT_THROW(FlightReset(config, F16()), ChoiceError);
  config.termination.min_mach = 0.95;
  config.termination.training_min_mach = 0.97;
  EXPECT_THROW(FlightReset(config, F16()), ChoiceError);
  config.termination.training_min_mach = 0.9;
  EXPECT_NO_THROW(FlightReset(config, F16()));
  config.initial.training_true_airspeed_min_fps = 900;  // Mach 0.87
  EXPECT_THROW(FlightReset(config, F16()), ChoiceError);
}

TEST(FlightResetTest, DependsOnTheStreamAlone) {
  const FlightReset one(EnvConfig{}, F16()), other(EnvConfig{}, F16());
  DrawOf(other, 5);
  EXPECT_EQ(DrawOf(one, 3).columns, DrawOf(other, 3).columns);
  EXPECT_NE(DrawOf(one, 3).columns, DrawOf(one, 4).columns);
}

TEST(FlightResetTest, FliesNorthFromTheOriginWithoutTurning) {
  for (const bool trimmed : {true, false}) {
    EnvConfig config;
    config.initial.trimmed = trimmed;
    const FlightReset reset(config, F16());
    for (std::uint32_t episode = 0; episode < 20; ++episode) {
      const FreshFlight flight = DrawOf(reset, episode);
      for (const int column : {kNorth, kEast, kP, kQ, kR, kV}) EXPECT_EQ(At(flight, column), 0);
      const RigidBodyState state = BodyOf(flight);
      const EulerAngles attitude = EulerFromQuaternion(state.segment<4>(kQ0));
      EXPECT_NEAR((state.segment<4>(kQ0).norm()), 1, kFloat32);
      EXPECT_NEAR(attitude.yaw, 0, kFloat32);
      EXPECT_NEAR(attitude.pitch, flight.start.pitch_rad, kFloat32);
      EXPECT_EQ(flight.start.yaw_rad, 0);
      EXPECT_EQ(At(flight, kPowerCommand), At(flight, kPower));
    }
  }
}

TEST(FlightResetTest, TrimmedStartsAreSteadyFlight) {
  // A start without trim has 1 g, three hundred times as much.
  constexpr Tolerance kAcceleration{0.1, "trims between nodes, and the tables' kinks"};
  constexpr Tolerance kAngularAcceleration{3e-3, "trims between nodes, and the tables' kinks"};
  constexpr Tolerance kClimb{1e-4, "float32 columns"};
  constexpr Tolerance kLoadFactor{3e-3, "trims between nodes"};
  const EnvConfig config;
  const Plant plant(F16(), config.atmosphere);
  const FlightReset reset(config, F16());
  for (std::uint32_t episode = 0; episode < 50; ++episode) {
    const FreshFlight flight = DrawOf(reset, episode);
    const PlantOutput output = EvaluateFresh(plant, flight);
    for (const int column : {kU, kV, kW}) EXPECT_NEAR(output.state_rate[column], 0, kAcceleration);
    for (const int column : {kP, kQ, kR}) {
      EXPECT_NEAR(output.state_rate[column], 0, kAngularAcceleration);
    }
    EXPECT_NEAR(output.state_rate[kDown], 0, kClimb);
    EXPECT_NEAR(output.nz, At(flight, kNz), kLoadFactor);
    EXPECT_NEAR(output.ny, At(flight, kNy), kLoadFactor);
  }
}

TEST(FlightResetTest, FlightControlIsAtRest) {
  constexpr Tolerance kAtRest{1e-5, "float32 columns, over a second of the same readings"};
  constexpr Tolerance kFlap{0.05, "float32 columns, through the flap's slow filter"};
  for (const bool trimmed : {true, false}) {
    EnvConfig config;
    config.initial.trimmed = trimmed;
    const FlightReset reset(config, F16());
    const FlightControl flight_control(F16(), config.flight_control, config.control_interval_s);
    for (std::uint32_t episode = 0; episode < 20; ++episode) {
      const FreshFlight flight = DrawOf(reset, episode);
      const AirData air = MeasureAir(config.atmosphere, BodyOf(flight));
      FlightSensors sensors;
      sensors.alpha_deg = air.alpha_rad * kDegPerRad;
      sensors.nz = At(flight, kNz);
      sensors.ny = At(flight, kNy);
      sensors.dynamic_pressure_psf = air.dynamic_pressure_psf;
      sensors.static_pressure_psf = air.static_pressure_psf;
      FlightControlState filters;
      for (int i = 0; i < kNumFlightControlStates; ++i) {
        filters[static_cast<std::size_t>(i)] = At(flight, kAlphaFilter + i);
      }
      const SurfaceAngles at_reset = SurfacesOf(flight);
      // Lag and lead filters that were not at rest would move; the pitch integrator may, slowly, by
      // the load factor that differs from one (an untrimmed start is not in equilibrium).
      const SurfaceAngles first = flight_control.Step({}, sensors, &filters);
      EXPECT_NEAR(first.elevator_deg, at_reset.elevator_deg, kAtRest);
      EXPECT_NEAR(first.aileron_deg, at_reset.aileron_deg, kAtRest);
      EXPECT_NEAR(first.rudder_deg, at_reset.rudder_deg, kAtRest);
      if (!trimmed) continue;
      SurfaceAngles last = first;
      for (int step = 0; step < 50; ++step) last = flight_control.Step({}, sensors, &filters);
      EXPECT_NEAR(last.aileron_deg, at_reset.aileron_deg, kAtRest);
      EXPECT_NEAR(last.rudder_deg, at_reset.rudder_deg, kAtRest);
      EXPECT_NEAR(last.leading_edge_flap_deg, at_reset.leading_edge_flap_deg, kFlap);
    }
  }
}

TEST(FlightResetTest, UntrimmedStartsAreLevelWithThePapersThrust) {
  constexpr Tolerance kThrust{1e-3, "thrust of a float32 power"};
  constexpr Tolerance kReading{2e-6, "float32 columns"};
  EnvConfig config;
  config.initial.trimmed = false;
  const Plant plant(F16(), config.atmosphere);
  const FlightReset reset(config, F16());
  for (std::uint32_t episode = 0; episode < 20; ++episode) {
    const FreshFlight flight = DrawOf(reset, episode);
    const double mach = MeasureAir(config.atmosphere, BodyOf(flight)).mach;
    EXPECT_NEAR(Thrust(plant.aircraft().engine, At(flight, kPower), -At(flight, kDown), mach), 2000,
                kThrust);
    for (const int column : {kW, kElevator, kAileron, kRudder, kLeadingEdgeFlap, kQx, kQy}) {
      EXPECT_EQ(At(flight, column), 0) << column;
    }
    const PlantOutput output = EvaluateFresh(plant, flight);
    EXPECT_NEAR(output.nz, At(flight, kNz), kReading);
    EXPECT_NEAR(output.ny, At(flight, kNy), kReading);
  }
}

TEST(FlightResetTest, RangesOfOnePointAndDirectControlDo) {
  EnvConfig config;
  config.flight_control = FlightControlMode::kDirect;
  config.initial.altitude_ft = {12000, 12000};
  config.initial.true_airspeed_fps = {800, 800};
  const FreshFlight flight = DrawOf(FlightReset(config, F16()), 0);
  EXPECT_EQ(At(flight, kDown), -12000);
  EXPECT_NEAR(std::hypot(At(flight, kU), At(flight, kW)), 800, kStartRounding);
}

TEST(FlightResetTest, RefusesStartsThatCannotBeTrimmed) {
  EnvConfig config;
  config.initial.altitude_ft = {45000, 50000};
  config.initial.true_airspeed_fps = {150, 200};
  EXPECT_THROW(FlightReset(config, F16()), Error);
  config.initial.trimmed = false;
  EXPECT_NO_THROW(FlightReset(config, F16()));
}

}  // namespace
}  // namespace skein
