// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "envs/state/state.h"

namespace skein {

class FieldList;

/// What handling costs, in reward before reward_scale: the weights of terms beside the task's own.
/// "Near" terms are multiplied by 1 / (1 + near_sharpness |error|^2) of the task's normalised
/// errors: they cost in full where the target is held, and little on the way to it. All zero is
/// the paper's.
struct HandlingCosts {
  // Of a control step.
  double near_roll_rate = 0, near_pitch_rate = 0, near_yaw_rate = 0;  ///< per rad/s
  /// Per g that the load factor differs from that of unaccelerated flight, cos(pitch) cos(roll).
  double near_load_factor = 0;
  double near_bank = 0;  ///< per unit of 1 - cos(roll), at most 2
  double roll_rate = 0;  ///< per rad/s, near or not
  double sideslip = 0;   ///< per unit of sin(beta), near or not
  double near_sharpness = 20;
  /// What they are multiplied by at least once the target counts as reached. With 1 a target that
  /// cannot be held is no reason to weave after it; above 1 holding costs more than arriving.
  double near_floor = 0;
  /// Of a control step in which the target counts as touched (within the episode's tolerances, and
  /// for Heading not before its earliest success): gained, not lost.
  double within_tolerances = 0;
  /// Of any other control step: a time penalty. What is gained within them is none, as a
  /// flight ends a given time after it reached its target, however late.
  double outside_tolerances = 0;
  /// Of a control step until the target counts as reached: a time penalty that leaves the hold
  /// alone. In missions, of every control step.
  double before_reached = 0;
  /// Of a policy step, per squared change of each of its actions but the throttle, which are
  /// clipped to [-1, 1].
  double action_change = 0;

  /// With all weights times `factor`.
  HandlingCosts Times(double factor) const;
  /// Whether any cost of a control step has a weight.
  bool of_control_steps() const;
  /// Whether it matters to the reward what the tolerances are, and how far the target is reached.
  bool of_tolerances() const {
    return within_tolerances > 0 || outside_tolerances > 0 || before_reached > 0;
  }
  /// Whether any weight is not zero.
  bool enabled() const { return of_control_steps() || of_tolerances() || action_change > 0; }
};

/// Its settings (base/field_list.h).
void ListFields(HandlingCosts& config, FieldList& list);

/// Subtracts the costs of a control step from `reward`, one element per aircraft. `errors` are the
/// task's normalised ones, kNumTaskErrors columns `error_stride` apart; `reached_step` is
/// EpisodeProgress's before the control step, padded as Tile says, or null.
void SubtractHandlingCosts(const HandlingCosts& costs, Tile flight, const float* errors,
                           std::size_t error_stride, const std::int32_t* reached_step,
                           float* reward);

/// Adds what `count` aircraft gain where they are `within` their tolerances, and subtracts what
/// they lose elsewhere, and until their targets count, by the same `reached_step`.
void RewardTolerances(const HandlingCosts& costs, int count, const std::int32_t* within,
                      const std::int32_t* reached_step, float* reward);

/// Subtracts the cost of changing from `last` to `action` from `reward`, and keeps the new ones.
/// `action` is row-major [last.count][action_size], not clipped; `last` has a column of each. The
/// `first` actions cost nothing.
void SubtractActionChange(const HandlingCosts& costs, const float* action, int action_size,
                          int first, Tile last, float* reward);

}  // namespace skein
