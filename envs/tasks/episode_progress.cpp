// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/episode_progress.h"

#include <algorithm>
#include <limits>

#include "envs/tasks/termination.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/episode_progress.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using IntMask = hn::Mask<IntTag>;

HWY_INLINE VI Whole(std::int32_t value) { return hn::Set(IntTag(), value); }

HWY_INLINE VI Whole(TargetEnd end) { return Whole(static_cast<std::int32_t>(end)); }

HWY_INLINE IntMask IsAtLeast(VI value, VI limit) { return hn::Not(hn::Gt(limit, value)); }

HWY_INLINE void StoreWhere(IntMask where, VI value, VI old, std::int32_t* column) {
  hn::StoreU(hn::IfThenElse(where, value, old), IntTag(), column);
}

HWY_INLINE void CountWhere(IntMask where, std::int32_t* column) {
  const VI before = hn::LoadU(IntTag(), column);
  StoreWhere(where, hn::Add(before, Whole(1)), before, column);
}

/// Aircraft in a control step; where an episode has ended (not `is_flying`) nothing else has a
/// meaning.
struct ProgressLanes {
  IntMask is_flying;
  VI now;            ///< control steps of the episode, with this one
  VI within_before;  ///< consecutive ones within tolerances, without this one
  VI steps_within;   ///< the same with it
  IntMask is_held;   ///< for the dwell
};

HWY_INLINE void WriteEnd(const ProgressRules& rules, VI end, const ProgressStep& step, int first) {
  const FloatTag d;
  hn::StoreU(end, IntTag(), step.target_end + first);
  const Mask is_reached = hn::RebindMask(d, hn::Eq(end, Whole(TargetEnd::kReached)));
  const Mask is_missed = hn::RebindMask(d, hn::Eq(end, Whole(TargetEnd::kMissed)));
  const V missed = hn::IfThenElseZero(is_missed, Constant(rules.missed_reward));
  hn::StoreU(hn::IfThenElse(is_reached, Constant(rules.reached_reward), missed), d,
             step.bonus + first);
}

/// An episode of one target.
HWY_INLINE void AdvanceTarget(const ProgressRules& rules, const ProgressLanes& lanes,
                              const EpisodeProgress& progress, const ProgressStep& step,
                              int first) {
  const IntTag d;
  const VI zero = hn::Zero(d);
  const VI reached_before = hn::LoadU(d, progress.reached_step + first);
  const IntMask is_new = hn::And(lanes.is_held, hn::Eq(reached_before, zero));
  const VI reached_step = hn::IfThenElse(is_new, lanes.now, reached_before);
  StoreWhere(lanes.is_flying, lanes.steps_within, lanes.within_before,
             progress.steps_within + first);
  StoreWhere(lanes.is_flying, reached_step, reached_before, progress.reached_step + first);

  const IntMask is_reached = hn::Gt(reached_step, zero);
  const VI since = hn::Sub(lanes.now, reached_step);
  const IntMask is_over = hn::And(is_reached, IsAtLeast(since, Whole(rules.hold_steps)));
  StoreWhere(lanes.is_flying, hn::IfThenElseZero(is_over, Whole(1)),
             hn::LoadU(d, step.reached + first), step.reached + first);

  // What is within tolerances, or holds what it has reached, is not late.
  const IntMask is_in_time = hn::Or(is_reached, hn::Gt(lanes.steps_within, zero));
  const VI never = Whole(std::numeric_limits<std::int32_t>::max());
  StoreWhere(hn::And(lanes.is_flying, is_in_time), never, Whole(rules.time_limit_steps),
             step.deadline + first);

  const VI end = Whole(rules.hold_steps > 0 ? TargetEnd::kReached : TargetEnd::kNone);
  WriteEnd(rules, hn::IfThenElseZero(hn::And(lanes.is_flying, is_new), end), step, first);
}

/// A flight on a mission, whose targets come one after another.
HWY_INLINE void AdvanceMission(const ProgressRules& rules, const ProgressLanes& lanes,
                               const EpisodeProgress& progress, const ProgressStep& step,
                               int first) {
  const IntTag d;
  const VI zero = hn::Zero(d);
  const VI target_step = hn::LoadU(d, progress.target_step + first);
  const IntMask is_late = IsAtLeast(hn::Sub(lanes.now, target_step), Whole(rules.time_limit_steps));
  const IntMask is_outside = hn::Eq(lanes.steps_within, zero);
  const IntMask is_reached = hn::And(lanes.is_flying, lanes.is_held);
  const IntMask is_missed =
      hn::And(lanes.is_flying, hn::AndNot(lanes.is_held, hn::And(is_outside, is_late)));
  const IntMask is_over = hn::Or(is_reached, is_missed);

  StoreWhere(lanes.is_flying, hn::IfThenZeroElse(is_over, lanes.steps_within), lanes.within_before,
             progress.steps_within + first);
  StoreWhere(is_over, lanes.now, target_step, progress.target_step + first);
  CountWhere(is_reached, progress.targets_reached + first);
  CountWhere(is_missed, progress.targets_missed + first);

  StoreWhere(lanes.is_flying, zero, hn::LoadU(d, step.reached + first), step.reached + first);
  StoreWhere(lanes.is_flying, Whole(rules.mission_steps), Whole(rules.time_limit_steps),
             step.deadline + first);
  const VI missed = hn::IfThenElseZero(is_missed, Whole(TargetEnd::kMissed));
  WriteEnd(rules, hn::IfThenElse(is_reached, Whole(TargetEnd::kReached), missed), step, first);
}

void AdvanceProgressKernel(const ProgressRules& rules, int count, const std::int32_t* steps_before,
                           const std::int32_t* termination, const EpisodeProgress& progress,
                           const ProgressStep& step) {
  const IntTag d;
  const VI none = Whole(static_cast<std::int32_t>(Termination::kNone));
  const VI dwell = Whole(std::max(1, rules.dwell_steps));
  for (int first = 0; first < count; first += kLanes) {
    ProgressLanes lanes;
    lanes.is_flying = hn::Eq(hn::LoadU(d, termination + first), none);
    lanes.now = hn::Add(hn::LoadU(d, steps_before + first), Whole(1));
    const IntMask is_within = hn::Ne(hn::LoadU(d, step.reached + first), hn::Zero(d));
    lanes.within_before = hn::LoadU(d, progress.steps_within + first);
    lanes.steps_within = hn::IfThenElseZero(is_within, hn::Add(lanes.within_before, Whole(1)));
    lanes.is_held = IsAtLeast(lanes.steps_within, dwell);
    if (rules.mission_steps > 0) {
      AdvanceMission(rules, lanes, progress, step, first);
    } else {
      AdvanceTarget(rules, lanes, progress, step, first);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(AdvanceProgressKernel);

void EpisodeProgress::Reset(int i, std::int32_t step) const {
  if (steps_within == nullptr) return;
  for (std::int32_t* const column : {steps_within, reached_step, targets_reached, targets_missed}) {
    column[i] = 0;
  }
  target_step[i] = step;
}

void AdvanceProgress(const ProgressRules& rules, int count, const std::int32_t* steps_before,
                     const std::int32_t* termination, const EpisodeProgress& progress,
                     const ProgressStep& step) {
  SKEIN_DISPATCH(AdvanceProgressKernel)
  (rules, count, steps_before, termination, progress, step);
}

}  // namespace skein
#endif
