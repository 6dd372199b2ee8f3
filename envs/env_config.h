// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "envs/air/atmosphere.h"
#include "envs/air/gravity.h"
#include "envs/high_level_config.h"
#include "envs/initial_config.h"
#include "envs/plant/plant_config.h"
#include "envs/reference/flight_control.h"
#include "envs/tasks/control_config.h"
#include "envs/tasks/handling_costs.h"
#include "envs/tasks/heading_config.h"
#include "envs/tasks/mission_config.h"
#include "envs/tasks/termination_config.h"
#include "envs/tasks/terms/term_task_config.h"
#include "envs/tasks/tracking_config.h"
#include "envs/wind/wind_config.h"

namespace skein {

class FieldList;

/// Control steps for which an action is held, at most.
inline constexpr int kMaxActionRepeat = 1000;

/// A task, its aircraft and its conditions: everything that an episode depends on but the seed.
struct EnvConfig {
  std::string task = "heading";
  /// The task of a task file, whose name `task` is; null: a built-in one.
  std::shared_ptr<const TermTaskConfig> term_task;
  /// Its TermTaskConfig::hash and TermTaskConfig::interface, empty without: what files say it was.
  std::string task_file_hash, task_interface;
  /// As LoadAircraft takes it. Nothing else follows it: cg, drag, thrust, starts, targets and
  /// limits are the F-16's until they are set, as the program does from presets and
  /// AircraftSettings.
  std::string aircraft = "f16";
  AtmosphereModel atmosphere = AtmosphereModel::kStevensLewis;
  Gravity gravity;
  FlightControlMode flight_control = FlightControlMode::kFull;
  double cg = 0.30;  ///< fraction of the mean chord, whatever the aircraft's file says
  double engine_angular_momentum = 0;  ///< slug ft^2/s
  bool thrust_grows = false;  ///< above Mach 1 (Aircraft::engine); false: held at its value there
  bool drag_rises = false;    ///< with the Mach number (Aircraft::drag_rise)
  double control_interval_s = 0.02;  ///< 50 Hz
  int substeps = 1;                  ///< RK4 steps per control interval
  int action_repeat = 1;  ///< control steps for which an action is held; their rewards are summed
  int time_limit_steps = 2500;  ///< control steps
  /// false: the time limit is a terminal failure, as in the paper; not of missions.
  bool truncate_at_time_limit = false;
  /// First episodes begin with their clocks spread over the time limit, missions over their length.
  bool stagger_clocks = false;
  /// Standard deviation of Gaussian noise on every observation; 0 draws none.
  double observation_noise = 0.01;
  /// If larger, every episode draws its standard deviation between the two.
  double observation_noise_max = 0;
  /// The same in training only, where there is noise at all: what filters strong noise flies calmly
  /// in weak noise.
  double training_noise_max = 0;
  /// Episodes draw initial altitudes and airspeeds, winds, turbulence and noise at u^draw_power, u
  /// uniform in [0, 1), of the way through their ranges, and plants from u^(draw_power - 1) of
  /// theirs around the nominal one: 1 is uniform, more favours what is ordinary (training only).
  int draw_power = 1;
  double reward_scale = 1;  ///< multiplies the step rewards (not the terminal ones)
  /// Targets drawn below these are raised to them, so that a regime holds throughout; 0: as drawn.
  double target_mach_min = 0;         ///< of target speeds, at the target's or the start's altitude
  double target_altitude_min_ft = 0;  ///< of target altitudes and points
  /// Time for which a flight goes on after its target was reached, before it ends as
  /// target_reached; not of Tracking, whose target is a point.
  double hold_s = 0;
  MissionConfig mission;
  HandlingCosts reward;
  InitialConfig initial;
  WindConfig wind;
  PlantConfig plant;
  HeadingConfig heading;
  ControlConfig control;
  TrackingConfig tracking;
  HighLevelConfig high_level;
  TerminationConfig termination;

  /// The upper end of what episodes draw their noise from; no more than observation_noise: none do.
  double most_noise() const {
    const bool is_noisy = observation_noise > 0 || observation_noise_max > 0;
    return is_noisy ? std::max(training_noise_max, observation_noise_max) : 0;
  }

  /// The most that flights begin in a pull of, g: no more than seven tenths of what would end them.
  double starting_load_factor_max() const {
    constexpr double kShareOfLimit = 0.7;
    return std::min(initial.training_load_factor_max,
                    std::max(1.0, kShareOfLimit * termination.max_load_factor));
  }

  /// Flies the task of a task file from now on.
  void SetTermTask(const TermTaskConfig& terms);

  /// What ends and scales episodes of every task. The end of a mission is no failure.
  EpisodeSettings episode() const {
    return {time_limit_steps, truncate_at_time_limit || mission.enabled(), reward_scale};
  }
};

/// Its settings (base/field_list.h).
void ListFields(EnvConfig& config, FieldList& list);

/// The environment in which what was trained in `config` is evaluated: what only serves training
/// (Field::is_training_only) is at its default.
EnvConfig EvaluationConfig(const EnvConfig& config);

/// Throws Error naming the configuration key of the first value that cannot be flown, or under
/// which no episode could succeed.
void Validate(const EnvConfig& config);

}  // namespace skein
