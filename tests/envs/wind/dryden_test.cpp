// SPDX-License-Identifier: Apache-2.0
#include "envs/wind/dryden.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "envs/state/attitude.h"
#include "tests/envs/test_tile.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kDeviation = 7.3;

/// Aircraft that fly straight on through turbulence, without being moved by it: gusts alone.
class Gusts {
 public:
  Gusts(int count, double speed_ft_s, double altitude_ft, std::uint32_t first_aircraft = 0)
      : tile_(count, kNumWindyColumns),
        episode_(tile_.stride(), 2),
        step_(tile_.stride()),
        first_(first_aircraft),
        speed_(static_cast<float>(speed_ft_s)) {
    tile_.Fill(kQ0, 1);
    tile_.Fill(kDown, static_cast<float>(-altitude_ft));
    tile_.Fill(kTurbulenceStdDev, static_cast<float>(kDeviation));
    for (int i = 0; i < count; ++i) StartGusts(tile_.tile(), i, keys());
  }

  void Advance(double dt) {
    // Gusts meet a speed that they do not change.
    tile_.Fill(kAirU, speed_);
    tile_.Fill(kAirV, 0);
    tile_.Fill(kAirW, 0);
    AdvanceGusts(tile_.tile(), static_cast<float>(dt), keys());
    for (std::int32_t& step : step_) ++step;
  }

  /// North, east and down are forward, right and down of every aircraft.
  std::vector<double> Of(int component) {
    return {tile_.tile()[kWindNorth + component],
            tile_.tile()[kWindNorth + component] + tile_.count()};
  }
  TestTile& tile() { return tile_; }

 private:
  GustKeys keys() const { return {11, first_, episode_.data(), step_.data()}; }

  TestTile tile_;
  std::vector<std::int32_t> episode_, step_;
  std::uint32_t first_;
  float speed_;
};

double MeanProduct(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / static_cast<double>(a.size());
}

/// One-sided densities of unit variance over spatial frequency, rad/ft (envs/wind/dryden.h).
double Spectrum(int component, double scale_ft, double frequency) {
  const double square = std::pow(scale_ft * frequency, 2);
  return component == 0 ? 2 * scale_ft / M_PI / (1 + square)
                        : scale_ft / M_PI * (1 + 3 * square) / std::pow(1 + square, 2);
}

/// Their transforms: correlation over a distance of `way` scales.
double Correlation(int component, double way) {
  return std::exp(-way) * (component == 0 ? 1 : 1 - way / 2);
}

class DrydenTest : public testing::TestWithParam<simd::Target> {
 protected:
  ScopedTarget target_{GetParam()};
};

TEST(DrydenScalesTest, AreThoseOfTheStandard) {
  constexpr Tolerance kRounding{1e-9, "float64 rounding of 1000 ft"};
  constexpr Tolerance kJoint{1e-4, "slopes over 2e-6 ft to either side"};
  for (const double altitude : {2000.0, 20000.0}) {
    EXPECT_DOUBLE_EQ(DrydenScalesAt(altitude).horizontal_ft, 1750);
    EXPECT_DOUBLE_EQ(DrydenScalesAt(altitude).vertical_ft, 1750);
    EXPECT_DOUBLE_EQ(DrydenScalesAt(altitude).horizontal_ratio, 1);
  }
  // By hand: 0.177 + 0.000823 * 200 = 0.3416.
  const DrydenScales low = DrydenScalesAt(200);
  EXPECT_NEAR(low.horizontal_ft, 200 / std::pow(0.3416, 1.2), kRounding);
  EXPECT_NEAR(low.vertical_ft, 200, kRounding);
  EXPECT_NEAR(low.horizontal_ratio, 1 / std::pow(0.3416, 0.4), kRounding);
  EXPECT_NEAR(DrydenScalesAt(1500).horizontal_ft, 1375, kRounding);
  EXPECT_NEAR(DrydenScalesAt(1500).vertical_ft, 1375, kRounding);
  EXPECT_EQ(DrydenScalesAt(-50).vertical_ft, 10);
  for (const double joint : {1000.0, 2000.0}) {
    EXPECT_NEAR(DrydenScalesAt(joint - 1e-6).horizontal_ft,
                DrydenScalesAt(joint + 1e-6).horizontal_ft, kJoint);
  }
}

TEST_P(DrydenTest, VarianceIsThatAskedForFromTheStartOn) {
  constexpr int kCount = 4000;
  const double tolerance = kStandardErrors * std::sqrt(2.0 / kCount);  // of a variance
  // From where a gust is 150 steps long to where it is as short as one.
  for (const double altitude : {20000.0, 200.0, 12.0}) {
    Gusts gusts(kCount, 1000, altitude);
    const double ratio = DrydenScalesAt(altitude).horizontal_ratio;
    for (int step = 0; step <= 300; ++step) {
      if (step > 0) gusts.Advance(0.02);
      if (step != 0 && step != 1 && step != 10 && step != 300) continue;
      for (int k = 0; k < 3; ++k) {
        const std::vector<double> gust = gusts.Of(k);
        const double variance = std::pow(k < 2 ? ratio * kDeviation : kDeviation, 2);
        EXPECT_NEAR(MeanProduct(gust, gust) / variance, 1, tolerance)
            << "component " << k << ", step " << step << ", " << altitude << " ft";
      }
    }
  }
}

