// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "envs/aircraft/f16.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/vec_env.h"
#include "envs/wind/dryden.h"
#include "tests/envs/step_buffers.h"
#include "tests/envs/test_tile.h"
#include "tests/envs/wind/gusts.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kDeviation = Gusts::kDeviation, kSpan = 30;
constexpr int kRoll = 3, kPitch = 4, kYaw = 5;

Turbulence Turning(double span_ft = kSpan) { return {TurbulenceLaw::kUniform, span_ft}; }

/// Integral of a function of the spatial frequency from 0 on, which falls as its square or faster
/// beyond 1 / `length_ft`.
template <typename Function>
double IntegralOverFrequency(double length_ft, const Function& function) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = M_PI / 2 * (i + 0.5) / kSteps;  // frequency = tan(angle) / length
    const double slope = M_PI / 2 / kSteps / (length_ft * std::pow(std::cos(angle), 2));
    sum += slope * function(std::tan(angle) / length_ft);
  }
  return sum;
}

/// The scale of a rate's spectrum at an altitude, and the deviation of its gusts.
struct RateScale {
  RateScale(int rate, double altitude_ft) {
    const DrydenScales scales = DrydenScalesAt(altitude_ft);
    scale_ft = rate == kYaw ? scales.horizontal_ft : scales.vertical_ft;
    deviation = kDeviation * (rate == kYaw ? scales.horizontal_ratio : 1);
  }
  double scale_ft, deviation;
};

double Variance(int rate, double altitude_ft, double span_ft) {
  const RateScale of(rate, altitude_ft);
  return of.deviation * of.deviation * IntegralOverFrequency(span_ft, [&](double frequency) {
           return RateSpectrum(rate, of.scale_ft, span_ft, frequency);
         });
}

/// Of pitch with the gust down, and of yaw with the gust to the right, at one time: the real part
/// of the standard's filters times the gust's spectrum, by its rigid body's sign.
double CovarianceWithGust(int rate, double altitude_ft, double span_ft) {
  const RateScale of(rate, altitude_ft);
  const double length = (rate == kYaw ? 3 : 4) * span_ft / M_PI;
  const double magnitude = IntegralOverFrequency(span_ft, [&](double frequency) {
    const double square = std::pow(length * frequency, 2);
    return square / (length * (1 + square)) *
           Spectrum(rate == kYaw ? 1 : 2, of.scale_ft, frequency);
  });
  return of.deviation * of.deviation * (rate == kYaw ? magnitude : -magnitude);
}

class RotationalGustsTest : public testing::TestWithParam<simd::Target> {
 protected:
  ScopedTarget target_{GetParam()};
};

// However long the steps: the filters' responses are exact, and begin in their stationary
// distribution. The slow gust's own length is that of the wing at 40 ft.
TEST_P(RotationalGustsTest, VariancesAreTheSpectrasIntegralsFromTheStartOn) {
  constexpr int kCount = 4000;
  const double tolerance = kStandardErrors * std::sqrt(2.0 / kCount);  // of a variance
  for (const double altitude : {20000.0, 200.0, 40.0}) {
    for (const double dt : {0.005, 0.02, 0.05}) {
      Gusts gusts(kCount, 700, altitude, 0, Turning());
      for (int step = 0; step <= 100; ++step) {
        if (step > 0) gusts.Advance(dt);
        if (step != 0 && step != 1 && step != 10 && step != 100) continue;
        for (const int rate : {kRoll, kPitch, kYaw}) {
          const std::vector<double> values = gusts.Of(rate);
          EXPECT_NEAR(MeanProduct(values, values) / Variance(rate, altitude, kSpan), 1, tolerance)
              << "rate " << rate << ", step " << step << " of " << dt << " s, " << altitude
              << " ft";
        }
      }
    }
  }
}

TEST_P(RotationalGustsTest, SpectraAreThoseOfTheStandard) {
  constexpr double kScale = 1750;
  const MeasuredSpectra spectra(0.01, kSpan);
  for (const int cycles : {3, 8, 21, 60}) {
    const double frequency = spectra.Frequency(cycles);
    for (const int rate : {kRoll, kPitch, kYaw}) {
      EXPECT_NEAR(spectra.Density(rate, cycles) / RateSpectrum(rate, kScale, kSpan, frequency), 1,
                  kPeriodogram)
          << "rate " << rate << ", b W = " << kSpan * frequency;
    }
  }
}

