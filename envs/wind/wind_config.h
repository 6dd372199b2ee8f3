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
  /// In training the highest of what is drawn, where it is higher. 0: as above.
  double training_speed_max_fps = 0, training_turbulence_max_fps = 0;

  /// What episodes draw from, in training with its own upper ends.
  Range drawn_speed_fps() const { return Widened(speed_fps, training_speed_max_fps); }
  /// The same of turbulence.
  Range drawn_turbulence_fps() const {
    return Widened(turbulence_fps, training_turbulence_max_fps);
  }
  /// Whether any episode has wind.
  bool enabled() const { return drawn_speed_fps().max > 0 || drawn_turbulence_fps().max > 0; }
  /// Whether any episode's gusts turn.
  bool has_rotational_gusts() const { return rotational_gusts && drawn_turbulence_fps().max > 0; }

 private:
  static Range Widened(const Range& range, double max) {
    return {range.min, max > range.max ? max : range.max};
  }
};

/// Its settings (base/field_list.h).
void ListFields(WindConfig& config, FieldList& list);

}  // namespace skein
