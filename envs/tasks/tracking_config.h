// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>

#include "base/range.h"

namespace skein {

class FieldList;

/// Axes in which Tracking shows where its target is.
enum class TrackingAxes {
  kHeading,  ///< ahead, right and up of the aircraft's heading
  /// Along the path over ground, right of it and above it, where right is level: as a satellite
  /// receiver shows it. What drifts with the wind or flies nose up still flies along its path.
  kPath,
  kEarth,  ///< north, east and up, as in the paper: where the nose points is then not observed
};
inline constexpr std::array<std::pair<TrackingAxes, const char*>, 3> kTrackingAxesNames{
    {{TrackingAxes::kHeading, "heading"},
     {TrackingAxes::kPath, "path"},
     {TrackingAxes::kEarth, "earth"}}};
const char* Name(TrackingAxes axes);

/// Targets of the Tracking task relative to the initial state, and when they count as reached.
struct TrackingConfig {
  Range distance_ft{10000, 30000};     ///< the paper's public configuration has 2000
  double azimuth_deg = 30;             ///< to either side of the nose: U(-x, x)
  double elevation_deg = 30;           ///< above and below the nose: U(-x, x)
  double position_tolerance_ft = 100;  ///< north, east and up
  /// In training an episode's tolerance is the above times exp(U(0, ln x)), so that a high-level
  /// policy reaches some targets before it reaches all; evaluations take it as it is.
  double training_tolerance_max = 1;
  TrackingAxes error_axes = TrackingAxes::kHeading;
  double distance_weight = 1;  ///< of the distance in the reward of a control step
  /// Of the distance by which a control step has come nearer. Over a flight to one target that is
  /// what it began with, however long the flight; so the next target is no loss.
  double approach_weight = 0;
  /// true: the policy gives stick commands; false: it commands a low-level policy, as in the paper.
  /// Who makes a VecEnv goes by it: a VecEnv has the low-level policy that it is given.
  bool acts_directly = false;
};

/// Its settings (base/field_list.h).
void ListFields(TrackingConfig& config, FieldList& list);

}  // namespace skein
