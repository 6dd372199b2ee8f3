// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft.h"
#include "envs/tasks/terms/term_task_config.h"

namespace skein {

/// Where an aircraft's columns of a task of terms are. Targets come first, a point's three at their
/// head.
struct TermColumns {
  explicit TermColumns(const TermTaskConfig& config);

  int num_targets = 0;
  int attitude = -1;    ///< the quaternion of the target pitch and yaw; -1: none
  int last_point = -1;  ///< north, east, altitude at the end of the control step before; -1: none
  int share = 0;        ///< of the episode's tolerances
  int box = -1;         ///< half the width of the point's box, ft; -1: none
  int count = 0;

  /// The first column of target `index`.
  static int OfTarget(const TermTaskConfig& config, int index);
};

/// The value of a unit.
double Worth(const TermUnit& unit, const ReferenceUnits& units);

}  // namespace skein
