// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include "envs/autopilot/estimator-inl.h"
#include "envs/state/attitude.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

constexpr double kDt = 0.02;

Measurement<double> SteadyFlight(double roll, double pitch, double alpha, double beta) {
  Measurement<double> measured = {};
  measured.altitude = 20000;
  measured.true_airspeed = 1000;
  measured.roll = roll;
  measured.pitch = pitch;
  measured.alpha = alpha;
  measured.beta = beta;
  return measured;
}

constexpr Tolerance kRounding{1e-9, "float64 rounding"};

TEST(Estimator, BeginsAtTheMeasurement) {
  const Measurement<double> measured = SteadyFlight(0.3, -0.2, 0.1, 0.02);
  FlightEstimate<double> flight = {};
  Estimate(EstimatorGains(), kDt, measured, true, flight);
  EXPECT_EQ(flight.altitude, measured.altitude);
  EXPECT_EQ(flight.speed, measured.true_airspeed);
  EXPECT_EQ(flight.roll, measured.roll);
  EXPECT_EQ(flight.pitch, measured.pitch);
  EXPECT_EQ(flight.alpha, measured.alpha);
  EXPECT_EQ(flight.acceleration, 0);
}

TEST(Estimator, ResolvesTheAirspeedAsTheAttitudeDoes) {
  const Measurement<double> measured = SteadyFlight(0.8, 0.3, 0.15, -0.04);
  FlightEstimate<double> flight = {};
  const Kinematics<double> motion = Estimate(EstimatorGains(), kDt, measured, true, flight);
  const Eigen::Vector3d body(std::cos(0.15) * std::cos(-0.04), std::sin(-0.04),
                             std::sin(0.15) * std::cos(-0.04));
  // With a yaw of zero, heading axes are north, east and up.
  const Eigen::Vector3d ned =
      1000 * BodyFromNed(QuaternionFromEuler({0.8, 0.3, 0})).transpose() * body;
  EXPECT_NEAR(motion.ahead, ned[0], kRounding);
  EXPECT_NEAR(motion.right, ned[1], kRounding);
  EXPECT_NEAR(motion.up, -ned[2], kRounding);
  EXPECT_NEAR(std::sin(motion.climb), -ned[2] / 1000, kRounding);
}

/// What is exact and consistent is followed without lag: kinematics carry the estimate.
TEST(Estimator, FollowsASteadyRollWithoutLag) {
  FlightEstimate<double> flight = {};
  double roll = 0;
  Measurement<double> measured = SteadyFlight(0, 0, 0, 0);
  measured.p = 1;
  Estimate(EstimatorGains(), kDt, measured, true, flight);
  for (int step = 0; step < 500; ++step) {  // 10 rad: more than once around
    roll += kDt * measured.p;
    measured.roll = std::remainder(roll, 2 * M_PI);
    Estimate(EstimatorGains(), kDt, measured, false, flight);
    ASSERT_NEAR(std::remainder(flight.roll - roll, 2 * M_PI), 0, kRounding) << step;
    ASSERT_LE(std::abs(flight.roll), M_PI + kRounding);
  }
}

TEST(Estimator, KnowsASteadyAcceleration) {
  constexpr Tolerance kTransient{1e-6, "what the filter leaves after 10 s"};
  FlightEstimate<double> flight = {};
  Measurement<double> measured = SteadyFlight(0, 0, 0, 0);
  Estimate(EstimatorGains(), kDt, measured, true, flight);
  for (int step = 1; step <= 500; ++step) {
    measured.true_airspeed = 1000 + 20 * kDt * step;
    Estimate(EstimatorGains(), kDt, measured, false, flight);
  }
  EXPECT_NEAR(flight.acceleration, 20, kTransient);
  EXPECT_NEAR(flight.speed, measured.true_airspeed, kTransient);
}

/// White noise of the default size: a lag of bandwidth w lets the share sqrt(w dt / 2) of it
/// through, a sixth for the fastest that carries an angle or a length.
TEST(Estimator, StopsNoise) {
  constexpr Tolerance kSampling{0.2, "a sample of 20000 correlated steps, relative"};
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  FlightEstimate<double> flight = {};
  double roll_squares = 0, speed_squares = 0;
  constexpr int kSteps = 20000;
  for (int step = 0; step < kSteps; ++step) {
    Measurement<double> measured = SteadyFlight(noise(random), noise(random), 0, 0);
    measured.true_airspeed += noise(random) * kSpeedUnitFtS;
    Estimate(EstimatorGains(), kDt, measured, step == 0, flight);
    roll_squares += flight.roll * flight.roll;
    speed_squares += (flight.speed - 1000) * (flight.speed - 1000);
  }
  const double expected = std::sqrt(EstimatorGains().attitude * kDt / 2);
  EXPECT_NEAR(std::sqrt(roll_squares / kSteps) / 0.01, expected, kSampling * expected);
  EXPECT_LT(std::sqrt(speed_squares / kSteps), 0.3 * 0.01 * kSpeedUnitFtS);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
