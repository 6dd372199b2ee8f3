// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/idle_pedals.h"

#include <algorithm>

#include "envs/actions.h"
#include "train/network/ppo_loss.h"

namespace skein {
namespace {

constexpr int kYawAction = kActionSize - 1;
/// 5e-5 of full pedal, which moves no rudder; one over its square is far from float32's largest.
constexpr float kIdleLogStd = -10;
/// Idle deviations are within rounding of that, by formats of fewer bits, too.
constexpr float kIdleBelow = -9;

}  // namespace

IdlePedals::IdlePedals(const NetworkLayout& layout) {
  const NormalisedLinear& head = layout.layer(layout.head());
  const std::int64_t weights = head.weight + std::int64_t{kYawAction} * head.in;
  const std::int64_t bias = head.bias + kYawAction;
  log_std_ = layout.log_std() + kYawAction;
  idle_ = {{{weights, weights + head.in, 0},
            {bias, bias + 1, 0},
            {log_std_, log_std_ + 1, kIdleLogStd}}};
}

void IdlePedals::Idle(float* parameters) const {
  for (const Parameters& idle : idle_) {
    std::fill(parameters + idle.begin, parameters + idle.end, idle.value);
  }
}

bool IdlePedals::AreIdle(const float* parameters) const {
  return parameters[log_std_] < kIdleBelow &&
         std::all_of(idle_.begin(), idle_.end(), [&](const Parameters& idle) {
           return idle.begin == log_std_ ||
                  std::all_of(parameters + idle.begin, parameters + idle.end,
                              [&idle](float value) { return value == idle.value; });
         });
}

void IdlePedals::Free(float log_std, float* parameters) const { parameters[log_std_] = log_std; }

void IdlePedals::DropGradient(float* gradient) const {
  for (const Parameters& idle : idle_) {
    std::fill(gradient + idle.begin, gradient + idle.end, 0.0f);
  }
}

double IdlePedals::Entropy() { return GaussianEntropy(1, &kIdleLogStd); }

}  // namespace skein
