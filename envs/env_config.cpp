// SPDX-License-Identifier: Apache-2.0
#include "envs/env_config.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/field_list.h"
#include "base/number_text.h"
#include "envs/task_registry.h"

namespace skein {
namespace {

void Require(bool holds, const char* key, double value, const std::string& rule) {
  if (!holds) {
    throw Error("configuration: " + std::string(key) + " = " + ShortestText(value) +
                ", but it must be " + rule);
  }
}

/// Times are counted in control steps: one that rounds to none would be neither off nor on.
void RequireSteps(const EnvConfig& config, const char* key, double seconds) {
  const double steps = std::round(seconds / config.control_interval_s);
  Require(seconds == 0 || (steps >= 1 && steps <= std::numeric_limits<int>::max()), key, seconds,
          "0, or 1 to 2147483647 times env.control_interval_s, " +
              ShortestText(config.control_interval_s));
}

// The longest control interval for which the discrete flight control's filters keep their shape:
// the fastest has a corner at 50 rad/s, and Tustin's rule needs it below 2/dt.
constexpr double kLongestControlInterval = 0.04;

constexpr double kStrongestGravity = 1000;  // ft/s^2, beyond any planet's

std::vector<std::string> HierarchicalTasks() {
  std::vector<std::string> names;
  for (const std::string& name : TaskNames()) {
    if (CanBeHierarchical(name)) names.push_back(name);
  }
  return names;
}

void ListEpisodeFields(EnvConfig& config, FieldList& list) {
  list.Add("control_interval_s", &config.control_interval_s, {0, kLongestControlInterval, true},
           "time between control steps")
      .FixedForPolicies();
  list.Add("substeps", &config.substeps, {1, 1000}, "RK4 steps per control step");
  list.Add("action_repeat", &config.action_repeat, {1, kMaxActionRepeat},
           "control steps for which the policy's action is held; 5 is 10 Hz");
  list.Add("time_limit_steps", &config.time_limit_steps, Bounds::Count(),
           "control steps after which a target that is not reached, nor being held, is missed");
  list.Add("truncate_at_time_limit", &config.truncate_at_time_limit,
           "true: the value is bootstrapped at the limit; false: the limit is a failure");
  list.Add("stagger_clocks", &config.stagger_clocks,
           "first episodes begin with their clocks spread over the time limit, missions over their "
           "length (training only)")
      .TrainingOnly();
  list.Add("observation_noise", &config.observation_noise, Bounds::NotNegative(),
           "standard deviation of the noise on every observation");
  list.Add("observation_noise_max", &config.observation_noise_max, Bounds::NotNegative(),
           "if larger, every episode draws its standard deviation between the two (--condition "
           "noisy sets both)")
      .OffUnless(config.observation_noise_max > 0);
  list.Add("training_noise_max", &config.training_noise_max, Bounds::NotNegative(),
           "the same in training only, where there is noise at all: evaluations have what is asked "
           "for "
           "above")
      .TrainingOnly()
      .OffUnless(config.training_noise_max > 0);
  list.Add("draw_power", &config.draw_power, {1, 8},
           "initial altitudes and airspeeds, winds, turbulence and noise are drawn at u^x of the "
           "way "
           "through their ranges, plants from u^(x-1) of theirs, u uniform: 1 is uniform, more "
           "favours the ordinary (training only)")
      .TrainingOnly()
      .OffUnless(config.draw_power > 1);
  list.Add("reward_scale", &config.reward_scale, Bounds::NotNegative(),
           "multiplies the step rewards, not the terminal ones");
  list.Add("target_mach_min", &config.target_mach_min, {0, 3},
           "target speeds drawn below this Mach number are raised to it; 0: as drawn")
      .OffUnless(config.target_mach_min > 0);
  list.Add("target_altitude_min_ft", &config.target_altitude_min_ft, {0, 60000},
           "target altitudes drawn below this are raised to it; 0: as drawn")
      .OffUnless(config.target_altitude_min_ft > 0);
  list.Add("hold_s", &config.hold_s, Bounds::NotNegative(),
           "time for which a flight goes on after its target was reached; not of tracking")
      .OffUnless(config.hold_s > 0);
}

void ListAircraftFields(EnvConfig& config, FieldList& list) {
  list.Add("aircraft", &config.aircraft, "what flies: a name, or the path of an aircraft file")
      .FixedForPolicies();
  list.Add("atmosphere", &config.atmosphere, kAtmosphereNames,
           "air: the published F-16 models' or the U.S. Standard Atmosphere 1976");
  list.Add("gravity_ft_s2", &config.gravity.at_sea_level_ft_s2, {0, kStrongestGravity, true},
           "gravity at sea level; load factors stay multiples of 32.17 ft/s^2")
      .OffUnless(config.gravity.at_sea_level_ft_s2 != kGravityFtS2);
  list.Add("gravity_falls_with_altitude", &config.gravity.falls_with_altitude,
           "true: with the square of the distance from the earth's centre; false: it is the same "
           "at every altitude")
      .OffUnless(config.gravity.falls_with_altitude);
  list.Add("flight_control", &config.flight_control, kFlightControlNames,
           "the four-channel flight control system, or commands straight to the actuators")
      .FixedForPolicies();
  list.Add("cg_chord_fraction", &config.cg, Bounds::PositiveFraction(),
           "centre of gravity, fraction of the mean chord");
  list.Add("engine_angular_momentum_slug_ft2_per_s", &config.engine_angular_momentum,
           Bounds::NotNegative(), "gyroscopic effect of the engine; 0 leaves it out");
  list.Add("thrust_growth_above_mach_1", &config.thrust_grows,
           "true: thrust grows above Mach 1; false: it is held at its value there")
      .OffUnless(config.thrust_grows);
  list.Add("drag_rise", &config.drag_rises, "drag rises with the Mach number")
      .OffUnless(config.drag_rises);
}

void ValidateTerms(const EnvConfig& config) {
  const TermTaskConfig& terms = *config.term_task;
  if (config.task != terms.name || config.task_file_hash != terms.hash ||
      config.task_interface != terms.interface) {
    throw Error("configuration: env.task = " + config.task + " of the task file with the hash " +
                config.task_file_hash + ", but the file is of task " + terms.name +
                " and has the hash " + terms.hash);
  }
  RequireSteps(config, "reached.dwell_s of the task file", terms.dwell_s);
  Require(terms.earliest_step <= config.time_limit_steps, "reached.earliest_step of the task file",
          terms.earliest_step,
          "no more than env.time_limit_steps, " + ShortestText(config.time_limit_steps) +
              ": else no episode could succeed");
  if (config.plant.observation_delay_steps.max == 0) return;
  for (const TermNumber& number : terms.observed) {
    if (IsRemembered(terms.ValueReadBy(number))) continue;
    throw Error("configuration: the task file observes " + number.name +
                ", which is not known of control steps before: "
                "env.plant.observation_delay_max_steps must be 0");
  }
}

}  // namespace

void ListFields(EnvConfig& config, FieldList& list) {
  list.Add("task", &config.task, "what is flown");
  list.Add("task_file_hash", &config.task_file_hash,
           "hash of the task file that is flown; empty for a built-in task")
      .OffUnless(!config.task_file_hash.empty());
  list.Add("task_interface", &config.task_interface,
           "hash of what the task file lets policies observe: a policy flies tasks of its own")
      .OffUnless(!config.task_interface.empty())
      .FixedForPolicies();
  ListAircraftFields(config, list);
  ListEpisodeFields(config, list);
  list.Group("initial", config.initial);
  list.Group("wind", config.wind, {{}, !config.wind.enabled()});
  list.Group("plant", config.plant, {{}, !config.plant.enabled()});
  list.Group("heading", config.heading, {{"heading"}});
  list.Group("control", config.control, {{"control"}});
  list.Group("tracking", config.tracking, {{"tracking"}});
  list.Group("high_level", config.high_level, {HierarchicalTasks(), false, "planner"});
  list.Group("termination", config.termination);
  list.Group("mission", config.mission);
  list.Group("reward", config.reward);
}

void EnvConfig::SetTermTask(const TermTaskConfig& terms) {
  term_task = std::make_shared<const TermTaskConfig>(terms);
  task = terms.name;
  task_file_hash = terms.hash;
  task_interface = terms.interface;
}

EnvConfig EvaluationConfig(const EnvConfig& config) {
  EnvConfig evaluated = config, defaults;
  const std::vector<Field> fields = FieldsOf(evaluated), standards = FieldsOf(defaults);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].is_training_only) fields[i].SetText(standards[i].ValueText(ShortestText));
  }
  if (config.term_task != nullptr) evaluated.SetTermTask(config.term_task->ForEvaluation());
  return evaluated;
}

