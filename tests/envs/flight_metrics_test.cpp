// SPDX-License-Identifier: Apache-2.0
#include "envs/flight_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/f16.h"
#include "envs/flight_metric_sums.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/state/attitude.h"
#include "envs/step_memory.h"
#include "envs/vec_env.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using Metrics = std::vector<float>;

class FlightMetricsTest : public testing::TestWithParam<simd::Target> {
 protected:
  FlightMetricsTest() {
    for (int i = 0; i < kCount; ++i) Fly(i, 1000, 0, 0, 20000);
  }

  void Fly(int i, double speed, double alpha_deg, double beta_deg, double altitude_ft) {
    const double alpha = alpha_deg / kDegPerRad, beta = beta_deg / kDegPerRad;
    flight_.at(kQ0, i) = 1;
    flight_.at(kU, i) = static_cast<float>(speed * std::cos(alpha) * std::cos(beta));
    flight_.at(kV, i) = static_cast<float>(speed * std::sin(beta));
    flight_.at(kW, i) = static_cast<float>(speed * std::sin(alpha) * std::cos(beta));
    flight_.at(kDown, i) = static_cast<float>(-altitude_ft);
    flight_.at(kNz, i) = 1;
  }
  void Add() { sums_.Add(*kernel_, flight_.tile(), termination_.data()); }
  Metrics Report(int i, int steps) const {
    Metrics metrics(kNumFlightMetrics);
    sums_.Report(i, steps, kInterval, metrics.data());
    return metrics;
  }

  static constexpr int kCount = 40;
  static constexpr double kInterval = 0.02;
  ScopedTarget target_{GetParam()};
  std::shared_ptr<const KernelAircraft> kernel_ =
      MakeKernelAircraft(F16(), AtmosphereModel::kStevensLewis);
  TestTile flight_{kCount};
  std::vector<std::int32_t> termination_ = std::vector<std::int32_t>(flight_.stride());
  FlightMetricSums sums_;
};

constexpr Tolerance kFloat32{2e-6, "float32 states, and kernels of a few ULP"};
constexpr Tolerance kDegrees{1e-4, "the same, in degrees"};
constexpr Tolerance kClimbRate{1e-4, "float32 rotation of 900 ft/s"};
constexpr Tolerance kSteadyChange{2e-6, "float32 rounding of second differences over 0.02 s"};
constexpr Tolerance kSecondDifferences{1e-6, "float32 rounding of states"};

TEST_P(FlightMetricsTest, MeansAreOfTheStatesByTheFormulasOfTable6) {
  const double sound = AirAt(AtmosphereModel::kStevensLewis, 20000).sound_speed_ft_s;
  constexpr int i = 37;  // in the last, incomplete vector
  Fly(i, 0.9 * sound, -4, 3, 20000);
  flight_.at(kNz, i) = -2;
  flight_.at(kP, i) = -0.3f;
  flight_.at(kQ, i) = 0.1f;
  flight_.at(kR, i) = 0.02f;
  Add();
  Fly(i, 2 * sound, 8, -5, 20000);
  flight_.at(kNz, i) = 5;
  flight_.at(kP, i) = 0.1f;
  flight_.at(kQ, i) = -0.3f;
  flight_.at(kR, i) = 0.04f;
  Add();
  const Metrics m = Report(i, 2);
  EXPECT_NEAR(m[kMeanLoadFactor], 1.5, kFloat32);
  EXPECT_NEAR(m[kMeanTrueAirspeed] / (1.45 * sound), 1, kFloat32);
  EXPECT_NEAR(m[kMeanMach], 1.45, kFloat32);
  EXPECT_NEAR(m[kMeanAbsAlpha], 6, kDegrees);
  EXPECT_NEAR(m[kMeanAbsBeta], 4, kDegrees);
  EXPECT_NEAR(m[kMeanAbsP], 0.2, kFloat32);
  EXPECT_NEAR(m[kMeanAbsQ], 0.2, kFloat32);
  EXPECT_NEAR(m[kMeanAbsR], 0.03, kFloat32);
  // 17500 ft are 5334 m.
  EXPECT_NEAR(m[kAltitudeMargin], 1.0668, kFloat32);
  // 0.9 is 0.605 below the middle, 2 is 0.495 above.
  EXPECT_NEAR(m[kSpeedMargin], 1 - 0.55 / 1.505, kFloat32);
  EXPECT_NEAR(m[kOverloadMargin], 0.65, kFloat32);
  // -4 deg is 16.5 below the middle of 12.5, 8 deg 4.5.
  EXPECT_NEAR(m[kAlphaMargin], 1 - 10.5 / 32.5, kFloat32);
  EXPECT_NEAR(m[kBetaMargin], 1 - 4.0 / 30, kFloat32);
  EXPECT_EQ(m[kSmoothness], 1) << "two states have no second difference";
}

