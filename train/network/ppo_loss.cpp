// SPDX-License-Identifier: Apache-2.0
#include "train/network/ppo_loss.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace skein {
namespace {

constexpr double kHalfLogTwoPi = 0.91893853320467274;

/// LossSums::action_change of `mean`, [rows][size].
double ActionChange(const SequenceTile& tile, int size, const LossSettings& settings,
                    const float* mean) {
  const std::int64_t before = static_cast<std::int64_t>(tile.batch) * size;
  double sum = 0;
  for (std::int64_t row = tile.batch; row < tile.rows(); ++row) {
    if (tile.not_done[row] == 0) continue;
    for (std::int64_t at = row * size; at < (row + 1) * size; ++at) {
      const double change = static_cast<double>(mean[at]) - mean[at - before];
      sum += change * change;
    }
  }
  return sum * settings.pair_weight;
}

/// Adds the gradient of the weighted ActionChange: each step's action is drawn towards those of the
/// steps before and after it.
void AddActionChangeGradient(const SequenceTile& tile, int size, const LossSettings& settings,
                             const float* mean, float* output_gradient) {
  const auto factor =
      static_cast<float>(2 * settings.action_smoothness_coefficient * settings.pair_weight);
  const std::int64_t before = static_cast<std::int64_t>(tile.batch) * size;
  const auto add = [&](std::int64_t at, float by_mean) {
    output_gradient[at] += settings.tanh_mean ? by_mean * (1 - mean[at] * mean[at]) : by_mean;
  };
  for (std::int64_t row = tile.batch; row < tile.rows(); ++row) {
    if (tile.not_done[row] == 0) continue;
    for (std::int64_t at = row * size; at < (row + 1) * size; ++at) {
      const float by_mean = factor * (mean[at] - mean[at - before]);
      add(at, by_mean);
      add(at - before, -by_mean);
    }
  }
}

}  // namespace

LossSums& LossSums::operator+=(const LossSums& other) {
  policy_loss += other.policy_loss;
  value_loss += other.value_loss;
  entropy += other.entropy;
  approximate_kl += other.approximate_kl;
  clip_fraction += other.clip_fraction;
  action_change += other.action_change;
  return *this;
}

void GaussianMean(std::int64_t count, bool tanh_mean, const float* output, float* mean) {
  for (std::int64_t i = 0; i < count; ++i) mean[i] = tanh_mean ? std::tanh(output[i]) : output[i];
}

void LogProbability(std::int64_t rows, int size, const float* mean, const float* log_std,
                    const float* action, float* log_prob) {
  std::vector<float> inverse_std(size);
  double constant = 0;
  for (int j = 0; j < size; ++j) {
    inverse_std[j] = std::exp(-log_std[j]);
    constant -= log_std[j] + kHalfLogTwoPi;
  }
  for (std::int64_t i = 0; i < rows; ++i) {
    float squares = 0;
    for (int j = 0; j < size; ++j) {
      const float deviation = (action[i * size + j] - mean[i * size + j]) * inverse_std[j];
      squares += deviation * deviation;
    }
    log_prob[i] = static_cast<float>(constant) - 0.5f * squares;
  }
}

double GaussianEntropy(int size, const float* log_std) {
  double entropy = 0;
  for (int j = 0; j < size; ++j) entropy += log_std[j] + kHalfLogTwoPi + 0.5;
  return entropy;
}

LossSums ActorLoss(const SampleTile& tile, int size, const LossSettings& settings,
                   const float* output, const float* log_std, float* output_gradient,
                   float* log_std_gradient) {
  const std::int64_t rows = tile.sequence.rows();
  const ActorSamples& samples = tile.actor;
  const auto weight = static_cast<float>(settings.sample_weight);
  const auto low = static_cast<float>(1 - settings.clip);
  const auto high = static_cast<float>(1 + settings.clip);
  std::vector<float> mean(rows * size), log_prob(rows), inverse_std(size);
  GaussianMean(rows * size, settings.tanh_mean, output, mean.data());
  LogProbability(rows, size, mean.data(), log_std, samples.action, log_prob.data());
  for (int j = 0; j < size; ++j) inverse_std[j] = std::exp(-log_std[j]);

  LossSums sums;
  std::vector<double> log_std_sum(size, 0.0);
  for (std::int64_t i = 0; i < rows; ++i) {
    const float log_ratio = log_prob[i] - samples.old_log_prob[i];
    const float ratio = std::exp(log_ratio);
    const float surrogate = ratio * samples.advantage[i];
    const float clipped = std::clamp(ratio, low, high) * samples.advantage[i];
    // Where the clipped term is the smaller one it is constant, and its gradient zero.
    const bool passes = !(surrogate > clipped);
    const float log_prob_gradient = passes ? -weight * surrogate : 0.0f;
    for (int j = 0; j < size; ++j) {
      float& gradient = output_gradient[i * size + j];
      const float m = mean[i * size + j];
      const float deviation = (samples.action[i * size + j] - m) * inverse_std[j];
      const float mean_gradient = log_prob_gradient * deviation * inverse_std[j];
      log_std_sum[j] += log_prob_gradient * (deviation * deviation - 1);
      gradient = settings.tanh_mean ? mean_gradient * (1 - m * m) : mean_gradient;
    }
    sums.policy_loss -= std::min(surrogate, clipped);
    sums.approximate_kl += static_cast<double>(ratio) - 1 - log_ratio;
    sums.clip_fraction += ratio < low || ratio > high;
  }
  if (settings.action_smoothness_coefficient > 0) {
    AddActionChangeGradient(tile.sequence, size, settings, mean.data(), output_gradient);
  }
  const double tile_weight = settings.sample_weight * static_cast<double>(rows);
  for (int j = 0; j < size; ++j) {
    log_std_gradient[j] +=
        static_cast<float>(log_std_sum[j] - settings.entropy_coefficient * tile_weight);
  }
  sums.policy_loss *= settings.sample_weight;
  sums.approximate_kl *= settings.sample_weight;
  sums.clip_fraction *= settings.sample_weight;
  sums.entropy = GaussianEntropy(size, log_std) * tile_weight;
  sums.action_change = ActionChange(tile.sequence, size, settings, mean.data());
  return sums;
}

LossSums CriticLoss(const SampleTile& tile, const LossSettings& settings, const float* value,
                    float* value_gradient) {
  const float *const target = tile.target, *const old_value = tile.old_value;
  const auto clip = static_cast<float>(settings.clip);
  const auto scale = static_cast<float>(settings.sample_weight * settings.value_coefficient);
  LossSums sums;
  for (std::int64_t i = 0; i < tile.sequence.rows(); ++i) {
    float error = value[i] - target[i];
    bool moves = true;
    if (settings.clip_value_loss) {
      const float change = value[i] - old_value[i];
      const float clipped_error = old_value[i] + std::clamp(change, -clip, clip) - target[i];
      if (clipped_error * clipped_error > error * error) {
        error = clipped_error;
        moves = std::abs(change) <= clip;
      }
    }
    value_gradient[i] = moves ? scale * error : 0.0f;
    sums.value_loss += 0.5 * static_cast<double>(error) * error;
  }
  sums.value_loss *= settings.sample_weight;
  return sums;
}

}  // namespace skein
