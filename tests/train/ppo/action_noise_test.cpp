// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/action_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kCount = 500, kSize = 2, kSteps = 40;

std::vector<float> NoiseBy(const ActionNoiseKey& key, int count = kCount) {
  ActionNoiseScratch scratch;
  std::vector<float> noise(static_cast<std::size_t>(count * kSize));
  FillActionNoise(key, count, kSize, scratch, noise.data());
  return noise;
}

/// Of an aircraft's action in one policy step.
std::vector<float> NoiseOf(std::uint64_t policy_step, const HeldNoise& held, int first = 0,
                           int count = kCount) {
  return NoiseBy({7, static_cast<std::uint32_t>(first), policy_step, held}, count);
}

/// Mean over aircraft and steps of the products of an action's noise in two steps `apart`.
double Correlation(const HeldNoise& held, int action, int apart) {
  double sum = 0;
  for (std::uint64_t step = 0; step < kSteps; ++step) {
    const std::vector<float> now = NoiseOf(step, held);
    const std::vector<float> later = NoiseOf(step + static_cast<std::uint64_t>(apart), held);
    for (std::size_t i = static_cast<std::size_t>(action); i < now.size(); i += kSize) {
      sum += now[i] * later[i];
    }
  }
  return sum / (kCount * kSteps);
}

constexpr double kError = 5 / 140.0;  // five standard deviations of a mean of independent products

TEST(ActionNoise, IsStandardNormalWhateverIsHeld) {
  for (const double share : {0.0, 0.5, 1.0}) {
    const HeldNoise held{share, 8};
    EXPECT_NEAR(Correlation(held, 0, 0), 1, 3 * kError) << share;
    EXPECT_NEAR(Correlation(held, 1, 0), 1, 3 * kError) << share;
  }
}

TEST(ActionNoise, IsCorrelatedInTheActionsThatHoldItForAsLongAsTheyDo) {
  const HeldNoise held{0.5, 8, 1};
  // Aircraft change it in turns: k steps later 1 - k / 8 of them still have the same.
  for (const int apart : {1, 2, 4, 7}) {
    EXPECT_NEAR(Correlation(held, 0, apart), 0.5 * (1 - apart / 8.0), 2 * kError) << apart;
    EXPECT_NEAR(Correlation(held, 1, apart), 0, kError) << apart;
  }
  EXPECT_NEAR(Correlation(held, 0, 8), 0, kError);
  EXPECT_NEAR(Correlation({0.5, 8, 2}, 1, 4), 0.25, 2 * kError);
  EXPECT_NEAR(Correlation({0, 8, 2}, 0, 4), 0, kError);
}

TEST(ActionNoise, IsHeldAnewByAnEqualShareOfTheAircraftInEveryPolicyStep) {
  constexpr int kHeldSteps = 8;
  const HeldNoise all{1, kHeldSteps, kSize};
  for (std::uint64_t step = 0; step < 2 * kHeldSteps; ++step) {
    const std::vector<float> now = NoiseOf(step, all), next = NoiseOf(step + 1, all);
    int changed = 0;
    for (std::size_t i = 0; i < now.size(); i += kSize) changed += now[i] != next[i];
    EXPECT_GE(changed, kCount / kHeldSteps) << step;
    EXPECT_LE(changed, kCount / kHeldSteps + 1) << step;
  }
}

TEST(ActionNoise, IsAnotherOfEverySeedAircraftAndPolicyStep) {
  constexpr std::uint64_t kUpperHalf = std::uint64_t{1} << 32;
  const double chance = kStandardErrors / std::sqrt(kCount * kSize);
  // All is held, or nothing: either part is drawn by the whole key.
  for (const HeldNoise& held : {HeldNoise{}, HeldNoise{1, 8, kSize}}) {
    const std::vector<float> noise = NoiseBy({7, 0, 5, held});
    const ActionNoiseKey others[] = {{8, 0, 5, held},
                                     {7 + kUpperHalf, 0, 5, held},
                                     {7, kCount, 5, held},
                                     {7, 0, 5 + 8, held},
                                     {7, 0, 5 + 8 * kUpperHalf, held}};
    for (const ActionNoiseKey& key : others) {
      const std::vector<float> other = NoiseBy(key);
      double sum = 0;
      for (std::size_t i = 0; i < noise.size(); ++i) sum += noise[i] * other[i];
      EXPECT_NEAR(sum / static_cast<double>(noise.size()), 0, chance)
          << "seed " << key.seed << ", aircraft " << key.first_aircraft << ", policy step "
          << key.policy_step << ", held " << held.share;
    }
  }
}

TEST(ActionNoise, DependsOnNoOtherAircraft) {
  for (const HeldNoise& held : {HeldNoise{}, HeldNoise{0.7, 3, 2}}) {
    const std::vector<float> all = NoiseOf(1234567890123, held);
    const std::vector<float> some = NoiseOf(1234567890123, held, 100, 7);
    EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin() + 100 * kSize));
  }
}

TEST(ActionNoise, OfTheOtherActionsIsWhatItIsWithoutAnyHeld) {
  const std::vector<float> white = NoiseOf(5, {}), held = NoiseOf(5, {0.5, 10, 1});
  for (std::size_t i = 0; i < white.size(); i += kSize) {
    EXPECT_NE(held[i], white[i]);
    EXPECT_EQ(held[i + 1], white[i + 1]);
  }
}

}  // namespace
}  // namespace skein
