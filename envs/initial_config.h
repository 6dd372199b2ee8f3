// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/range.h"

namespace skein {

class FieldList;

/// Where episodes begin.
struct InitialConfig {
  Range altitude_ft{19000, 20000};
  Range true_airspeed_fps{1000, 1200};
  /// Trimmed at reset (table of float64 trims, bilinear in altitude and speed). false: the paper's
  /// start, level, alpha 0, surfaces centred, Aircraft::untrimmed_thrust_lbf (F-16: 2000 lbf).
  bool trimmed = true;
};

/// Its settings (base/field_list.h).
void ListFields(InitialConfig& config, FieldList& list);

}  // namespace skein