void Validate(const EnvConfig& config) {
  EnvConfig listed = config;
  FieldList list;
  list.Group("env", listed);
  list.Check();
  Require(
      config.observation_noise_max == 0 || config.observation_noise_max >= config.observation_noise,
      "env.observation_noise_max", config.observation_noise_max,
      "0 or no less than env.observation_noise, " + ShortestText(config.observation_noise));
  Require(
      config.task != "heading" || config.heading.earliest_success_step <= config.time_limit_steps,
      "env.heading.earliest_success_step", config.heading.earliest_success_step,
      "no more than env.time_limit_steps, " + ShortestText(config.time_limit_steps) +
          ": else no episode could succeed");
  RequireSteps(config, "env.heading.dwell_s", config.heading.dwell_s);
  RequireSteps(config, "env.control.dwell_s", config.control.dwell_s);
  RequireSteps(config, "env.hold_s", config.hold_s);
  RequireSteps(config, "env.mission.length_s", config.mission.length_s);
  RequireSteps(config, "env.mission.dwell_s", config.mission.dwell_s);
  RequireSteps(config, "env.mission.training_length_s", config.mission.training_length_s);
  RequireSteps(config, "env.mission.training_time_limit_s", config.mission.training_time_limit_s);
  Require(config.mission.training_time_limit_s == 0 || config.mission.is_of_training(),
          "env.mission.training_time_limit_s", config.mission.training_time_limit_s,
          "0 without env.mission.training_length_s, whose flights it is for");
  if (config.term_task != nullptr) ValidateTerms(config);
  Require(config.hold_s == 0 || !MakeTask(config)->is_point(), "env.hold_s", config.hold_s,
          "0 for " + config.task + ": a point is passed, not held");
  Require(config.hold_s == 0 || !config.mission.enabled(), "env.hold_s", config.hold_s,
          "0 in a mission (env.mission.length_s, training_length_s), whose targets come one after "
          "another");
  Validate(config.plant);
  const TerminationConfig& termination = config.termination;
  // The limits are compared by the sides of two directions, which an arc beyond 180 deg does not
  // have.
  Require(termination.alpha_deg.max - termination.alpha_deg.min <= 180,
          "env.termination.alpha_max_deg", termination.alpha_deg.max,
          "at most 180 above env.termination.alpha_min_deg");
  Require(termination.min_mach < termination.max_mach, "env.termination.min_mach",
          termination.min_mach,
          "below env.termination.max_mach, " + ShortestText(termination.max_mach));
  Require(termination.max_load_factor > 1, "env.termination.max_load_factor_g",
          termination.max_load_factor, "above 1, with which level flight begins");
  Require(termination.alpha_deg.min < 0, "env.termination.alpha_min_deg", termination.alpha_deg.min,
          "below 0, about which fast flights begin");
  Require(termination.alpha_deg.max > 0, "env.termination.alpha_max_deg", termination.alpha_deg.max,
          "above 0, about which fast flights begin");
  Require(termination.beta_deg.min < 0, "env.termination.beta_min_deg", termination.beta_deg.min,
          "below 0, at which flights begin");
  Require(termination.beta_deg.max > 0, "env.termination.beta_max_deg", termination.beta_deg.max,
          "above 0, at which flights begin");
  const InitialConfig& initial = config.initial;
  const std::string above =
      "above env.termination.min_altitude_ft, " + ShortestText(termination.min_altitude_ft);
  Require(initial.altitude_ft.min > termination.min_altitude_ft, "env.initial.altitude_min_ft",
          initial.altitude_ft.min, above);
  Require(initial.drawn_altitude_ft().min > termination.min_altitude_ft,
          "env.initial.training_altitude_min_ft", initial.training_altitude_min_ft,
          "0, or " + above);
  Require(initial.drawn_altitude_ft().min > termination.Flown().min_altitude_ft,
          "env.termination.training_min_altitude_ft", termination.training_min_altitude_ft,
          "0, or below the lowest initial altitude in training, " +
              ShortestText(initial.drawn_altitude_ft().min));
}

}  // namespace skein
