// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "train/network/sample_tile.h"

namespace skein {

/// What the losses of one minibatch have in common.
struct LossSettings {
  double clip = 0.2;
  double entropy_coefficient = 1e-3;
  double value_coefficient = 1;
  bool clip_value_loss = false;
  bool tanh_mean = true;
  /// Weight of the mean squared change of the mean action from one step to the next (CAPS).
  double action_smoothness_coefficient = 0;
  double sample_weight = 1;  ///< 1 / samples of the minibatch
  double pair_weight = 0;    ///< 1 / pairs of successive steps within the minibatch's chunks
};

/// Sums over samples, each weighted by LossSettings::sample_weight, and over pairs of successive
/// steps, each by its pair_weight. The coefficients of LossSettings are left out.
struct LossSums {
  double policy_loss = 0, value_loss = 0, entropy = 0, approximate_kl = 0;
  double clip_fraction = 0;  ///< of samples whose ratio lies beyond 1 +- clip, held by it or not
  /// Squared change of the mean action over a pair, summed over its components; none where an
  /// episode ended in between.
  double action_change = 0;

  LossSums& operator+=(const LossSums& other);
};

/// Mean of the Gaussian from the actor's outputs: through tanh, or as it is. In place is allowed.
void GaussianMean(std::int64_t count, bool tanh_mean, const float* output, float* mean);

/// log N(action; mean, exp(log_std)) of each of `rows` actions of `size` values.
void LogProbability(std::int64_t rows, int size, const float* mean, const float* log_std,
                    const float* action, float* log_prob);

/// Differential entropy of a diagonal Gaussian: sum of log_std + log(2 pi e) / 2.
double GaussianEntropy(int size, const float* log_std);

/// PPO's clipped surrogate (Schulman et al. 2017, equation 7), the entropy bonus, and the penalty
/// on action changes (Mysore et al. 2021, "Regularizing action policies for smooth control with
/// reinforcement learning": the temporal term, squared). Writes the gradient with respect to the
/// actor's outputs (before tanh), `size` of them per row, and adds that of log_std.
LossSums ActorLoss(const SampleTile& tile, int size, const LossSettings& settings,
                   const float* output, const float* log_std, float* output_gradient,
                   float* log_std_gradient);

/// Half the squared error against the target; with clip_value_loss the larger of it and that of a
/// value that moved at most `clip` from the old value. Writes the gradient of value_coefficient
/// times that with respect to the values.
LossSums CriticLoss(const SampleTile& tile, const LossSettings& settings, const float* value,
                    float* value_gradient);

}  // namespace skein
