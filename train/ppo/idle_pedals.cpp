// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/idle_pedals.h"

#include <algorithm>

#include "envs/actions.h"

namespace skein {
namespace {

constexpr int kYaw = kActionSize - 1;
/// Of a standard deviation that moves no rudder, 5e-5 of full pedal, and whose reciprocal's square
/// is far from float32's largest.
constexpr float kIdleLogStd = -10;

}  // namespace

IdlePedals::IdlePedals(const NetworkLayout& layout) {
  const NormalisedLinear& head = layout.layer(layout.head());
  const std::int64_t weights = head.weight + std::int64_t{kYaw} * head.in;
  const std::int64_t bias = head.bias + kYaw, log_std = layout.log_std() + kYaw;
  idle_ = {
      {{weights, weights + head.in, 0}, {bias, bias + 1, 0}, {log_std, log_std + 1, kIdleLogStd}}};
}

void IdlePedals::Apply(float* parameters) const {
  for (const Parameters& of : idle_)
    std::fill(parameters + of.begin, parameters + of.end, of.value);
}

void IdlePedals::DropGradient(float* gradient) const {
  for (const Parameters& of : idle_) std::fill(gradient + of.begin, gradient + of.end, 0.0f);
}

}  // namespace skein
