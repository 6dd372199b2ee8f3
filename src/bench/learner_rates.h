// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/worker_pool.h"
#include "train/network/backend.h"
#include "train/ppo/train_config.h"
#include "train/ranks/ranks.h"

namespace skein {

/// Rates of the parts of an iteration, medians over iterations.
struct LearnerRates {
  BackendChoice backend;                  ///< what computed the networks
  double rollout_policy_steps_per_s = 0;  ///< simulator in the loop
  double simulator_share = 0;             ///< of the rollout's time, low-level policy included
  /// Of the networks' products until the next policy step, a low-level policy's among them.
  double rollout_flops_per_policy_step = 0;
  double update_samples_per_s = 0;    ///< through forward, loss, backward and optimiser
  double gradient_samples_per_s = 0;  ///< through forward, loss and backward alone
  /// Of both networks' products, ForwardFlops and BackwardFlops (train/network/network.h).
  double update_flops_per_sample = 0;
  double iteration_s = 0;  ///< rollout, update and all between
  /// What the multiply-add units gave between iterations, with the operands of this learner's
  /// products (RoofPrecision).
  double peak_gflops = 0;
  /// Of an iteration, the share that rollout and gradients alone would take.
  double efficiency = 0;
  /// Of an iteration, the share in which ranks compute nothing but exchange or wait for each other,
  /// mean over ranks.
  double exchange_share = 0;
  double exchange_s = 0;  ///< in an iteration, beside computation too, mean over ranks
  double exchanges = 0;   ///< in an iteration, by this rank, one after the other
  double sent_bytes = 0;  ///< in an iteration, by this rank
  /// Of every iteration, in their order.
  struct Samples {
    std::vector<double> iteration_s, rollout_policy_steps_per_s, update_samples_per_s,
        gradient_samples_per_s;
  } samples;
};

/// On all ranks together: trains every configuration for `iterations` iterations after one to warm
/// up, in turns with each other and with the measurements of the peak, so that all meet the same
/// machine. Their evaluations are left out.
std::vector<LearnerRates> MeasureLearners(const std::vector<TrainConfig>& configs, int iterations,
                                          WorkerPool& pool, Ranks& ranks = OneRank());

}  // namespace skein