// Air whose gust down grows ahead turns nose down: pitch is lower where the gust down has grown.
TEST_P(RotationalGustsTest, PitchAndYawFollowTheGustsAndRollDoesNot) {
  constexpr int kCount = 20000;
  Gusts gusts(kCount, 700, 20000, 0, Turning());
  for (int step = 0; step <= 40; ++step) {
    if (step > 0) gusts.Advance(0.02);
    if (step % 20 != 0) continue;
    for (const int rate : {kRoll, kPitch, kYaw}) {
      const double deviation = std::sqrt(Variance(rate, 20000, kSpan)) * kDeviation;
      for (int gust = 0; gust < 3; ++gust) {
        const bool follows = (rate == kPitch && gust == 2) || (rate == kYaw && gust == 1);
        const double expected = follows ? CovarianceWithGust(rate, 20000, kSpan) / deviation : 0;
        EXPECT_NEAR(MeanProduct(gusts.Of(rate), gusts.Of(gust)) / deviation, expected,
                    kStandardErrors * std::sqrt((1 + expected * expected) / kCount))
            << "rate " << rate << ", gust " << gust << ", step " << step;
      }
    }
  }
}

// To a wing that is short beside the way a rate is the gust's slope along it.
TEST_P(RotationalGustsTest, RatesAreTheGustsSlopesAlongTheWay) {
  constexpr int kCount = 2000, kSteps = 40;
  constexpr double kSpeed = 700, kDt = 0.005;
  constexpr double kWay = kSpeed * kDt * kSteps;
  Gusts gusts(kCount, kSpeed, 20000, 0, Turning(3));
  const std::vector<double> right = gusts.Of(1), down = gusts.Of(2);
  std::vector<double> pitch(kCount), yaw(kCount);
  for (int step = 0; step < kSteps; ++step) {
    gusts.Advance(kDt);
    const std::vector<double> pitch_now = gusts.Of(kPitch), yaw_now = gusts.Of(kYaw);
    for (std::size_t i = 0; i < kCount; ++i) {
      pitch[i] += pitch_now[i] / kSteps;
      yaw[i] += yaw_now[i] / kSteps;
    }
  }
  const std::vector<double> right_end = gusts.Of(1), down_end = gusts.Of(2);
  double with_pitch = 0, with_yaw = 0, of_down = 0, of_right = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double down_slope = (down_end[i] - down[i]) / kWay;
    const double right_slope = (right_end[i] - right[i]) / kWay;
    with_pitch += pitch[i] * down_slope;
    with_yaw += yaw[i] * right_slope;
    of_down += down_slope * down_slope;
    of_right += right_slope * right_slope;
  }
  constexpr Tolerance kSmoothed{0.15, "what a wing of 3 ft smooths of a way of 140 ft"};
  EXPECT_NEAR(with_pitch / of_down, -1, kSmoothed);
  EXPECT_NEAR(with_yaw / of_right, 1, kSmoothed);
}

TEST_P(RotationalGustsTest, LinearGustsAreTheSameWithout) {
  Gusts without(100, 900, 1500), with(100, 900, 1500, 0, Turning());
  for (int step = 0; step < 10; ++step) {
    for (int column = kWindNorth; column < kNumWindyColumns; ++column) {
      for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(with.tile().at(column, i), without.tile().at(column, i)) << column;
      }
    }
    without.Advance(0.02);
    with.Advance(0.02);
  }
}

