// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/flight_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "envs/aircraft/f16.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kDt = 0.02;
constexpr Tolerance kRounding{1e-12, "float64 rounding"};
constexpr Tolerance kSettled{1e-9, "what the filters leave after 8 s"};
constexpr Tolerance kFilterStart{0.02, "the filter's first steps"};
constexpr Tolerance kDiscreteLeak{0.01, "steps of 0.02 s"};

FlightSensors Level() {
  FlightSensors sensors;
  sensors.alpha_deg = 4;
  sensors.nz = 0.997;
  sensors.ny = -0.01;
  sensors.dynamic_pressure_psf = 250;
  sensors.static_pressure_psf = 1000;
  return sensors;
}

const SurfaceAngles kTrim{-2, 0.1, -0.2, 0};

class FlightControlTest : public ::testing::Test {
 protected:
  SurfaceAngles Run(const PilotCommands& pilot, const FlightSensors& sensors, int steps) {
    SurfaceAngles command;
    for (int i = 0; i < steps; ++i) command = system_.Step(pilot, sensors, &state_);
    return command;
  }
  double& At(Column column) { return state_[column - kAlphaFilter]; }

  Aircraft aircraft_ = F16();
  FlightControl system_{aircraft_, FlightControlMode::kFull, kDt};
  FlightControlState state_ = system_.InitialState(Level(), kTrim);
};

// At every frequency the filter answers as the continuous law does at the frequency that the
// bilinear transform maps it to.
TEST_F(FlightControlTest, FiltersHaveTheFrequencyResponseOfTheirLaws) {
  for (const FirstOrder& law :
       {FirstOrder{0, 50, 50}, FirstOrder{1, 0, 1}, FirstOrder{3, 15, 15}, FirstOrder{1.5, 0, 1}}) {
    const LinearFilter filter = Discretise(law, kDt);
    for (double omega : {0.1, 1.0, 10.0, 100.0}) {
      const std::complex<double> z = std::exp(std::complex<double>(0, omega * kDt));
      const std::complex<double> discrete = (filter.n0 + filter.n1 / z) / (1.0 + filter.d1 / z);
      const std::complex<double> s(0, 2 / kDt * std::tan(omega * kDt / 2));
      EXPECT_LT(std::abs(discrete - (law.b1 * s + law.b0) / (s + law.a0)), kRounding);
    }
  }
}

TEST_F(FlightControlTest, FilterStepsFollowTheDifferenceEquation) {
  const LinearFilter filter = Discretise({3, 12, 12}, kDt);
  double state = filter.SteadyState(1.5);
  double x_before = 1.5, y_before = 1.5;  // unit gain at rest
  for (int i = 0; i < 50; ++i) {
    const double x = std::sin(0.3 * i);
    const double y = filter.Step(x, &state);
    EXPECT_NEAR(y, filter.n0 * x + filter.n1 * x_before - filter.d1 * y_before, kRounding);
    x_before = x;
    y_before = y;
  }
}

TEST_F(FlightControlTest, RampsAreClampedLines) {
  const Ramp ramp{100, -1, 500, -4};
  EXPECT_EQ(Evaluate(ramp, 0), -1);
  EXPECT_EQ(Evaluate(ramp, 300), -2.5);
  EXPECT_EQ(Evaluate(ramp, 900), -4);
}

TEST_F(FlightControlTest, StartsWithTheTrimmedSurfaces) {
  const SurfaceAngles command = Run({}, Level(), 1);
  EXPECT_NEAR(command.elevator_deg, kTrim.elevator_deg, kRounding);
  EXPECT_NEAR(command.aileron_deg, kTrim.aileron_deg, kRounding);
  EXPECT_NEAR(command.rudder_deg, kTrim.rudder_deg, kRounding);
  EXPECT_NEAR(command.leading_edge_flap_deg, SteadyLeadingEdgeFlap(aircraft_, 4, 250, 1000),
              kRounding);
}

TEST_F(FlightControlTest, SticksMoveTheSurfacesTheirWay) {
  EXPECT_LT(Run({0, 0.3, 0, 0}, Level(), 10).elevator_deg, kTrim.elevator_deg);
  EXPECT_LT(Run({0, 0, 0.3, 0}, Level(), 10).aileron_deg, kTrim.aileron_deg);
  state_ = system_.InitialState(Level(), kTrim);
  EXPECT_LT(Run({0, 0, 0, 0.3}, Level(), 10).rudder_deg, kTrim.rudder_deg);
}

// Held at the load factor that the stick asks for, the integrator has nothing left to do.
TEST_F(FlightControlTest, StickAsksForLoadFactor) {
  FlightSensors sensors = Level();
  sensors.nz = 1 + 8 * 0.25;
  Run({0, 0.25, 0, 0}, sensors, 400);
  const double settled = At(kPitchIntegrator);
  Run({0, 0.25, 0, 0}, sensors, 50);
  EXPECT_NEAR(At(kPitchIntegrator), settled, kSettled);
}

