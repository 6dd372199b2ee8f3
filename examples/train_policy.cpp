// SPDX-License-Identifier: Apache-2.0
// Trains a small policy of the Heading task for a few iterations and saves it. The preset of the
// program (configs/heading/default.toml) has what a good one needs: 4e8 steps, among others.
//   train_policy small.skein
#include <skein/base/worker_pool.h>
#include <skein/train/ppo/trainer.h>

#include <cstdio>
#include <exception>

namespace {

void TrainPolicy(const char* path) {
  skein::TrainConfig config;
  config.env.task = "heading";
  config.env.action_repeat = 10;
  config.network.hidden_size = config.network.gru_size = 32;
  config.ppo.num_aircraft = 256;
  config.ppo.rollout_steps = 32;
  config.total_steps = 3 * 256 * 32 * 10;  // control steps: three iterations

  skein::WorkerPool pool;  // a thread per core; the result does not depend on their number
  skein::Trainer trainer(config, pool);
  while (!trainer.finished()) {
    const skein::IterationReport report = trainer.Iterate();
    std::printf("iteration %d: %.0f control steps, value loss %.3f\n",
                static_cast<int>(report.iteration), static_cast<double>(report.env_steps),
                report.value_loss);
  }
  trainer.policy().Save(path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: train_policy POLICY.skein\n");
    return 2;
  }
  try {
    TrainPolicy(argv[1]);
  } catch (const std::exception& error) {  // skein::Error says what is wrong in one line
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