TEST_P(FlightMetricsTest, ClimbRateIsOverTheGroundInAnyAttitude) {
  // Nose 30 deg up, banked 60 deg, slipping: against the float64 rotation.
  const Eigen::Vector4d attitude = QuaternionFromEuler({60 / kDegPerRad, 30 / kDegPerRad, 1});
  Fly(0, 900, 6, -2, 20000);
  for (int k = 0; k < 4; ++k) flight_.at(kQ0 + k, 0) = static_cast<float>(attitude[k]);
  const Eigen::Vector3d body(flight_.at(kU, 0), flight_.at(kV, 0), flight_.at(kW, 0));
  const double expected = -(BodyFromNed(attitude).transpose() * body)[2];
  Add();
  EXPECT_GT(expected, 300);
  EXPECT_NEAR(Report(0, 1)[kMeanClimbRate], expected, kClimbRate);
}

TEST_P(FlightMetricsTest, ClimbsAndDescentsCancelUnlessAbsolute) {
  for (const double sign : {1.0, -1.0}) {
    const Eigen::Vector4d attitude = QuaternionFromEuler({0, sign * 30 / kDegPerRad, 0});
    Fly(0, 900, 0, 0, 20000);
    for (int k = 0; k < 4; ++k) flight_.at(kQ0 + k, 0) = static_cast<float>(attitude[k]);
    Add();
  }
  const Metrics m = Report(0, 2);
  EXPECT_NEAR(m[kMeanClimbRate], 0, kClimbRate);
  EXPECT_NEAR(m[kMeanAbsClimbRate], 450, kClimbRate);
}

TEST_P(FlightMetricsTest, SmoothnessIsOfTheSecondDifferences) {
  const auto fly = [&](double p, double nz) {
    flight_.at(kP, 0) = static_cast<float>(p);
    flight_.at(kNz, 0) = static_cast<float>(nz);
    Add();
  };
  // Steady change is smooth.
  for (const int step : {0, 1, 2, 3}) fly(0.1 * step, 1 + 0.5 * step);
  EXPECT_NEAR(Report(0, 4)[kSmoothness], 1, kSteadyChange);
  // A step of 3 g and one of 0.4 pi rad/s: second differences (0.4, 0.3), then (-0.4, -0.3), after
  // two of zero.
  sums_.Begin(0);
  for (int step = 0; step < 4; ++step) fly(0, 1);
  fly(0.4 * 3.14159265, 4);
  fly(0.4 * 3.14159265, 4);
  EXPECT_NEAR(Report(0, 6)[kSmoothness], 1 / (1 + (0.5 + 0.5) / 4 / kInterval), kSecondDifferences);
}

TEST_P(FlightMetricsTest, PeaksAreTheExtremesOfTheStates) {
  struct Moment {
    double nz, alpha_deg, beta_deg, p_deg_s;
  };
  // The extremes of each are in moments of their own, of sideslip and roll rate on either side.
  const std::vector<Moment> flight = {
      {3, 4, 1, 10}, {6.5, 7, -1, -30}, {2, 19, 2, 5}, {4, 3, -6, -90}, {1.5, 8, 3, 40}};
  constexpr int i = 37;  // in the last, incomplete vector
  const auto fly = [&](const Moment& moment) {
    Fly(i, 700, moment.alpha_deg, moment.beta_deg, 20000);
    flight_.at(kNz, i) = static_cast<float>(moment.nz);
    flight_.at(kP, i) = static_cast<float>(moment.p_deg_s / kDegPerRad);
    Add();
  };
  for (const Moment& moment : flight) fly(moment);
  const Metrics peaks = Report(i, 5);
  EXPECT_EQ(peaks[kPeakLoadFactor], 6.5f);
  EXPECT_EQ(peaks[kLowestLoadFactor], 1.5f) << "not the 0 that memory begins with";
  EXPECT_NEAR(peaks[kPeakAlpha], 19, kDegrees);
  EXPECT_NEAR(peaks[kPeakAbsBeta], 6, kDegrees);
  EXPECT_NEAR(peaks[kPeakAbsP], 90, kDegrees);
  const Metrics other = Report(i - 1, 5);
  EXPECT_EQ(other[kPeakLoadFactor], 1) << "another aircraft's";
  EXPECT_EQ(other[kLowestLoadFactor], 1);
  EXPECT_EQ(other[kPeakAbsP], 0);
  // The next episode knows nothing of it. It pushes all the way: no peak is above 0.
  sums_.Begin(i);
  fly({-1, -3, 0, 0});
  fly({-2.5, -9, 0, 0});
  const Metrics pushed = Report(i, 2);
  EXPECT_EQ(pushed[kPeakLoadFactor], -1);
  EXPECT_EQ(pushed[kLowestLoadFactor], -2.5f);
  EXPECT_NEAR(pushed[kPeakAlpha], -3, kDegrees) << "signed";
  EXPECT_NEAR(pushed[kPeakAbsBeta], 0, kDegrees);
  EXPECT_EQ(pushed[kPeakAbsP], 0);
}

