// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// Flights of many targets. A target that is held counts, and one that is not held within the time
/// limit is missed; either way the next is drawn, and the flight goes on.
struct MissionConfig {
  double length_s = 0;  ///< 0: an episode has one target
  double dwell_s = 5;   ///< for which a target must be held; one of a point is met at once
  /// Of flights in training, whatever evaluations fly: what comes after a target is learned then,
  /// too. 0: as above.
  double training_length_s = 0;
  /// Time after which they miss a target (VecEnv::SetTimeLimitShare lets it grow). A short one
  /// brings new targets to a policy that cannot turn back to one that it has passed. 0: as
  /// evaluations do.
  double training_time_limit_s = 0;

  /// Share of flights in training, where they are no missions, whose target is one that a mission
  /// would ask for where they begin (JoinMission).
  double training_target_share = 0;

  bool is_of_training() const { return training_length_s > 0; }  ///< whether training has its own
  /// What is flown of the two lengths, s; 0: an episode has one target.
  double flown_length_s() const { return is_of_training() ? training_length_s : length_s; }
  bool enabled() const { return flown_length_s() > 0; }  ///< whether flights are missions
};

class FieldList;

/// Its settings (base/field_list.h).
void ListFields(MissionConfig& config, FieldList& list);

}  // namespace skein
