// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "base/worker_pool.h"
#include "train/policy/evaluate.h"
#include "train/policy/recurrent_policy.h"

int main() {
  const skein::RecurrentPolicy policy = skein::RecurrentPolicy::Untrained({}, 22, 4, 1);
  skein::EnvConfig config;
  config.time_limit_steps = config.heading.earliest_success_step = 100;
  skein::EvaluationOptions options;
  options.episodes = 32;
  skein::WorkerPool pool(1);
  const skein::EvaluationResult result =
      skein::Evaluate(skein::Agent::MeanOf(policy), config, options, pool);
  std::printf("mean return of an untrained policy: %.1f\n", result.return_mean);
  return result.episodes == 32 ? 0 : 1;
}
