#include "train/tile_pilot.h"

#include <algorithm>
#include <cmath>

#include "simd/random.h"

namespace skein {

TilePilot::TilePilot(const Policy& policy, const VecEnv& env, int tile, std::uint64_t seed,
                     bool deterministic)
    : policy_(policy),
      env_(env),
      tile_(tile),
      begin_(env.tile_begin(tile)),
      count_(env.tile_count(tile)),
      seed_(seed),
      deterministic_(deterministic),
      observation_(static_cast<std::size_t>(count_) * env.observation_size()),
      state_(static_cast<std::size_t>(count_) * policy.state_size(), 0.0f),
      action_(static_cast<std::size_t>(count_) * env.action_size()),
      noise_(action_.size()),
      log_std_(env.action_size()),
      decision_low_(count_),
      decision_high_(count_, 0) {}

const std::vector<float>& TilePilot::Decide() {
  env_.Observe(tile_, observation_.data());
  policy_.Act(count_, observation_.data(), state_.data(), action_.data(), log_std_.data());
  if (!deterministic_) {
    const int actions = env_.action_size();
    std::fill(decision_low_.begin(), decision_low_.end(), decision_);
    simd::FillNormals(seed_, static_cast<std::uint32_t>(begin_), decision_low_.data(),
                      decision_high_.data(), simd::RandomPurpose::kActionNoise, count_, actions,
                      noise_.data());
    for (int i = 0; i < count_ * actions; ++i) {
      action_[i] += std::exp(log_std_[i % actions]) * noise_[i];
    }
  }
  ++decision_;
  return action_;
}

void TilePilot::Forget(int index) {
  std::fill_n(state_.begin() + static_cast<std::int64_t>(index) * policy_.state_size(),
              policy_.state_size(), 0.0f);
}

}  // namespace skein
