// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/action_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simd/random.h"

namespace skein {
namespace {

/// The deviates of step_of(i) for each aircraft i.
template <typename StepOf>
void Fill(const ActionNoiseKey& key, simd::RandomPurpose purpose, int count, int size,
          const StepOf& step_of, ActionNoiseScratch& scratch, float* noise) {
  scratch.step_low.resize(static_cast<std::size_t>(count));
  scratch.step_high.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < scratch.step_low.size(); ++i) {
    const std::uint64_t step = step_of(i);
    scratch.step_low[i] = static_cast<std::uint32_t>(step);
    scratch.step_high[i] = static_cast<std::uint32_t>(step >> 32);
  }
  simd::FillNormals(key.seed, key.first_aircraft, scratch.step_low.data(), scratch.step_high.data(),
                    purpose, count, size, noise);
}

}  // namespace

void FillActionNoise(const ActionNoiseKey& key, int count, int size, ActionNoiseScratch& scratch,
                     float* noise) {
  Fill(
      key, simd::RandomPurpose::kActionNoise, count, size,
      [&](std::size_t) { return key.policy_step; }, scratch, noise);
  if (key.held.share == 0) return;
  const int actions = std::min(size, key.held.actions);
  scratch.held.resize(static_cast<std::size_t>(count * actions));
  const auto steps = static_cast<std::uint64_t>(key.held.steps);
  Fill(
      key, simd::RandomPurpose::kHeldActionNoise, count, actions,
      [&](std::size_t i) { return (key.policy_step + (key.first_aircraft + i) % steps) / steps; },
      scratch, scratch.held.data());
  const auto held = static_cast<float>(std::sqrt(key.held.share));
  const auto fresh = static_cast<float>(std::sqrt(1 - key.held.share));
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < actions; ++k) {
      float& own = noise[i * size + k];
      own = fresh * own + held * scratch.held[static_cast<std::size_t>(i * actions + k)];
    }
  }
}

}  // namespace skein
