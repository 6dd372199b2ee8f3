// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <utility>

#include "base/worker_pool.h"
#include "tests/train/small_config.h"
#include "train/policy/evaluate.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

/// A training that evaluates after every iteration, and whose wide tolerances some episodes reach.
TrainConfig EvaluatedTraining() {
  TrainConfig config = SmallConfig();
  config.evaluation.interval_iterations = 1;
  config.env.heading.altitude_tolerance_ft = 2000;
  config.env.heading.yaw_tolerance_deg = 100;
  config.env.heading.speed_tolerance_fps = 200;
  config.total_steps *= 2;
  return config;
}

TEST(BestPolicyTest, IsTheMostSuccessfulAndOfThoseTheOneOfTheLargestReturn) {
  WorkerPool pool(2);
  Trainer trainer(EvaluatedTraining(), pool);
  const TrainConfig& config = trainer.config();
  EvaluationOptions options;
  options.episodes = config.evaluation.episodes;
  options.seed = ~config.seed;
  std::pair<double, double> best{-1, 0};
  int bests = 0, others = 0;
  while (!trainer.finished()) {
    const IterationReport report = trainer.Iterate();
    const EvaluationResult result =
        Evaluate(Agent::MeanOf(trainer.policy()), config.env, options, pool);
    EXPECT_GT(result.success_rate, 0);
    EXPECT_EQ(report.evaluation_success_rate, result.success_rate);
    const std::pair<double, double> now{result.success_rate, result.return_mean};
    EXPECT_EQ(report.best, now > best) << report.iteration;
    if (now > best) best = now;
    ++(report.best ? bests : others);
  }
  EXPECT_GT(bests, 0);
  EXPECT_GT(others, 0);
}

}  // namespace
}  // namespace skein
