// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/range.h"

namespace skein {

class FieldList;

/// How the air moves. Every episode draws its own from the ranges.
struct WindConfig {
  Range speed_fps{0, 0};   ///< of the steady wind, which is horizontal
  Range from_deg{0, 360};  ///< where it comes from: 0 is north, 90 is east
  /// Standard deviation of Dryden turbulence (envs/wind/dryden.h); 0 has none.
  Range turbulence_fps{0, 0};
  /// That is the standard deviation at 20,000 ft, and elsewhere what MIL-F-8785C has for it
  /// (TurbulenceAt); false: it is the same at every altitude.
  bool turbulence_by_altitude = false;
  /// Gusts also turn (envs/wind/dryden.h).
  bool rotational_gusts = false;
  /// The aircraft is trimmed in still air, keeps its velocity over ground and meets the steady wind
  /// as a step at the start of the episode. false: it is trimmed in the moving air.
  bool step_at_reset = true;

  /// Whether any episode has wind.
  bool enabled() const { return speed_fps.max > 0 || turbulence_fps.max > 0; }
  /// Whether any episode's gusts turn.
  bool has_rotational_gusts() const { return rotational_gusts && turbulence_fps.max > 0; }
};

/// Its settings (base/field_list.h).
void ListFields(WindConfig& config, FieldList& list);

}  // namespace skein