// With m = max(|roll|, |yaw|): at most 8 - 3 m g above level, at least g_min (1 - m / 2).
TEST_F(FlightControlTest, CombinedSticksLimitTheLoadFactorCommand) {
  const auto commanded = [&](double pitch, double roll, double yaw) {
    state_ = system_.InitialState(Level(), kTrim);
    const PilotCommands pilot{0, pitch, roll, yaw};
    Run(pilot, Level(), 500);
    // A filter at rest with unit gain: s = y - n0 x = (1 - n0) x.
    return At(kLoadFactorCommandFilter) / (1 - Discretise({0, 8.3, 8.3}, kDt).n0);
  };
  const double g_min = -1 - 3 * (250.0 - 100) / 400;
  EXPECT_NEAR(commanded(1, 0, 0), 8, kSettled);
  EXPECT_NEAR(commanded(1, 1, 0), 5, kSettled);
  EXPECT_NEAR(commanded(1, 0.2, -0.5), 6.5, kSettled);
  EXPECT_NEAR(commanded(-1, 0, 0), g_min, kSettled);
  EXPECT_NEAR(commanded(-1, 0, 1), g_min / 2, kSettled);
  EXPECT_NEAR(commanded(-0.2, 0, 1), 0.2 * g_min, kSettled);
}

TEST_F(FlightControlTest, RollIntegratorWorksOnlyHandsOffAndAtLowAlpha) {
  FlightSensors rolling = Level();
  rolling.roll_rate_deg_s = 2;
  Run({}, rolling, 50);
  // p_f settles within a few steps; 0.2 * 2 deg/s * 1 s, less the filter's start.
  EXPECT_NEAR(At(kRollIntegrator), 0.4, kFilterStart);
  state_ = system_.InitialState(Level(), kTrim);
  Run({0, 0, 0.1, 0}, rolling, 50);
  EXPECT_EQ(At(kRollIntegrator), 0);
  rolling.alpha_deg = 25;
  state_ = system_.InitialState(rolling, kTrim);
  At(kRollIntegrator) = 1;
  Run({}, rolling, 50);
  EXPECT_NEAR(At(kRollIntegrator), std::exp(-0.5), kDiscreteLeak);  // leaks at 0.5 1/s
}

TEST_F(FlightControlTest, IntegratorsAreBounded) {
  FlightSensors wild = Level();
  wild.nz = 30;
  wild.roll_rate_deg_s = 400;
  for (int i = 0; i < 2000; ++i) {
    const SurfaceAngles command = system_.Step({}, wild, &state_);
    EXPECT_LE(std::abs(At(kPitchIntegrator)), 25);
    EXPECT_LE(std::abs(At(kRollIntegrator)), 5);
    EXPECT_LE(std::abs(command.elevator_deg), 25);
    EXPECT_LE(std::abs(command.aileron_deg), 21.5);
    EXPECT_LE(std::abs(command.rudder_deg), 30);
  }
}

TEST_F(FlightControlTest, ElevatorDoesNotWindUp) {
  FlightSensors slow = Level();
  slow.nz = 0.5;
  const PilotCommands full_aft{0, 1, 0, 0};
  Run(full_aft, slow, 500);  // the elevator stands at its stop for 10 s
  int steps = 0;
  slow.nz = 9;
  while (system_.Step({}, slow, &state_).elevator_deg < 0 && steps < 100) ++steps;
  EXPECT_LT(steps * kDt, 0.5);
}

TEST_F(FlightControlTest, DirectModeMovesSurfacesInProportionToTheSticks) {
  const FlightControl direct(aircraft_, FlightControlMode::kDirect, kDt);
  FlightControlState state = direct.InitialState(Level(), kTrim);
  const FlightControlState before = state;
  const SurfaceAngles command = direct.Step({0.5, 1, -0.5, 0.25}, Level(), &state);
  EXPECT_EQ(command.elevator_deg, -25);
  EXPECT_EQ(command.aileron_deg, 10.75);
  EXPECT_EQ(command.rudder_deg, -7.5);
  EXPECT_NEAR(command.leading_edge_flap_deg, 1.38 * 4 - 9.05 * 0.25 + 1.45, kRounding);
  EXPECT_EQ(state, before);
}

TEST_F(FlightControlTest, FullStickIsTheLimitOfItsSideInDirectMode) {
  aircraft_.actuators.elevator.min_deg = -28;
  aircraft_.actuators.elevator.max_deg = 23;
  const FlightControl direct(aircraft_, FlightControlMode::kDirect, kDt);
  const auto elevator = [&](double stick) {
    return direct.Step({0.5, stick, 0, 0}, Level(), &state_).elevator_deg;
  };
  EXPECT_EQ(elevator(1), -28);
  EXPECT_EQ(elevator(0.5), -14);
  EXPECT_EQ(elevator(0), 0);
  EXPECT_EQ(elevator(-1), 23);
}

TEST_F(FlightControlTest, SteadyFlapStaysWithinItsLimits) {
  EXPECT_NEAR(SteadyLeadingEdgeFlap(aircraft_, 10, 100, 1000), 13.8 - 0.905 + 1.45, kRounding);
  EXPECT_EQ(SteadyLeadingEdgeFlap(aircraft_, 40, 100, 1000), 25);
  EXPECT_EQ(SteadyLeadingEdgeFlap(aircraft_, -5, 700, 1000), 0);
}

}  // namespace
}  // namespace skein
