// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein {

/// When a target counts as reached, and what comes then.
struct ProgressRules {
  int dwell_steps = 0;    ///< control steps within tolerances without a break; 0: at first touch
  int hold_steps = 0;     ///< for which the flight goes on after that
  int mission_steps = 0;  ///< length of a flight of many targets; 0: one target
  int time_limit_steps = 0;
  /// For a target that is reached where the flight goes on; reward_scale leaves both alone.
  float reached_reward = 0;
  float missed_reward = 0;  ///< for one of a mission that is missed

  /// Whether an aircraft's progress must be remembered: else episodes end at first touch.
  bool enabled() const { return dwell_steps > 0 || hold_steps > 0 || mission_steps > 0; }
};

/// How far each aircraft of a block has come with its target: columns, padded as Tile says. All
/// null where ProgressRules ask for nothing to be remembered.
struct EpisodeProgress {
  static constexpr int kNumColumns = 5;

  std::int32_t* steps_within = nullptr;  ///< consecutive control steps within tolerances up to now
  std::int32_t* reached_step = nullptr;  ///< of the episode, when the target counted; 0: not yet
  std::int32_t* target_step = nullptr;   ///< of the episode, when the target was given
  std::int32_t* targets_reached = nullptr;  ///< of a mission
  std::int32_t* targets_missed = nullptr;   ///< of a mission

  /// The `i`-th aircraft begins an episode, whose clock shows `step`.
  void Reset(int i, std::int32_t step) const;
};

/// What became of a target, while the flight goes on, in a control step.
enum class TargetEnd : std::uint8_t { kNone, kReached, kMissed };

/// What a control step comes to, one element per aircraft, padded as Tile says.
struct ProgressStep {
  /// Where the state is within tolerances; changed into where the episode ends for that.
  std::int32_t* reached = nullptr;
  std::int32_t* deadline = nullptr;    ///< the control step of the episode at which time ends it
  std::int32_t* target_end = nullptr;  ///< a TargetEnd
  float* bonus = nullptr;              ///< reward for a target after which the flight goes on
};

/// One control step of `count` aircraft, but those that have a `termination`: columns, padded as
/// Tile says. `steps_before` are the control steps of their episodes before it. What becomes of a
/// target comes before what becomes of the flight: one that is lost in the same control step has
/// reached it, or missed it.
void AdvanceProgress(const ProgressRules& rules, int count, const std::int32_t* steps_before,
                     const std::int32_t* termination, const EpisodeProgress& progress,
                     const ProgressStep& step);

}  // namespace skein
