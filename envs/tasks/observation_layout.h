// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/plant/plant_columns.h"
#include "envs/tasks/task_errors.h"

namespace skein {

/// Throttle, pitch, roll, yaw.
inline constexpr int kObservedActions = 4;

/// How a row of observations is made up: numbers of the task, what every task's sensors show of the
/// flight (observations 3 to 21 of envs/tasks/observation.h), the last policy step's actions.
struct ObservationLayout {
  int lead = kNumTaskErrors;
  bool flight = true;
  int actions = 0;  ///< kObservedActions or 0

  constexpr bool operator==(const ObservationLayout& other) const {
    return lead == other.lead && flight == other.flight && actions == other.actions;
  }
  constexpr int size() const { return lead + (flight ? kNumSensedNumbers : 0) + actions; }
};

inline constexpr ObservationLayout kStandardObservation{};

/// No row has fewer numbers: they are written four at a time.
inline constexpr int kFewestObservations = 4;
/// No row has more numbers, or more that lead it.
inline constexpr int kMostLeadingNumbers = 24;
inline constexpr int kMostObservations = 48;

}  // namespace skein
