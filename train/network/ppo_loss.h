// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein {

/// What the losses of one minibatch have in common.
struct LossSettings {
  double clip = 0.2;
  double entropy_coefficient = 1e-3;
  double value_coefficient = 1;
  bool clip_value_loss = false;
  bool tanh_mean = true;
  double sample_weight = 1;  ///< 1 / samples of the minibatch
};

/// Sums over samples, each weighted by LossSettings::sample_weight.
struct LossSums {
  double policy_loss = 0, value_loss = 0, entropy = 0, approximate_kl = 0, clip_fraction = 0;

  LossSums& operator+=(const LossSums& other);
};

/// Mean of the Gaussian from the actor's outputs: through tanh, or as it is. In place is allowed.
void GaussianMean(std::int64_t count, bool tanh_mean, const float* output, float* mean);

/// log N(action; mean, exp(log_std)) of each of `rows` actions of `size` values.
void LogProbability(std::int64_t rows, int size, const float* mean, const float* log_std,
                    const float* action, float* log_prob);

/// Differential entropy of a diagonal Gaussian: sum of log_std + log(2 pi e) / 2.
double GaussianEntropy(int size, const float* log_std);

/// Samples of a tile as the losses see them; one value per row but `action` ([rows][size]).
struct ActorSamples {
  const float* action = nullptr;
  const float* old_log_prob = nullptr;
  const float* advantage = nullptr;
};

/// PPO's clipped surrogate (Schulman et al. 2017, equation 7) and the entropy bonus. Writes the
/// gradient with respect to the actor's outputs (before tanh) and adds that of log_std.
LossSums ActorLoss(std::int64_t rows, int size, const LossSettings& settings, const float* output,
                   const float* log_std, const ActorSamples& samples, float* output_gradient,
                   float* log_std_gradient);

/// value_coefficient / 2 times the squared error against `target`; with clip_value_loss the larger
/// of it and the error of a value that moved at most `clip` from `old_value`.
LossSums CriticLoss(std::int64_t rows, const LossSettings& settings, const float* value,
                    const float* target, const float* old_value, float* value_gradient);

}  // namespace skein
