// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/value_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iterator>

#include "tests/tolerance.h"
#include "train/ranks/ranks.h"

namespace skein {
namespace {

constexpr Tolerance kShare{1e-6, "float32 targets and values"};

/// Of a rollout of six aircraft whose targets are 7, -1, 3, 7, ..., and whose values follow from
/// them.
Sums<kNumValueSums> MeansOf(const std::function<float(float)>& value_of) {
  PpoConfig config;
  config.num_aircraft = 6;
  config.rollout_steps = config.chunk_length = 4;
  config.minibatches = 1;
  Rollout rollout(config, 2, 1, 16);
  constexpr float kTargets[] = {7, -1, 3};
  for (std::size_t i = 0; i < rollout.target.size(); ++i) {
    rollout.target[i] = kTargets[i % std::size(kTargets)];
    rollout.value[i] = value_of(rollout.target[i]);
  }
  return ValueMeans(rollout, OneRank());
}

double ExplainedBy(const std::function<float(float)>& value_of) {
  return ExplainedVariance(MeansOf(value_of));
}

TEST(ValueMeansTest, AreThoseOfTheSamples) {
  const Sums<kNumValueSums> means = MeansOf([](float target) { return target - 2; });
  EXPECT_NEAR(means[kTarget], 3, kShare);
  EXPECT_NEAR(means[kTargetSquared], 59.0 / 3, kShare);
  EXPECT_NEAR(means[kError], 2, kShare);
  EXPECT_NEAR(means[kErrorSquared], 4, kShare);
}

TEST(ExplainedVarianceTest, IsOneOfValuesThatAreRightUpToAConstant) {
  EXPECT_NEAR(ExplainedBy([](float target) { return target; }), 1, kShare);
  EXPECT_NEAR(ExplainedBy([](float target) { return target + 100; }), 1, kShare);
}

TEST(ExplainedVarianceTest, IsZeroOfValuesThatSayTheSameOfEverySample) {
  EXPECT_NEAR(ExplainedBy([](float) { return -5.0f; }), 0, kShare);
}

TEST(ExplainedVarianceTest, FallsWithTheSquareOfTheErrorAndBelowZero) {
  EXPECT_NEAR(ExplainedBy([](float target) { return target / 2; }), 0.75, kShare);
  EXPECT_NEAR(ExplainedBy([](float target) { return -target; }), -3, kShare);
}

TEST(ExplainedVarianceTest, IsNoNumberIfTargetsAreAllEqual) {
  Sums<kNumValueSums> means{};
  means[kTarget] = 2;
  means[kTargetSquared] = 4;
  EXPECT_TRUE(std::isnan(ExplainedVariance(means)));
}

}  // namespace
}  // namespace skein
