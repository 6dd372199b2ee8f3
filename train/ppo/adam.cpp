// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/adam.h"

#include <cmath>
#include <cstddef>
#include <string>

#include "base/error.h"
#include "train/ppo/adam_kernel.h"

namespace skein {
namespace {

constexpr double kBeta1 = 0.9, kBeta2 = 0.999;

AlignedVector<float> Padded(const std::vector<float>& values) {
  AlignedVector<float> padded(values.begin(), values.end());
  const auto size = static_cast<std::int64_t>(values.size());
  padded.resize((size + kAdamPadding - 1) / kAdamPadding * kAdamPadding, 0.0f);
  return padded;
}

}  // namespace

AdamOptimiser::AdamOptimiser(const std::vector<float>& parameters, double epsilon,
                             const RateFactor& rate_factor)
    : size_(static_cast<std::int64_t>(parameters.size())),
      epsilon_(epsilon),
      rate_factor_(rate_factor),
      parameters_(Padded(parameters)),
      gradient_(parameters_.size(), 0.0f),
      first_moment_(parameters_.size(), 0.0f),
      second_moment_(parameters_.size(), 0.0f) {}

void AdamOptimiser::Step(double learning_rate, float gradient_scale) {
  ++step_;
  const auto t = static_cast<double>(step_);
  AdamStep step;
  step.size = static_cast<std::int64_t>(parameters_.size());
  step.parameters = parameters_.data();
  step.first_moment = first_moment_.data();
  step.second_moment = second_moment_.data();
  step.gradient = gradient_.data();
  step.gradient_scale = gradient_scale;
  step.beta1 = static_cast<float>(kBeta1);
  step.one_minus_beta1 = static_cast<float>(1 - kBeta1);
  step.beta2 = static_cast<float>(kBeta2);
  step.one_minus_beta2 = static_cast<float>(1 - kBeta2);
  step.root_correction = static_cast<float>(std::sqrt(1 - std::pow(kBeta2, t)));
  step.epsilon = static_cast<float>(epsilon_);
  step.step_size = static_cast<float>(learning_rate / (1 - std::pow(kBeta1, t)));
  float* const hastened = parameters() + rate_factor_.begin;
  const std::vector<float> before(hastened, parameters() + rate_factor_.end);
  TakeAdamStep(step);
  const auto factor = static_cast<float>(rate_factor_.factor);
  for (std::size_t i = 0; i < before.size(); ++i) {
    hastened[i] = before[i] + factor * (hastened[i] - before[i]);
  }
}

void AdamOptimiser::SetParameters(const std::vector<float>& parameters) {
  parameters_ = Padded(parameters);
}

AdamState AdamOptimiser::state() const {
  return {step_,
          {first_moment_.begin(), first_moment_.begin() + size_},
          {second_moment_.begin(), second_moment_.begin() + size_}};
}

void AdamOptimiser::Restore(const AdamState& state) {
  for (const auto* const moment : {&state.first_moment, &state.second_moment}) {
    if (static_cast<std::int64_t>(moment->size()) == size_) continue;
    throw Error("Adam's moments have " + std::to_string(moment->size()) + " values for " +
                std::to_string(size_) + " parameters");
  }
  step_ = state.step;
  first_moment_ = Padded(state.first_moment);
  second_moment_ = Padded(state.second_moment);
}

}  // namespace skein
