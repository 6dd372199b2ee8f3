// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/env_storage.h"
#include "envs/tasks/episode_progress.h"
#include "envs/tasks/task.h"

namespace skein {

/// What an environment knows of its aircraft and no policy observes: free of noise, and for
/// training alone, as the further input of a critic. Numbers of about unit size:
///   task_error_0..2      the task's errors, without noise
///   clock                control steps of the episode over the time limit of `rules`, which does
///                        not change as training goes on; a mission takes more than one
///   tolerance            the episode's tolerances as a share of those of evaluations
///   dwell                share of the dwell that the aircraft is within tolerances, up to 1 (if
///                        targets must be held)
///   reached              1 once the target counts as reached (if the flight goes on then)
///   wind_x, _y, _z       the wind along the body axes, in units of 100 ft/s (in windy tiles)
///   plant_...            how the drawn plant differs from the nominal one (if plants are drawn)
class PrivilegedObservation {
 public:
  /// Keeps a reference to `task`.
  PrivilegedObservation(const Task& task, const ProgressRules& rules, bool windy, bool draws_plants)
      : task_(task),
        rules_(rules),
        windy_(windy),
        draws_plants_(draws_plants),
        size_(static_cast<int>(names().size())) {}

  std::vector<std::string> names() const;
  int size() const { return size_; }

  /// Writes rows, row-major [block.count][size()].
  void Observe(const EnvBlock& block, float* rows) const;

 private:
  const Task& task_;
  ProgressRules rules_;
  bool windy_, draws_plants_;
  int size_;
};

}  // namespace skein