TEST_P(FlightMetricsTest, PeaksOfAngleAreRelativeToTheAir) {
  TestTile windy(kCount, kNumWindyColumns);
  windy.Fill(kQ0, 1);
  windy.Fill(kU, 700);
  windy.Fill(kV, 300);  // over the ground
  windy.Fill(kAirU, 600);
  windy.Fill(kAirV, -10);
  windy.Fill(kAirW, 60);
  sums_.Add(*kernel_, windy.tile(), termination_.data());
  EXPECT_NEAR(Report(0, 1)[kPeakAlpha], std::atan(0.1) * kDegPerRad, kDegrees);
  EXPECT_NEAR(Report(0, 1)[kPeakAbsBeta], std::atan2(10, std::hypot(600, 60)) * kDegPerRad,
              kDegrees);
}

TEST_P(FlightMetricsTest, EpisodesThatHaveEndedAddNothing) {
  Add();
  termination_[3] = static_cast<std::int32_t>(Termination::kOverload);
  flight_.at(kNz, 3) = 9;
  flight_.at(kNz, 4) = 9;
  Add();
  EXPECT_EQ(Report(3, 1)[kMeanLoadFactor], 1);
  EXPECT_EQ(Report(3, 1)[kPeakLoadFactor], 1);
  EXPECT_EQ(Report(4, 2)[kMeanLoadFactor], 5);
  EXPECT_EQ(Report(4, 2)[kPeakLoadFactor], 9);
}

TEST_P(FlightMetricsTest, OnlyWholeEpisodesHaveMetrics) {
  EXPECT_TRUE(std::isnan(Report(0, 1)[kMeanMach]));
  Add();
  Add();
  EXPECT_FALSE(std::isnan(Report(0, 2)[kMeanMach]));
  for (const float metric : Report(0, 3)) EXPECT_TRUE(std::isnan(metric));
  sums_.Begin(0);
  Add();
  EXPECT_EQ(Report(0, 1)[kMeanLoadFactor], 1);
  EXPECT_EQ(Report(1, 3)[kMeanLoadFactor], 1);
  sums_ = FlightMetricSums();
  EXPECT_TRUE(std::isnan(Report(0, 1)[kMeanMach]));
}

TEST_P(FlightMetricsTest, SumsOfLongEpisodesKeepTheirDigits) {
  constexpr int kSteps = 20000;
  flight_.at(kP, 0) = 0.1f;
  for (int step = 0; step < kSteps; ++step) Add();
  // A plain float32 sum of as many is off by 1e-4.
  constexpr Tolerance kCompensatedSum{2e-7, "float32 rounding of the result alone"};
  EXPECT_NEAR(Report(0, kSteps)[kMeanAbsP] / 0.1f, 1, kCompensatedSum);
}

INSTANTIATE_TEST_SUITE_P(Targets, FlightMetricsTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& suite) { return std::string(Name(suite.param)); });

/// All metrics of the first episodes of `count` aircraft, under actions of 0.3, and what else was
/// reported of them.
struct Flown {
  std::vector<Metrics> metrics;
  std::vector<float> returns;
};

