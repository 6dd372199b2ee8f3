// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>

#include "envs/air/atmosphere.h"
#include "envs/reference/flight_control.h"

namespace skein {

/// A closed interval from which a value is drawn uniformly.
struct Range {
  double min = 0, max = 0;
};

/// Where episodes begin.
struct InitialConfig {
  Range altitude_ft{19000, 20000};
  Range true_airspeed_fps{1000, 1200};
  /// Trimmed at reset (table of float64 trims, bilinear in altitude and speed). false: the paper's
  /// start, level, alpha 0, surfaces centred, Aircraft::untrimmed_thrust_lbf (F-16: 2000 lbf).
  bool trimmed = true;
};

/// How the air moves. Every episode draws its own from the ranges.
struct WindConfig {
  Range speed_fps{0, 0};   ///< of the steady wind, which is horizontal
  Range from_deg{0, 360};  ///< where it comes from: 0 is north, 90 is east
  /// Standard deviation of Dryden turbulence (envs/wind/dryden.h); 0 has none.
  Range turbulence_fps{0, 0};
  /// The aircraft is trimmed in still air, keeps its velocity over ground and meets the steady wind
  /// as a step at the start of the episode. false: it is trimmed in the moving air.
  bool step_at_reset = true;

  bool enabled() const { return speed_fps.max > 0 || turbulence_fps.max > 0; }
};

/// Targets of the Heading task relative to the initial state, when they count as reached, and what
/// a speed error costs.
struct HeadingConfig {
  double altitude_change_ft = 3000;  ///< initial altitude + U(-x, x)
  double yaw_change_rad = 3;         ///< initial yaw + U(-x, x), wrapped
  double speed_change_fps = 300;     ///< initial true airspeed + U(-x, x)
  double altitude_tolerance_ft = 100;
  double yaw_tolerance_deg = 5;
  double speed_tolerance_fps = 20;
  /// In training an episode's tolerances are these times U(x, 1), which the agent does not see.
  /// 1 is the paper's; with less it learns to come nearer than it must, and sooner.
  double training_tolerance_min = 1;
  int earliest_success_step = 300;  ///< control steps
  /// Reward lost per step and unit of speed error (F-16: 340 m/s), beside the errors' norm; the
  /// paper's is 0. The speed is what most targets wait for, and weighs least in the norm.
  double speed_error_weight = 0;
};

/// Targets of the Control task relative to the initial state, when they count as reached, and what
/// a speed error costs.
struct ControlConfig {
  /// Initial pitch + U(-x, x), folded into [-pi/2, pi/2]: beyond the vertical it comes down again.
  double pitch_change_rad = 0.5;
  double yaw_change_rad = 3;      ///< initial yaw + U(-x, x), wrapped
  double speed_change_fps = 300;  ///< initial true airspeed + U(-x, x)
  double pitch_tolerance_deg = 5;
  double yaw_tolerance_deg = 5;
  double speed_tolerance_fps = 20;
  /// In training an episode's tolerances are these times U(x, 1), which the agent does not see.
  /// 1 is the paper's; with less it learns to come nearer than it must, as a low-level policy under
  /// a high-level policy has to.
  double training_tolerance_min = 1;
  /// true: the reward's angle is that to the target attitude, wings level, as the paper's; false:
  /// that between the nose and where it should point. Roll does not count for the target, but has
  /// to be flown to reach it: the attitude's angle makes a bank cost more than the turn is worth.
  bool reward_includes_roll = false;
  /// Reward lost per step and unit of speed error (F-16: 340 m/s); the paper's is 0. At 5 the speed
  /// tolerance costs as much as the angular ones, and bringing the nose round at a wrong speed does
  /// not pay.
  double speed_error_weight = 5;
};

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
};

/// What a high-level policy's full action asks of the low-level policy that flies
/// (envs/low_level_flight.h): changes of the present pitch, yaw and true airspeed. And what it
/// sees.
struct HighLevelConfig {
  double pitch_change_rad = 0.3;
  double yaw_change_rad = 0.3;
  double speed_change_fps = 30;
  /// A high-level policy sees the mean of all that its low-level policy's sensors showed since it
  /// last decided, and what they show now: a look for each of the low-level policy's policy steps.
  /// false: what they show now.
  bool averages_observations = false;
};

/// Limits of the paper's Table 5 and the rewards for ending at one and at the target.
struct TerminationConfig {
  Range alpha_deg{-20, 45};
  Range beta_deg{-30, 30};
  double max_mach = 3, min_mach = 0.01;
  double min_altitude_ft = 2500;
  double max_load_factor = 10;  ///< g, of nz; there is no limit to negative ones
  double failure_reward = -200;
  double success_reward = 200;
};

/// A task, its aircraft and its conditions: everything that an episode depends on but the seed.
struct EnvConfig {
  std::string task = "heading";
  std::string aircraft = "f16";
  AtmosphereModel atmosphere = AtmosphereModel::kStevensLewis;
  FlightControlMode flight_control = FlightControlMode::kFull;
  double cg = 0.30;                    ///< fraction of the mean chord
  double engine_angular_momentum = 0;  ///< slug ft^2/s
  bool thrust_grows = false;  ///< above Mach 1 (Aircraft::engine); false: held at its value there
  bool drag_rises = false;    ///< with the Mach number (Aircraft::drag_rise)
  double control_interval_s = 0.02;  ///< 50 Hz
  int substeps = 1;                  ///< RK4 steps per control interval
  int action_repeat = 1;  ///< control steps for which an action is held; their rewards are summed
  int time_limit_steps = 2500;  ///< control steps
  bool truncate_at_time_limit =
      false;  ///< false: the time limit is a terminal failure, as in the paper
  bool stagger_clocks =
      false;  ///< first episodes begin with their clocks spread over the time limit
  double observation_noise =
      0.01;  ///< standard deviation of Gaussian noise on every observation; 0 draws none
  /// If larger, every episode draws its standard deviation between the two.
  double observation_noise_max = 0;
  double reward_scale = 1;  ///< multiplies the step rewards (not the terminal ones)
  InitialConfig initial;
  WindConfig wind;
  HeadingConfig heading;
  ControlConfig control;
  TrackingConfig tracking;
  HighLevelConfig high_level;
  TerminationConfig termination;
};

/// The environment in which what was trained in `config` is evaluated: without what only serves
/// training, stagger_clocks and training tolerances.
EnvConfig EvaluationConfig(const EnvConfig& config);

/// Throws Error naming the configuration key of the first value that cannot be flown, or under
/// which no episode could succeed.
void Validate(const EnvConfig& config);

}  // namespace skein
