// SPDX-License-Identifier: Apache-2.0
#include "src/bench/learner_rates.h"

#include <gtest/gtest.h>

#include "base/median.h"
#include "tests/tolerance.h"
#include "tests/train/small_config.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-12, "float64 rounding of quotients, relative"};

TEST(LearnerRates, AreOfTheMediansOfEveryConfigurationsIterations) {
  constexpr int kIterations = 3;
  TrainConfig fewer = SmallConfig();
  fewer.ppo.num_aircraft /= 2;
  WorkerPool pool(1);
  const std::vector<LearnerRates> all = MeasureLearners({SmallConfig(), fewer}, kIterations, pool);
  ASSERT_EQ(all.size(), 2u);
  for (const LearnerRates& rates : all) {
    const LearnerRates::Samples& samples = rates.samples;
    EXPECT_EQ(samples.iteration_s.size(), 3u);
    EXPECT_EQ(rates.iteration_s, Median(samples.iteration_s));
    EXPECT_NEAR(rates.rollout_policy_steps_per_s / Median(samples.rollout_policy_steps_per_s), 1,
                kRounding);
    EXPECT_NEAR(rates.update_samples_per_s / Median(samples.update_samples_per_s), 1, kRounding);
    EXPECT_NEAR(rates.gradient_samples_per_s / Median(samples.gradient_samples_per_s), 1,
                kRounding);
    // A part is never slower than the whole that it is of.
    EXPECT_GE(rates.gradient_samples_per_s, rates.update_samples_per_s);
    EXPECT_GT(rates.efficiency, 0);
    EXPECT_LE(rates.efficiency, 1);
    EXPECT_EQ(rates.exchanges, 0) << "there is but one rank";
  }
  EXPECT_EQ(all[0].update_flops_per_sample, all[1].update_flops_per_sample);
}

}  // namespace
}  // namespace skein
