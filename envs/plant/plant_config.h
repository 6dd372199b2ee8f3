// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/range.h"

namespace skein {

class FieldList;

/// The longest delay that can be drawn, control steps.
inline constexpr int kLongestDelay = 10;

/// Whole numbers from which one is drawn, each as likely as the others.
struct WholeRange {
  int min = 0, max = 0;
};

/// How an episode's aircraft may differ from the configured one. Every episode draws each quantity
/// from its range, and keeps it; the nominal aircraft is what the defaults give. What each acts on:
/// docs/reference/conditions.md.
struct PlantConfig {
  // Factors, but the centre of gravity and the engine's momentum.
  Range mass{1, 1}, inertia{1, 1};
  Range cg_shift{0, 0};  ///< by which the cg lies further aft, fractions of the mean chord
  /// Of the static coefficients by body axes: Cx; Cz; Cm; Cy, Cl and Cn together.
  Range axial_force{1, 1}, normal_force{1, 1}, pitching_moment{1, 1}, lateral{1, 1};
  Range control{1, 1};       ///< of what elevator, aileron and rudder do
  Range weak_surface{1, 1};  ///< of what one of them does, drawn among the three
  Range damping{1, 1};       ///< of all derivatives by p, q and r
  Range thrust{1, 1}, thrust_lag{1, 1};
  Range engine_momentum{0, 0};  ///< beyond the configured one, slug ft^2/s
  Range density{1, 1};          ///< of the air
  Range pitch_stick{1, 1}, roll_stick{1, 1}, yaw_stick{1, 1};
  Range actuator_rate{1, 1}, actuator_bandwidth{1, 1};
  WholeRange action_delay_steps, observation_delay_steps;
  /// Half-widths of each observed number's own bias and scale error; not of the task's errors.
  double sensor_bias = 0, sensor_scale = 0;
  double sensor_freeze_chance = 0;  ///< of an episode in which a sensor keeps its last value...
  Range sensor_freeze_s{5, 30};     ///< ... from this time on

  /// Whether any episode's aircraft may differ from the configured one.
  bool enabled() const;
  /// Whether observed numbers have biases or scale errors.
  bool has_sensor_errors() const { return sensor_bias > 0 || sensor_scale > 0; }
  /// Draws with `share`, in [0, 1], of the distance from the nominal aircraft; 0 is that itself.
  PlantConfig Narrowed(double share) const;
};

/// Its settings (base/field_list.h).
void ListFields(PlantConfig& config, FieldList& list);

/// Throws Error naming the key of a range of whole numbers whose ends are exchanged.
void Validate(const PlantConfig& config);

}  // namespace skein
