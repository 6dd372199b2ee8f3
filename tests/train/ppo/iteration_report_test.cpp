// SPDX-License-Identifier: Apache-2.0
// What an iteration of a training reports, beside how well it learned.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/tolerance.h"
#include "tests/train/small_config.h"
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

}  // namespace
}  // namespace skein