TEST_P(DrydenTest, ComponentsAreIndependent) {
  constexpr int kCount = 20000;
  Gusts gusts(kCount, 1000, 20000);
  for (int step = 0; step < 20; ++step) gusts.Advance(0.02);
  for (int k = 0; k < 3; ++k) {
    const double product = MeanProduct(gusts.Of(k), gusts.Of((k + 1) % 3));
    EXPECT_NEAR(product / (kDeviation * kDeviation), 0, kStandardErrors / std::sqrt(1.0 * kCount));
  }
}

TEST_P(DrydenTest, CorrelationFallsWithTheWayThroughTheAir) {
  constexpr int kCount = 10000;
  for (const double dt : {0.02, 0.2}) {
    for (const double altitude : {20000.0, 300.0}) {
      Gusts gusts(kCount, 700, altitude);
      const DrydenScales scales = DrydenScalesAt(altitude);
      const std::vector<double> start[3] = {gusts.Of(0), gusts.Of(1), gusts.Of(2)};
      for (int step = 1; step <= 60; ++step) {
        gusts.Advance(dt);
        if (step != 1 && step % 15 != 0) continue;
        for (int k = 0; k < 3; ++k) {
          const double scale = k < 2 ? scales.horizontal_ft : scales.vertical_ft;
          const double deviation = kDeviation * (k < 2 ? scales.horizontal_ratio : 1);
          const double expected = Correlation(k, 700 * dt * step / scale);
          const double tolerance = kStandardErrors * std::sqrt((1 + expected * expected) / kCount);
          EXPECT_NEAR(MeanProduct(start[k], gusts.Of(k)) / (deviation * deviation), expected,
                      tolerance)
              << "component " << k << ", step " << step << " of " << dt << " s";
        }
      }
    }
  }
}

TEST_P(DrydenTest, SpectraAreDrydens) {
  constexpr int kCount = 1024, kSteps = 1024;
  constexpr double kSpeed = 1000, kDt = 0.1, kScale = 1750;
  Gusts gusts(kCount, kSpeed, 20000);
  std::vector<std::vector<double>> record[3];
  for (int step = 0; step < kSteps; ++step) {
    gusts.Advance(kDt);
    for (int k = 0; k < 3; ++k) record[k].push_back(gusts.Of(k));
  }
  // Periodograms under Hann's window, averaged over the aircraft: five standard errors are 16 %.
  // Up to an eighth of the sampling theorem's limit, what is folded back adds 2 %.
  constexpr Tolerance kPeriodogram{0.18, "five standard errors, and what is folded back"};
  const double spacing = kSpeed * kDt;
  for (const int cycles : {3, 5, 8, 13, 21, 34, 60}) {
    const double frequency = 2 * M_PI * cycles / (kSteps * spacing);
    std::vector<double> cosine, sine;
    double window_power = 0;
    for (int step = 0; step < kSteps; ++step) {
      const double window = 0.5 - 0.5 * std::cos(2 * M_PI * (step + 0.5) / kSteps);
      cosine.push_back(window * std::cos(frequency * spacing * step));
      sine.push_back(window * std::sin(frequency * spacing * step));
      window_power += window * window;
    }
    for (int k = 0; k < 3; ++k) {
      std::vector<double> real(kCount), imaginary(kCount);
      for (std::size_t step = 0; step < kSteps; ++step) {
        for (std::size_t i = 0; i < kCount; ++i) {
          real[i] += cosine[step] * record[k][step][i];
          imaginary[i] += sine[step] * record[k][step][i];
        }
      }
      const double power = MeanProduct(real, real) + MeanProduct(imaginary, imaginary);
      const double density = power * spacing / (M_PI * window_power) / (kDeviation * kDeviation);
      EXPECT_NEAR(density / Spectrum(k, kScale, frequency), 1, kPeriodogram)
          << "component " << k << ", L W = " << kScale * frequency;
    }
  }
}

TEST_P(DrydenTest, GustsActAlongTheBodyAxes) {
  constexpr Tolerance kFloat32{1e-5, "float32 rotation of tens of ft/s"};
  Gusts level(64, 1000, 20000), turned(64, 1000, 20000);
  const Eigen::Vector4d attitude = QuaternionFromEuler({0.7, -0.4, 2.1});
  const Eigen::Matrix3d body_from_ned = BodyFromNed(attitude);
  for (int k = 0; k < 4; ++k) turned.tile().Fill(kQ0 + k, static_cast<float>(attitude[k]));
  level.Advance(0.02);
  turned.Advance(0.02);
  for (int i = 0; i < 64; ++i) {
    Eigen::Vector3d gust, wind;
    for (int k = 0; k < 3; ++k) {
      gust[k] = level.tile().at(kWindNorth + k, i);
      wind[k] = turned.tile().at(kWindNorth + k, i);
    }
    EXPECT_LT((body_from_ned * wind - gust).norm(), kFloat32);
  }
}

TEST_P(DrydenTest, AnAircraftDoesNotDependOnItsPlace) {
  Gusts all(100, 1000, 20000, 40), some(50, 1000, 20000, 83);
  for (int step = 0; step < 10; ++step) {
    all.Advance(0.02);
    some.Advance(0.02);
  }
  for (int column = kWindNorth; column < kNumWindyColumns; ++column) {
    for (int i = 0; i < 50; ++i)
      EXPECT_EQ(some.tile().at(column, i), all.tile().at(column, 43 + i));
  }
}

TEST_P(DrydenTest, AirThatStandsStillKeepsItsGust) {
  constexpr Tolerance kStandingAir{0.1, "five deviations of a way of 1e-6 of the scale"};
  Gusts gusts(10, 0, 20000);
  const std::vector<double> before = gusts.Of(1);
  gusts.Advance(0.02);
  const std::vector<double> after = gusts.Of(1);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i], before[i], kStandingAir);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, DrydenTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