TEST_P(RotationalGustsTest, AnAircraftDoesNotDependOnItsPlace) {
  Gusts all(100, 1000, 20000, 40, Turning()), some(50, 1000, 20000, 83, Turning());
  for (int step = 0; step < 10; ++step) {
    all.Advance(0.02);
    some.Advance(0.02);
  }
  for (int column = kWindNorth; column < kNumRotationalGustColumns; ++column) {
    for (int i = 0; i < 50; ++i)
      EXPECT_EQ(some.tile().at(column, i), all.tile().at(column, 43 + i));
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, RotationalGustsTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

// In flight.

constexpr int kFlown = 70;

EnvConfig Rough(bool rotational) {
  EnvConfig config;
  config.action_repeat = 5;
  config.observation_noise = 0;
  config.stagger_clocks = true;
  config.time_limit_steps = config.heading.earliest_success_step = 100;
  config.wind.speed_fps = {0, 60};
  config.wind.turbulence_fps = {5, 20};
  config.wind.rotational_gusts = rotational;
  return config;
}

void FlyTile(VecEnv* env, int tile, int policy_steps) {
  StepBuffers buffers(env->tile_count(tile));
  for (float& action : buffers.action) action = 0.1f;
  for (int k = 0; k < policy_steps; ++k) env->Step(tile, buffers.action.data(), buffers.output());
}

void Fly(VecEnv* env, int policy_steps) {
  for (int tile = 0; tile < env->num_tiles(); ++tile) FlyTile(env, tile, policy_steps);
}

TEST(RotationalGustsInFlight, DoNotDependOnTilesAndThreadsAndGoOnFromASnapshot) {
  VecEnv small(Rough(true), kFlown, 1, 32), large(Rough(true), kFlown, 1, 4096);
  Fly(&large, 30);
  WorkerPool pool(4);
  pool.ForEach(small.num_tiles(), [&](int tile, int) { FlyTile(&small, tile, 30); });
  const std::vector<std::uint32_t> snapshot = large.Snapshot();
  EXPECT_EQ(small.Snapshot(), snapshot);
  VecEnv other(Rough(true), kFlown, 1, 64);
  other.Restore(snapshot);
  Fly(&other, 20);
  Fly(&large, 20);
  EXPECT_EQ(other.Snapshot(), large.Snapshot());
}

// As of all flights (docs/explanation/reliability.md): neither has fused multiply-adds.
TEST(RotationalGustsInFlight, HaveTheSameBitsOnSse4AndScalar) {
  std::vector<std::vector<std::uint32_t>> snapshots;
  for (const simd::Target target : simd::SupportedTargets()) {
    if (target != simd::Target::kSse4 && target != simd::Target::kScalar) continue;
    const ScopedTarget forced(target);
    VecEnv env(Rough(true), kFlown, 1);
    Fly(&env, 30);
    snapshots.push_back(env.Snapshot());
  }
  EXPECT_EQ(snapshots.front(), snapshots.back());
}

TEST(RotationalGustsInFlight, AreKeptOnlyWhereTheyAreAskedForAndThereIsTurbulence) {
  const auto words = [](const EnvConfig& config) {
    return VecEnv(config, kFlown, 1).Snapshot().size();
  };
  EnvConfig smooth = Rough(true), smooth_without = Rough(false);
  smooth.wind.turbulence_fps = smooth_without.wind.turbulence_fps = {0, 0};
  EXPECT_EQ(words(Rough(true)),
            words(Rough(false)) + kFlown * (kNumRotationalGustColumns - kNumWindyColumns));
  EXPECT_EQ(words(smooth), words(smooth_without));
  const VecEnv without(Rough(false), kFlown, 1);
  EXPECT_EQ(without.StateOf(0, kGustPitchRate), 0);
}

/// The aircraft of `tile` some steps later.
TestTile AfterSteps(TestTile tile, int steps) {
  const auto kernel = MakeKernelAircraft(F16(), AtmosphereModel::kStevensLewis);
  StepTile(*kernel, tile.tile(), 0.02f, steps);
  return tile;
}

TEST(RotationalGustsInFlight, AirThatPitchesUpTakesTheNoseAlong) {
  TestTile still(32, kNumRotationalGustColumns);
  still.Fill(kU, 600);
  still.Fill(kAirU, 600);
  still.Fill(kW, 30);
  still.Fill(kDown, -15000);
  still.Fill(kQ0, 1);
  TestTile pitching = still;
  pitching.Fill(kGustPitchRate, 0.05f);
  const TestTile before = AfterSteps(still, 1), after = AfterSteps(pitching, 1);
  TestTile expected = before, actual = after;
  const Airframe airframe = F16().airframe;
  const double speed = std::hypot(600, 30), density = 1.496e-3;  // 1976, 15,000 ft
  const double qbar_S_c =
      0.5 * density * speed * speed * airframe.wing_area_ft2 * airframe.chord_ft;
  // By q c / 2V at 5 deg of alpha, of S-119 (the check cases' static shots), whose tables are the
  // short form of TP-1538's; and the moment of the normal force about the centre of gravity.
  const double cmq = -5.26 - 31.4 * (airframe.cg_reference - airframe.cg);
  const double acceleration =
      -cmq * 0.05 * airframe.chord_ft / (2 * speed) * qbar_S_c / airframe.Iyy;
  constexpr Tolerance kBook{0.1, "the tables at 3 deg, and one step's own damping, relative"};
  const double gained = actual.at(kQ, 0) - expected.at(kQ, 0);
  EXPECT_NEAR(gained / (0.02 * acceleration), 1, kBook);
  // Neither attitude nor path turn with the air at once.
  constexpr Tolerance kSecondOrder{1e-4, "half a step of the acceleration"};
  EXPECT_NEAR(actual.at(kQy, 0), expected.at(kQy, 0), kSecondOrder);
  for (const int column : {kP, kR, kV}) {
    EXPECT_NEAR(actual.at(column, 0), expected.at(column, 0), kSecondOrder) << column;
  }
}

TEST(RotationalGustsInFlight, ShakeTheAircraft) {
  VecEnv without(Rough(false), kFlown, 1), with(Rough(true), kFlown, 1);
  EXPECT_EQ(with.StateOf(3, kWindDown), without.StateOf(3, kWindDown));
  Fly(&without, 1);
  Fly(&with, 1);
  double differences = 0;
  for (int i = 0; i < kFlown; ++i) {
    differences += std::abs(with.StateOf(i, kP) - without.StateOf(i, kP)) / kFlown;
  }
  // A roll rate of 0.02 rad/s, met for 0.1 s by a damping that answers within 0.5 s.
  EXPECT_GT(differences, 1e-3);
}

}  // namespace
}  // namespace skein
