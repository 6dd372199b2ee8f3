// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "base/worker_pool.h"
#include "tests/train/small_config.h"
#include "train/policy/evaluate.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

/// A training that evaluates after every iteration, and learns fast enough for the few episodes
/// that reach their target, by wide tolerances, to become more and fewer.
TrainConfig EvaluatedTraining() {
  TrainConfig config = SmallConfig();
  config.evaluation.interval_iterations = 1;
  config.env.heading.altitude_tolerance_ft = 1500;
  config.env.heading.yaw_tolerance_deg = 40;
  config.env.heading.speed_tolerance_fps = 150;
  config.ppo.learning_rate = 3e-2;
  config.env.time_limit_steps = 400;
  config.total_steps *= 2;
  return config;
}

TEST(BestPolicyTest, IsTheMostSuccessful) {
  WorkerPool pool(2);
  Trainer trainer(EvaluatedTraining(), pool);
  const TrainConfig& config = trainer.config();
  EvaluationOptions options;
  options.episodes = config.evaluation.episodes;
  options.seed = ~config.seed;
  double best = -1;
  int others = 0;
  while (!trainer.finished()) {
    const IterationReport report = trainer.Iterate();
    const EvaluationResult result =
        Evaluate(Agent::MeanOf(trainer.policy()), config.env, options, pool);
    EXPECT_GT(result.success_rate, 0);
    EXPECT_EQ(report.evaluation_success_rate, result.success_rate);
    EXPECT_EQ(report.best, result.success_rate >= best) << report.iteration;
    best = std::max(best, result.success_rate);
    others += !report.best;
  }
  EXPECT_GT(others, 0);
}

TEST(BestPolicyTest, OfEquallySuccessfulOnesItIsTheLatest) {
  TrainConfig config = EvaluatedTraining();
  config.ppo.learning_rate = 1e-30;  // all evaluations are of the same policy
  WorkerPool pool(1);
  Trainer trainer(config, pool);
  const double first = trainer.Iterate().evaluation_success_rate;
  EXPECT_GT(first, 0);
  while (!trainer.finished()) {
    const IterationReport report = trainer.Iterate();
    EXPECT_EQ(report.evaluation_success_rate, first);
    EXPECT_TRUE(report.best) << report.iteration;
  }
}

}  // namespace
}  // namespace skein
