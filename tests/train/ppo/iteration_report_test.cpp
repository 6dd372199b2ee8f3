// SPDX-License-Identifier: Apache-2.0
// What an iteration of a training reports, beside how well it learned.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/tolerance.h"
#include "tests/train/small_config.h"
#include "train/policy/evaluate.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

TEST(IterationReportTest, EvaluationsComeAtTheirIntervalAndAtTheEnd) {
  TrainConfig config = SmallConfig();  // of four iterations
  config.evaluation.interval_iterations = 3;
  WorkerPool pool(1);
  Trainer trainer(config, pool);
  std::vector<bool> evaluated;
  while (!trainer.finished()) evaluated.push_back(trainer.Iterate().evaluation_success_rate >= 0);
  EXPECT_EQ(evaluated, std::vector<bool>({false, false, true, true}));
}

TEST(IterationReportTest, EntropyAndDeviationAreOfTheActionsThatAreExplored) {
  constexpr Tolerance kFloat32{1e-5, "float32 sums of three or four entropies"};
  const double of_unit_deviation = 0.5 * std::log(2 * M_PI * std::exp(1.0));
  for (const bool pedals : {false, true}) {
    TrainConfig config = SmallConfig();
    config.ppo.pedals = pedals;
    config.ppo.learning_rate = 1e-30;  // the deviations stay what they are
    config.network.initial_log_std = -0.75;
    WorkerPool pool(1);
    const IterationReport report = Trainer(config, pool).Iterate();
    const int explored = pedals ? 4 : 3;
    EXPECT_NEAR(report.log_std_mean, -0.75, kFloat32);
    EXPECT_NEAR(report.entropy, explored * (of_unit_deviation - 0.75), kFloat32);
  }
}

TEST(IterationReportTest, WhatEvaluationsHeldIsThatOfTheSameEpisodes) {
  TrainConfig config = SmallConfig();
  config.evaluation.interval_iterations = 1;
  config.env.hold_s = 0.2;
  config.env.heading.earliest_success_step = 1;
  config.env.heading.altitude_tolerance_ft = 1500;
  config.env.heading.yaw_tolerance_deg = 40;
  config.env.heading.speed_tolerance_fps = 150;
  WorkerPool pool(1);
  Trainer trainer(config, pool);
  const IterationReport report = trainer.Iterate();
  EvaluationOptions options;
  options.episodes = config.evaluation.episodes;
  options.seed = ~config.seed;
  const EvaluationResult result =
      Evaluate(Agent::MeanOf(trainer.policy()), config.env, options, pool);
  EXPECT_GT(result.success_rate, 0);
  EXPECT_GT(result.hold_within_mean, 0);
  EXPECT_NE(result.hold_within_mean, result.success_rate);
  EXPECT_EQ(report.evaluation_success_rate, result.success_rate);
  EXPECT_EQ(report.evaluation_hold_within, result.hold_within_mean);
}

TEST(IterationReportTest, AtARateOfZeroPoliciesOfLinearMeansStayWhereTheyAreToo) {
  constexpr Tolerance kSquareOfRounding{1e-7, "the square of float32 roundings of about ten"};
  TrainConfig config = SmallConfig();
  config.network.tanh_mean = false;
  config.ppo.learning_rate = 1e-2;  // means grow beyond where tanh is linear
  config.ppo.final_learning_rate_fraction = 0;
  WorkerPool pool(1);
  Trainer trainer(config, pool);
  IterationReport last;
  while (!trainer.finished()) last = trainer.Iterate();
  EXPECT_EQ(last.learning_rate, 0);
  EXPECT_NEAR(last.approximate_kl, 0, kSquareOfRounding);
  EXPECT_EQ(last.clip_fraction, 0);
}

}  // namespace
}  // namespace skein
