// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/range.h"

namespace skein {

class FieldList;

/// Limits of flight, most of them of the paper's Table 5, and the rewards for ending at one and at
/// the target.
struct TerminationConfig {
  Range alpha_deg{-20, 45};  ///< the paper's public configuration
  Range beta_deg{-30, 30};   ///< the paper's public configuration
  double max_mach = 3, min_mach = 0.01;
  double min_altitude_ft = 2500;
  double max_load_factor = 10;  ///< g, of nz; there is no limit to negative ones
  double failure_reward = -200;
  double late_reward_factor = 1;
  double success_reward = 200;
  /// Limits of flights in training, where they are narrower: what is kept clear of there is kept
  /// clear of by more elsewhere. 0: as above.
  double training_min_mach = 0, training_min_altitude_ft = 0;

  /// For ending at the time limit, and for a target that a mission misses.
  double late_reward() const { return late_reward_factor * failure_reward; }

  /// With the limits that are flown with.
  TerminationConfig Flown() const;
};

/// What of an episode's end and rewards the environment says, not TerminationConfig.
struct EpisodeSettings {
  int time_limit_steps = 0;             ///< control steps
  bool truncate_at_time_limit = false;  ///< no terminal reward there
  double reward_scale = 1;              ///< of step rewards
};

/// Its settings (base/field_list.h).
void ListFields(TerminationConfig& config, FieldList& list);

}  // namespace skein
