// SPDX-License-Identifier: Apache-2.0
// Trainings in which conditions widen, and prices and time limits grow.
#include <gtest/gtest.h>

#include <vector>

#include "tests/train/small_config.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

/// The ramp that is over after the first of SmallConfig's four iterations.
constexpr double kOneIteration = 0.25;

/// What tells trainings apart: the explained variance of the first `count` rollouts, each of which
/// shows the environment as it was, and the updates before it.
std::vector<double> Rollouts(const TrainConfig& config, int count) {
  WorkerPool pool(1);
  Trainer trainer(config, pool);
  std::vector<double> seen;
  for (int i = 0; i < count; ++i) seen.push_back(trainer.Iterate().explained_variance);
  return seen;
}

TEST(RampsTest, CostsOfHandlingGrowFromNothingOverTheirShareOfTheBudget) {
  TrainConfig free = SmallConfig(), priced = free;
  priced.env.reward.roll_rate = priced.env.reward.action_change = 1;
  TrainConfig ramped = priced;
  ramped.ppo.handling_ramp = kOneIteration;
  const std::vector<double> unpriced = Rollouts(free, 2), grown = Rollouts(ramped, 2);
  EXPECT_NE(Rollouts(priced, 1).front(), unpriced[0]);
  EXPECT_EQ(grown[0], unpriced[0]);
  EXPECT_NE(grown[1], unpriced[1]);
}

TEST(RampsTest, WhatHasGrownStaysAtItsFullWeight) {
  TrainConfig priced = SmallConfig();
  priced.env.reward.roll_rate = 1;
  priced.ppo.popart = false;
  priced.ppo.learning_rate = 1e-30;  // rollouts then differ by their rewards alone
  TrainConfig ramped = priced;
  ramped.ppo.handling_ramp = kOneIteration;
  const std::vector<double> full = Rollouts(priced, 4), grown = Rollouts(ramped, 4);
  EXPECT_NE(grown[0], full[0]);
  for (const std::size_t rollout : {1u, 2u, 3u}) EXPECT_EQ(grown[rollout], full[rollout]);
}

TEST(RampsTest, ThePriceOfChangesInTheLossGrowsAsTheOthersDo) {
  TrainConfig priced = SmallConfig();
  priced.ppo.action_smoothness_coefficient = 1;
  TrainConfig half = priced, ramped = priced;
  half.ppo.action_smoothness_coefficient = 0.5;
  ramped.ppo.handling_ramp = 2 * kOneIteration;  // the first update comes after half of it
  const double after_half = Rollouts(half, 2)[1];
  EXPECT_NE(Rollouts(priced, 2)[1], after_half);
  EXPECT_EQ(Rollouts(ramped, 2)[1], after_half);
}

TEST(RampsTest, ConditionsWidenFromTheMildestOverTheirShareOfTheBudget) {
  TrainConfig mild = SmallConfig();
  mild.env.initial.trimmed = false;  // trims are interpolated between the range's ends
  TrainConfig wide = mild;
  wide.env.initial.altitude_ft = {mild.env.initial.altitude_ft.min, 40000};
  for (Range* const range : {&mild.env.initial.altitude_ft, &mild.env.initial.true_airspeed_fps}) {
    range->max = range->min;
  }
  TrainConfig widening = wide;
  widening.ppo.condition_ramp = kOneIteration;
  const std::vector<double> mildest = Rollouts(mild, 2), widened = Rollouts(widening, 2);
  EXPECT_NE(Rollouts(wide, 1).front(), mildest[0]);
  EXPECT_EQ(widened[0], mildest[0]);
  EXPECT_NE(widened[1], mildest[1]);
}

TEST(RampsTest, TimeLimitsOfTargetsGrowOverTheirShareOfTheBudget) {
  TrainConfig long_limit = SmallConfig();
  long_limit.env.mission.training_length_s = 4;
  long_limit.env.mission.training_time_limit_s = 1.6;
  TrainConfig short_limit = long_limit, growing = long_limit;
  short_limit.env.mission.training_time_limit_s = growing.env.mission.training_time_limit_s = 0.4;
  growing.ppo.time_limit_ramp = kOneIteration;
  const std::vector<double> shortest = Rollouts(short_limit, 2), grown = Rollouts(growing, 2);
  EXPECT_NE(Rollouts(long_limit, 1).front(), shortest[0]);
  EXPECT_EQ(grown[0], shortest[0]);
  EXPECT_NE(grown[1], shortest[1]);
}

}  // namespace
}  // namespace skein
