// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "envs/state/state.h"
#include "envs/tasks/observation_layout.h"
#include "envs/tasks/task_errors.h"
#include "simd/random.h"

namespace skein {

/// What targets are relative to: where a flight begins. A mission's next target, too, but for
/// points, which are relative to where the aircraft is then, and for the pitch, which leads back to
/// the altitude at which the flight began.
struct FlightStart {
  double altitude_ft = 0;
  double true_airspeed_ft_s = 0;
  double pitch_rad = 0, yaw_rad = 0, roll_rad = 0;
  double north_ft = 0, east_ft = 0;
  /// The lowest altitude and pitch that targets may ask for: those drawn below are raised to them.
  double lowest_altitude_ft = -std::numeric_limits<double>::infinity();
  double lowest_pitch_rad = -std::numeric_limits<double>::infinity();
};

/// The task's part of one control step's reward, and whether the target counts as reached; one
/// element per aircraft, padded as Tile says.
struct StepResult {
  float* reward = nullptr;          ///< before reward_scale, without terminal rewards
  std::int32_t* reached = nullptr;  ///< 1 where the target counts as reached, else 0
  /// Control step of the episode at which time ends it; null: the same limit for all.
  const std::int32_t* deadline = nullptr;
  const float* bonus = nullptr;  ///< reward beside, which reward_scale leaves alone; null: none
  /// A Termination, a failure, where the task itself ends the episode, else 0; null: nowhere.
  std::int32_t* ends = nullptr;
  /// What Task::Errors says of the same state, of tasks whose reward is made of that
  /// (Task::rewards_by_errors); null: not asked for.
  float* errors = nullptr;
  std::size_t error_stride = 0;  ///< between its columns
};

/// What a target is compared with: a column of recorded flights (docs/reference/file-formats.md).
/// Of an angle the target is in radians, the column in degrees, and their difference is wrapped to
/// +-180 deg.
struct TargetQuantity {
  const char* column = nullptr;
  bool is_angle = false;
  /// One of the task's normalised error of the same place (Task::Errors), in the column's unit.
  double error_unit = 1;
  double tolerance =
      0;  ///< of evaluations: how far from it the target counts, in the column's unit
};

/// A number that leads the row of observations.
struct ObservedNumber {
  std::string name;  ///< with its unit, if it has one
  double unit = 1;   ///< what is observed times this is the number of that name
};

/// What the aircraft of an environment are asked to do. One object serves all tiles: it holds
/// settings, and each aircraft's targets live in the tile's task columns, which a `Tile` of
/// num_columns() columns shows. Targets come first.
class Task {
 public:
  virtual ~Task() = default;

  virtual int num_columns() const = 0;
  virtual int num_targets() const = 0;
  /// One per target, in their order.
  virtual std::vector<TargetQuantity> target_quantities() const = 0;

  /// Time within tolerances without a break after which the target counts as reached, s.
  virtual double dwell_s() const { return 0; }
  /// Whether targets are points, which are passed, and not states, which can be held.
  virtual bool is_point() const { return false; }
  /// Whether what leads the row of observations depends on the position or the velocity over the
  /// ground.
  virtual bool observes_over_ground() const { return is_point(); }
  /// Whether the task ends episodes itself (StepResult::ends).
  virtual bool has_ends() const { return false; }

  /// Whether ComputeReward has the errors at hand, and says them if they are asked for.
  virtual bool rewards_by_errors() const { return false; }

  /// How the row of observations is made up.
  virtual const ObservationLayout& observation_layout() const { return kStandardObservation; }
  /// What the numbers that lead it are; none if they are the errors.
  virtual std::vector<ObservedNumber> leading_numbers() const { return {}; }

  /// Draws the columns of the tile's aircraft `index` at the start of an episode.
  virtual void Reset(const FlightStart& start, simd::RandomStream* random, Tile task,
                     int index) const = 0;

  /// Brings what the tile's columns hold beside the targets of aircraft `index`, and follows from
  /// them, up to date: they were not drawn, but set.
  virtual void FollowTargets(Tile /*task*/, int /*index*/) const {}

  /// The tolerances that the episode of aircraft `index` asks for, as a share of those of
  /// evaluations.
  virtual float ToleranceShare(Tile task, int index) const = 0;

  /// The normalised errors of the first three targets, as columns `error_stride` apart; 0 where
  /// there are fewer.
  virtual void Errors(Tile flight, Tile task, float* errors, std::size_t error_stride) const = 0;

  /// The numbers that lead the row of observations, observation_layout().lead columns `stride`
  /// apart.
  virtual void LeadingObservations(Tile flight, Tile task, float* numbers,
                                   std::size_t stride) const {
    Errors(flight, task, numbers, stride);
  }

  /// Rewards the state after a control step, and says where it reaches the target. `steps_before`
  /// is each aircraft's control steps in this episode before it.
  virtual void ComputeReward(Tile flight, Tile task, const std::int32_t* steps_before,
                             const StepResult& step_result) const = 0;
};

}  // namespace skein
