// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/episode_progress.h"

#include <algorithm>
#include <limits>

#include "base/field_list.h"
#include "envs/tasks/termination.h"

namespace skein {
namespace {

constexpr std::int32_t kNever = std::numeric_limits<std::int32_t>::max();

/// One aircraft's flight on a mission, whose targets come one after another.
TargetEnd AdvanceMission(const ProgressRules& rules, std::int32_t now, bool is_held,
                         const EpisodeProgress& progress, int i) {
  if (is_held) {
    ++progress.targets_reached[i];
  } else if (progress.steps_within[i] == 0 &&
             now - progress.target_step[i] >= rules.time_limit_steps) {
    ++progress.targets_missed[i];
  } else {
    return TargetEnd::kNone;
  }
  progress.steps_within[i] = 0;
  progress.target_step[i] = now;
  return is_held ? TargetEnd::kReached : TargetEnd::kMissed;
}

}  // namespace

void ListFields(MissionConfig& config, FieldList& list) {
  list.Add("length_s", &config.length_s, Bounds::NotNegative(),
           "length of a flight of one target after another; 0: an episode has one target")
      .OffUnless(config.enabled());
  list.Add("dwell_s", &config.dwell_s, Bounds::NotNegative(),
           "time for which a target of a mission must be held before the next comes")
      .OffUnless(config.enabled());
  list.Add("training_length_s", &config.training_length_s, Bounds::NotNegative(),
           "the length of flights in training, if it is not 0: evaluations fly what is asked for "
           "above")
      .TrainingOnly()
      .OffUnless(config.is_of_training());
  list.Add("training_time_limit_s", &config.training_time_limit_s, Bounds::NotNegative(),
           "time after which such a flight misses a target (ppo.time_limit_ramp lets it "
           "grow); 0: env.time_limit_steps")
      .TrainingOnly()
      .OffUnless(config.is_of_training() && config.training_time_limit_s > 0);
}

void EpisodeProgress::Reset(int i) const {
  if (steps_within == nullptr) return;
  for (std::int32_t* const column :
       {steps_within, reached_step, target_step, targets_reached, targets_missed}) {
    column[i] = 0;
  }
}

void AdvanceProgress(const ProgressRules& rules, int count, const std::int32_t* steps_before,
                     const std::int32_t* termination, const EpisodeProgress& progress,
                     std::int32_t* reached, std::int32_t* deadline, TargetEnd* target_end) {
  const std::int32_t dwell = std::max(1, rules.dwell_steps);
  for (int i = 0; i < count; ++i) {
    target_end[i] = TargetEnd::kNone;
    deadline[i] = rules.time_limit_steps;
    if (termination[i] != static_cast<std::int32_t>(Termination::kNone)) continue;
    const std::int32_t now = steps_before[i] + 1;
    progress.steps_within[i] = reached[i] != 0 ? progress.steps_within[i] + 1 : 0;
    const bool is_held = progress.steps_within[i] >= dwell;
    if (rules.mission_steps > 0) {
      target_end[i] = AdvanceMission(rules, now, is_held, progress, i);
      reached[i] = 0;
      deadline[i] = rules.mission_steps;
      continue;
    }
    std::int32_t& reached_step = progress.reached_step[i];
    if (is_held && reached_step == 0) {
      reached_step = now;
      if (rules.hold_steps > 0) target_end[i] = TargetEnd::kReached;
    }
    // What is within tolerances, or holds what it has reached, is not late.
    if (reached_step > 0 || progress.steps_within[i] > 0) deadline[i] = kNever;
    reached[i] = reached_step > 0 && now - reached_step >= rules.hold_steps;
  }
}

}  // namespace skein
