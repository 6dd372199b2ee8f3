// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/observation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/f16.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/state/attitude.h"
#include "simd/random.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kFloat32{3e-6, "float32 rounding near one, and a density good to 1e-6"};
constexpr Tolerance kScaledNoise{1e-5, "float32 rounding of noise of deviation 2"};
constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStevensLewis;

class ObservationTest : public testing::TestWithParam<simd::Target> {
 protected:
  std::vector<float> Observe(double noise, std::uint32_t first_aircraft = 0) {
    std::vector<float> observation(static_cast<std::size_t>(kCount) * kObservationSize);
    ObserveTile(*kernel_, flight_.tile(), {errors_.data(), flight_.stride()},
                {noise, 77, first_aircraft, episode_.data(), step_.data()}, observation.data());
    return observation;
  }

  static constexpr int kCount = 50;
  static constexpr int kNumRepeats = 200;  // of kCount noisy rows, for their statistics
  ScopedTarget target_{GetParam()};
  std::shared_ptr<const KernelAircraft> kernel_ = MakeKernelAircraft(F16(), kAtmosphere);
  TestTile flight_{kCount};
  std::vector<float> errors_ = std::vector<float>(3 * flight_.stride());
  std::vector<std::int32_t> episode_ = std::vector<std::int32_t>(flight_.stride(), 3);
  std::vector<std::int32_t> step_ = std::vector<std::int32_t>(flight_.stride(), 4);
};

TEST_P(ObservationTest, HasTheTwentyTwoValuesInTheirUnits) {
  std::vector<std::vector<double>> expected;
  for (int i = 0; i < kCount; ++i) {
    simd::RandomStream random(
        {1, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kInitialState});
    const double altitude = random.Uniform(3000, 45000), speed = random.Uniform(300, 2000);
    const double alpha = random.Uniform(-0.3, 0.7), beta = random.Uniform(-0.5, 0.5);
    const double roll = random.Uniform(-3, 3), pitch = random.Uniform(-1.5, 1.5);
    const double yaw = random.Uniform(-3, 3);
    std::vector<double> row;
    for (int k = 0; k < 3; ++k) {
      row.push_back(random.Uniform(-2, 2));
      errors_[static_cast<std::size_t>(k) * flight_.stride() + static_cast<std::size_t>(i)] =
          static_cast<float>(row.back());
    }
    const double ratio = std::sqrt(AirAt(kAtmosphere, altitude).density_slug_ft3 /
                                   AirAt(kAtmosphere, 0).density_slug_ft3);
    row.insert(row.end(), {altitude * 0.3048 / 5000, std::sin(roll), std::cos(roll),
                           std::sin(pitch), std::cos(pitch), speed * ratio * 0.3048 / 340,
                           std::sin(alpha), std::cos(alpha), std::sin(beta), std::cos(beta)});
    const Eigen::Vector4d q = QuaternionFromEuler({roll, pitch, yaw});
    for (int k = 0; k < 4; ++k) flight_.at(kQ0 + k, i) = static_cast<float>(q[k]);
    flight_.at(kU, i) = static_cast<float>(speed * std::cos(alpha) * std::cos(beta));
    flight_.at(kV, i) = static_cast<float>(speed * std::sin(beta));
    flight_.at(kW, i) = static_cast<float>(speed * std::sin(alpha) * std::cos(beta));
    flight_.at(kDown, i) = static_cast<float>(-altitude);
    for (const int column : {kP, kQ, kR}) {
      row.push_back(random.Uniform(-2, 2));
      flight_.at(column, i) = static_cast<float>(row.back());
    }
    const double range[5] = {100, 25, 21.5, 30, 25};
    const int control[5] = {kPower, kElevator, kAileron, kRudder, kLeadingEdgeFlap};
    for (int k = 0; k < 5; ++k) {
      row.push_back(random.Uniform(k % 4 == 0 ? 0 : -1, 1));
      flight_.at(control[k], i) = static_cast<float>(row.back() * range[k]);
    }
    row.push_back(1 / ratio);
    ASSERT_EQ(row.size(), static_cast<std::size_t>(kObservationSize));
    expected.push_back(row);
  }
  const std::vector<float> observation = Observe(0);
  for (int i = 0; i < kCount; ++i) {
    for (int k = 0; k < kObservationSize; ++k) {
      EXPECT_NEAR(observation[static_cast<std::size_t>(i * kObservationSize + k)],
                  expected[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)],
                  kFloat32 * (k == 4 || k == 5 ? 10 : 1))  // divided by a small cos(pitch)
          << "aircraft " << i << ", element " << k;
    }
  }
}

