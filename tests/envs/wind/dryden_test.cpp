// SPDX-License-Identifier: Apache-2.0
#include "envs/wind/dryden.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "envs/state/attitude.h"
#include "tests/envs/wind/gusts.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kDeviation = Gusts::kDeviation;

/// The transforms of the spectra: correlation over a distance of `way` scales.
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
  constexpr double kScale = 1750;
  const MeasuredSpectra spectra;
  for (const int cycles : {3, 5, 8, 13, 21, 34, 60}) {
    const double frequency = spectra.Frequency(cycles);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(spectra.Density(k, cycles) / Spectrum(k, kScale, frequency), 1, kPeriodogram)
          << "component " << k << ", L W = " << kScale * frequency;
    }
  }
}

// Figure 7 of the standard, at its nodes and between.
TEST(TurbulenceTest, FollowsTheStandardByAltitude) {
  constexpr Tolerance kFigure{0.06, "the severities at 20,000 ft are rounded to 0.05 ft/s"};
  constexpr Tolerance kRounding{1e-12, "float64 rounding"};
  // The figure's at 20,000 ft, half way from 15,000 to 25,000.
  constexpr double kLight = 3.65, kModerate = 7.3, kSevere = 21.05;
  EXPECT_NEAR(TurbulenceAt(kLight, 35000), 0.4, kRounding);
  EXPECT_NEAR(TurbulenceAt(kModerate, 35000), 5.0, kRounding);
  EXPECT_NEAR(TurbulenceAt(kSevere, 35000), 16.0, kRounding);
  EXPECT_NEAR(TurbulenceAt(kModerate, 40000), 4.6, kRounding);
  EXPECT_NEAR(TurbulenceAt((kLight + kModerate) / 2, 15000), 6.3, kRounding) << "half way between";
  EXPECT_NEAR(TurbulenceAt(2 * kSevere, 25000), 40, kRounding) << "twice as strong as severe";
  EXPECT_NEAR(TurbulenceAt(kLight / 2, 7500), 3.35, kRounding) << "half as strong as light";
  EXPECT_NEAR(TurbulenceAt(kModerate, 100), 8.6, kRounding);
  EXPECT_NEAR(TurbulenceAt(kModerate, 90000), 0, kRounding);
  for (const auto& [k, figure] : {std::pair(1u, kLight), {2, kModerate}, {3, kSevere}}) {
    EXPECT_NEAR(kTurbulenceSeverities[k].standard_deviation_fps, figure, kFigure) << k;
  }
}

TEST(TurbulenceTest, IsWhatIsConfiguredAt20000Feet) {
  constexpr Tolerance kRounding{1e-12, "float64 rounding"};
  for (const double deviation : {0.0, 1.0, 3.65, 3.7, 5.0, 7.3, 10.0, 21.0, 42.0}) {
    EXPECT_NEAR(TurbulenceAt(deviation, 20000), deviation, kRounding);
  }
}

TEST_P(DrydenTest, GustsAreAsStrongAsTheirAltitudeHasThem) {
  constexpr int kCount = 4000;
  const double tolerance = kStandardErrors * std::sqrt(2.0 / kCount);  // of a variance
  Gusts gusts(kCount, 1000, 35000, 0, {TurbulenceLaw::kByAltitude});
  for (int step = 0; step <= 20; ++step) {
    if (step > 0) gusts.Advance(0.02);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(MeanProduct(gusts.Of(k), gusts.Of(k)) / (5.0 * 5.0), 1, tolerance) << step;
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
