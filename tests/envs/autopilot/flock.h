// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "envs/autopilot/autopilot.h"
#include "envs/step_memory.h"
#include "envs/tasks/termination.h"
#include "envs/vec_env.h"

namespace skein {

/// Aircraft of one environment under one autopilot.
class Flock {
 public:
  Flock(const EnvConfig& config, const AutopilotGains& gains, int count, std::uint64_t seed)
      : env_(config, count, seed, count),
        autopilot_(MakeAutopilot(config, gains)),
        count_(count),
        observation_(Times(env_.observation_size())),
        state_(Times(autopilot_->state_size())),
        action_(Times(env_.action_size())),
        memory_(count) {}

  /// One control step of all.
  void Step() {
    env_.Observe(0, observation_.data());
    autopilot_->Act(count_, observation_.data(), state_.data(), action_.data());
    env_.Step(0, action_.data(), memory_.output());
    for (int i = 0; i < count_; ++i) {
      if (HasEnded(i))
        std::fill_n(state_.begin() + i * autopilot_->state_size(), autopilot_->state_size(), 0.0f);
    }
  }

  const VecEnv& env() const { return env_; }
  int count() const { return count_; }
  bool HasEnded(int i) const { return memory_.termination[static_cast<std::size_t>(i)] != 0; }
  Termination termination(int i) const {
    return static_cast<Termination>(memory_.termination[static_cast<std::size_t>(i)]);
  }
  int episode_steps(int i) const { return memory_.episode_steps[static_cast<std::size_t>(i)]; }
  float action(int i, int k) const {
    return action_[static_cast<std::size_t>(i * env_.action_size() + k)];
  }

 private:
  std::size_t Times(int size) const {
    return static_cast<std::size_t>(count_) * static_cast<std::size_t>(size);
  }

  VecEnv env_;
  std::unique_ptr<Policy> autopilot_;
  int count_;
  std::vector<float> observation_, state_, action_;
  StepMemory memory_;
};

/// The first episode of every aircraft of a flock.
struct FlockScore {
  double success_rate = 0;
  double mean_seconds = 0;  ///< to the target, of those that reached it
};

inline FlockScore FirstEpisodes(const EnvConfig& config, const AutopilotGains& gains, int count,
                                std::uint64_t seed) {
  Flock flock(config, gains, count, seed);
  std::vector<bool> ended(static_cast<std::size_t>(count));
  int reached = 0, steps = 0;
  for (int step = 0; step < config.time_limit_steps; ++step) {
    flock.Step();
    for (int i = 0; i < count; ++i) {
      if (ended[static_cast<std::size_t>(i)] || !flock.HasEnded(i)) continue;
      ended[static_cast<std::size_t>(i)] = true;
      if (flock.termination(i) != Termination::kTargetReached) continue;
      ++reached;
      steps += flock.episode_steps(i);
    }
  }
  return {static_cast<double>(reached) / count,
          steps * config.control_interval_s / std::max(reached, 1)};
}

}  // namespace skein