Flown FlyTiles(const EnvConfig& config, int count, int tile_size, bool with_metrics) {
  VecEnv env(config, count, 7, tile_size);
  Flown flown{std::vector<Metrics>(count), std::vector<float>(count)};
  for (int tile = 0; tile < env.num_tiles(); ++tile) {
    const int size = env.tile_count(tile);
    const std::vector<float> action(size * 4, 0.3f);
    StepMemory memory(size, {0, 0, with_metrics ? kNumFlightMetrics : 0});
    for (int policy_step = 0; policy_step * config.action_repeat < config.time_limit_steps;
         ++policy_step) {
      env.Step(tile, action.data(), memory.output());
      for (int i = 0; i < size; ++i) {
        const int aircraft = env.tile_begin(tile) + i;
        Metrics& kept = flown.metrics[aircraft];
        if (memory.termination[i] == 0 || !kept.empty()) continue;
        flown.returns[aircraft] = memory.episode_return[i];
        if (!with_metrics) continue;
        const auto row = memory.flight_metrics.begin() + i * kNumFlightMetrics;
        kept.assign(row, row + kNumFlightMetrics);
      }
    }
  }
  return flown;
}

EnvConfig ShortFlights() {
  EnvConfig config;
  config.action_repeat = 3;
  config.time_limit_steps = config.heading.earliest_success_step = 100;
  return config;
}

TEST(FlightMetricsOfEnvironmentTest, DependNeitherOnTilesNorDoTheyChangeAnything) {
  const Flown narrow = FlyTiles(ShortFlights(), 300, 32, true);
  const Flown wide = FlyTiles(ShortFlights(), 300, 300, true);
  const Flown without = FlyTiles(ShortFlights(), 300, 300, false);
  for (std::size_t i = 0; i < 300; ++i) {
    ASSERT_EQ(narrow.metrics[i].size(), static_cast<std::size_t>(kNumFlightMetrics));
    EXPECT_GT(narrow.metrics[i][kMeanMach], 0.5f);
    EXPECT_EQ(narrow.metrics[i], wide.metrics[i]) << i;
    EXPECT_EQ(wide.returns[i], without.returns[i]) << i;
  }
  EXPECT_NE(narrow.metrics[0], narrow.metrics[1]);
}

/// Of the first policy step of two aircraft, the first of which began it with `value` in `column`.
std::vector<Metrics> FlyPoisoned(int column, float value) {
  EnvConfig config = ShortFlights();
  config.action_repeat = config.time_limit_steps;
  VecEnv env(config, 2, 7);
  std::vector<std::uint32_t> snapshot = env.Snapshot();
  std::memcpy(&snapshot[column], &value, sizeof value);
  env.Restore(snapshot);
  const std::vector<float> action(8, 0.0f);
  StepMemory memory(2, {0, 0, kNumFlightMetrics});
  env.Step(0, action.data(), memory.output());
  const auto of = [&](int i) { return static_cast<Termination>(memory.termination[i]); };
  EXPECT_EQ(of(0), Termination::kNonFinite) << column;
  EXPECT_EQ(of(1), Termination::kTimeLimit) << column;
  const std::vector<float>& metrics = memory.flight_metrics;
  return {{metrics.begin(), metrics.begin() + kNumFlightMetrics},
          {metrics.begin() + kNumFlightMetrics, metrics.end()}};
}

TEST(FlightMetricsOfEnvironmentTest, EpisodesThatAreNotFiniteHaveNone) {
  constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  // No metric is made of the first four; the infinity makes an infinite altitude margin.
  for (const auto& [column, value] : {std::pair<int, float>(kNorth, kNotANumber),
                                      {kNorth, kInfinity},
                                      {kFlapFilter, kNotANumber},
                                      {kYawWashout, kInfinity},
                                      {kDown, -kInfinity},
                                      {kP, kNotANumber}}) {
    const std::vector<Metrics> flown = FlyPoisoned(column, value);
    for (const float metric : flown[0]) EXPECT_TRUE(std::isnan(metric)) << column;
    for (const float metric : flown[1]) EXPECT_TRUE(std::isfinite(metric)) << column;
  }
}

TEST(FlightMetricsOfEnvironmentTest, EpisodesBegunAmidTheirClockHaveNone) {
  EnvConfig config = ShortFlights();
  config.stagger_clocks = true;
  int without = 0;
  for (const Metrics& metrics : FlyTiles(config, 64, 64, true).metrics) {
    without += std::isnan(metrics.at(kMeanMach));
  }
  EXPECT_GT(without, 55) << "clocks begin at 0 in one episode of 100";
}

}  // namespace
}  // namespace skein