TEST_P(ObservationTest, NoiseIsTheStreamOfAircraftEpisodeAndStep) {
  constexpr double kNoise = 0.25;
  for (int i = 0; i < kCount; ++i) {
    flight_.at(kQ0, i) = 1;
    flight_.at(kU, i) = 900;
    flight_.at(kDown, i) = -20000;
    step_[static_cast<std::size_t>(i)] = i;
  }
  const std::vector<float> clean = Observe(0), noisy = Observe(kNoise, 1000);
  for (int i = 0; i < kCount; ++i) {
    const simd::RandomKey key{77, 1000 + static_cast<std::uint32_t>(i), 3,
                              static_cast<std::uint32_t>(i),
                              simd::RandomPurpose::kObservationNoise};
    for (int k = 0; k < kObservationSize; ++k) {
      // A word to a pair: radius by the upper half, angle by the lower.
      const int pair = k / 2;
      const std::uint32_t word =
          simd::RandomWords(key, static_cast<std::uint32_t>(pair / 4))[pair % 4];
      const double radius = std::sqrt(-2 * std::log(((word >> 16) + 0.5 + 0x1.0p-8) * 0x1.0p-16));
      const double angle = M_PI / 2 * (word >> 14 & 3) +
                           M_PI / 4 * static_cast<std::int32_t>(word << 18) * 0x1.0p-31;
      const double deviate = radius * (k % 2 == 0 ? std::cos(angle) : std::sin(angle));
      const std::size_t at = static_cast<std::size_t>(i * kObservationSize + k);
      EXPECT_NEAR(noisy[at] - clean[at], kNoise * deviate, kFloat32);
    }
  }
}

TEST_P(ObservationTest, NoiseHasTheMomentsAndTailsOfANormal) {
  double sum[5] = {};
  double beyond2 = 0, n = 0;
  for (int k = 0; k < kNumRepeats; ++k) {
    std::fill(step_.begin(), step_.end(), k);
    const std::vector<float> clean = Observe(0), noisy = Observe(1);
    for (std::size_t i = 0; i < clean.size(); ++i) {
      const double x = static_cast<double>(noisy[i]) - clean[i];
      double power = 1;
      for (double& s : sum) {
        s += power;
        power *= x;
      }
      beyond2 += std::abs(x) > 2;
      ++n;
    }
  }
  // The variances of x, x^2, x^3, x^4 are 1, 2, 15, 96.
  EXPECT_NEAR(sum[1] / n, 0, kStandardErrors * std::sqrt(1 / n));
  EXPECT_NEAR(sum[2] / n, 1, kStandardErrors * std::sqrt(2 / n));
  EXPECT_NEAR(sum[3] / n, 0, kStandardErrors * std::sqrt(15 / n));
  EXPECT_NEAR(sum[4] / n, 3, kStandardErrors * std::sqrt(96 / n));
  const double tail2 = std::erfc(2 / std::sqrt(2.0));
  EXPECT_NEAR(beyond2 / n, tail2, kStandardErrors * std::sqrt(tail2 / n));
}

TEST_P(ObservationTest, ARangeOfNoiseGivesEveryEpisodeItsOwn) {
  constexpr double kMin = 0.25, kMax = 2;
  for (int i = 0; i < kCount; ++i) episode_[static_cast<std::size_t>(i)] = 5 * i;
  const std::vector<float> clean = Observe(0);
  for (const int step : {4, 5}) {
    std::fill(step_.begin(), step_.end(), step);
    const std::vector<float> deviates = Observe(1, 1000);
    std::vector<float> ranged(clean.size());
    ObserveTile(*kernel_, flight_.tile(), {errors_.data(), flight_.stride()},
                {kMin, 77, 1000, episode_.data(), step_.data(), kMax}, ranged.data());
    for (int i = 0; i < kCount; ++i) {
      const simd::RandomKey key{77, 1000 + static_cast<std::uint32_t>(i),
                                5 * static_cast<std::uint32_t>(i), 0,
                                simd::RandomPurpose::kNoiseLevel};
      const double share = simd::UniformFromBits(simd::RandomWords(key, 0)[0]);
      for (int k = 0; k < kObservationSize; ++k) {
        const std::size_t at = static_cast<std::size_t>(i * kObservationSize + k);
        EXPECT_NEAR(ranged[at] - clean[at],
                    (kMin + share * (kMax - kMin)) * (deviates[at] - clean[at]), kScaledNoise);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, ObservationTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
