// SPDX-License-Identifier: Apache-2.0
#include "envs/env_config.h"

#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

#include "base/error.h"
#include "base/name_in.h"

namespace skein {
namespace {

std::string Text(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(10) << value;
  return text.str();
}

void Require(bool holds, const std::string& key, double value, const std::string& rule) {
  if (!holds) {
    throw Error("configuration: " + key + " = " + Text(value) + ", but it must be " + rule);
  }
}

/// Of the keys `quantity`_min_`unit` and `quantity`_max_`unit`.
void RequireRange(const std::string& quantity, const std::string& unit, const Range& range,
                  double least, double most) {
  const std::string min = quantity + "_min_" + unit, max = quantity + "_max_" + unit;
  Require(std::isfinite(range.min) && range.min >= least, min, range.min,
          "at least " + Text(least));
  Require(std::isfinite(range.max) && range.max <= most, max, range.max, "at most " + Text(most));
  Require(range.min <= range.max, min, range.min, "no more than " + max + ", " + Text(range.max));
}

void RequirePositive(const std::string& key, double value) {
  Require(std::isfinite(value) && value > 0, key, value, "a positive number");
}

void RequireNotNegative(const std::string& key, double value) {
  Require(std::isfinite(value) && value >= 0, key, value, "zero or more");
}

void RequireShare(const std::string& key, double value) {
  Require(value > 0 && value <= 1, key, value, "above 0 and at most 1");
}

void RequireFinite(const std::string& key, double value) {
  Require(std::isfinite(value), key, value, "a finite number");
}

// The longest control interval for which the discrete flight control's filters keep their shape:
// the fastest has a corner at 50 rad/s, and Tustin's rule needs it below 2/dt.
constexpr double kLongestControlInterval = 0.04;

// Beyond the jet stream's.
constexpr double kFastestWindFps = 500;

}  // namespace

const char* Name(TrackingAxes axes) { return NameIn(kTrackingAxesNames, axes); }

EnvConfig EvaluationConfig(const EnvConfig& config) {
  EnvConfig evaluated = config;
  evaluated.stagger_clocks = false;
  evaluated.heading.training_tolerance_min = 1;
  evaluated.control.training_tolerance_min = 1;
  evaluated.tracking.training_tolerance_max = 1;
  return evaluated;
}

void Validate(const EnvConfig& config) {
  RequirePositive("env.control_interval_s", config.control_interval_s);
  Require(config.control_interval_s <= kLongestControlInterval, "env.control_interval_s",
          config.control_interval_s, "at most " + Text(kLongestControlInterval));
  Require(config.substeps >= 1, "env.substeps", config.substeps, "at least 1");
  Require(config.action_repeat >= 1, "env.action_repeat", config.action_repeat, "at least 1");
  Require(config.time_limit_steps >= 1, "env.time_limit_steps", config.time_limit_steps,
          "at least 1");
  RequireNotNegative("env.observation_noise", config.observation_noise);
  Require(config.observation_noise_max == 0 ||
              (std::isfinite(config.observation_noise_max) &&
               config.observation_noise_max >= config.observation_noise),
          "env.observation_noise_max", config.observation_noise_max,
          "0 or no less than env.observation_noise, " + Text(config.observation_noise));
  RequireNotNegative("env.reward_scale", config.reward_scale);
  RequireShare("env.cg_chord_fraction", config.cg);
  RequireNotNegative("env.engine_angular_momentum_slug_ft2_per_s", config.engine_angular_momentum);

  RequireRange("env.initial.altitude", "ft", config.initial.altitude_ft, 0, 60000);
  RequireRange("env.initial.true_airspeed", "fps", config.initial.true_airspeed_fps, 10, 3000);

  RequireRange("env.wind.speed", "fps", config.wind.speed_fps, 0, kFastestWindFps);
  RequireRange("env.wind.from", "deg", config.wind.from_deg, -360, 360);
  RequireRange("env.wind.turbulence", "fps", config.wind.turbulence_fps, 0, kFastestWindFps);

  RequireNotNegative("env.heading.altitude_change_ft", config.heading.altitude_change_ft);
  RequireNotNegative("env.heading.yaw_change_rad", config.heading.yaw_change_rad);
  RequireNotNegative("env.heading.speed_change_fps", config.heading.speed_change_fps);
  RequirePositive("env.heading.altitude_tolerance_ft", config.heading.altitude_tolerance_ft);
  RequirePositive("env.heading.yaw_tolerance_deg", config.heading.yaw_tolerance_deg);
  RequirePositive("env.heading.speed_tolerance_fps", config.heading.speed_tolerance_fps);
  Require(config.heading.earliest_success_step >= 0, "env.heading.earliest_success_step",
          config.heading.earliest_success_step, "zero or more");
  Require(
      config.task != "heading" || config.heading.earliest_success_step <= config.time_limit_steps,
      "env.heading.earliest_success_step", config.heading.earliest_success_step,
      "no more than env.time_limit_steps, " + Text(config.time_limit_steps) +
          ": else no episode could succeed");

  RequireShare("env.heading.training_tolerance_min", config.heading.training_tolerance_min);
  RequireNotNegative("env.heading.speed_error_weight", config.heading.speed_error_weight);
  RequireNotNegative("env.control.pitch_change_rad", config.control.pitch_change_rad);
  RequireNotNegative("env.control.yaw_change_rad", config.control.yaw_change_rad);
  RequireNotNegative("env.control.speed_change_fps", config.control.speed_change_fps);
  RequirePositive("env.control.pitch_tolerance_deg", config.control.pitch_tolerance_deg);
  RequirePositive("env.control.yaw_tolerance_deg", config.control.yaw_tolerance_deg);
  RequirePositive("env.control.speed_tolerance_fps", config.control.speed_tolerance_fps);
  RequireShare("env.control.training_tolerance_min", config.control.training_tolerance_min);
  RequireNotNegative("env.control.speed_error_weight", config.control.speed_error_weight);

  RequireRange("env.tracking.distance", "ft", config.tracking.distance_ft, 0, 1e6);
  RequireNotNegative("env.tracking.azimuth_deg", config.tracking.azimuth_deg);
  RequireNotNegative("env.tracking.elevation_deg", config.tracking.elevation_deg);
  RequirePositive("env.tracking.position_tolerance_ft", config.tracking.position_tolerance_ft);
  Require(
      config.tracking.training_tolerance_max >= 1 && config.tracking.training_tolerance_max <= 1000,
      "env.tracking.training_tolerance_max", config.tracking.training_tolerance_max,
      "in [1, 1000]");
  RequireNotNegative("env.high_level.pitch_change_rad", config.high_level.pitch_change_rad);
  RequireNotNegative("env.high_level.yaw_change_rad", config.high_level.yaw_change_rad);
  RequireNotNegative("env.high_level.speed_change_fps", config.high_level.speed_change_fps);

  RequireRange("env.termination.alpha", "deg", config.termination.alpha_deg, -180, 180);
  RequireRange("env.termination.beta", "deg", config.termination.beta_deg, -90, 90);
  // The limits are compared by the sides of two directions, which an arc beyond 180 deg does not
  // have.
  Require(config.termination.alpha_deg.max - config.termination.alpha_deg.min <= 180,
          "env.termination.alpha_max_deg", config.termination.alpha_deg.max,
          "at most 180 above env.termination.alpha_min_deg");
  RequireNotNegative("env.termination.min_mach", config.termination.min_mach);
  RequirePositive("env.termination.max_mach", config.termination.max_mach);
  Require(config.termination.min_mach < config.termination.max_mach, "env.termination.min_mach",
          config.termination.min_mach,
          "below env.termination.max_mach, " + Text(config.termination.max_mach));
  RequireFinite("env.termination.min_altitude_ft", config.termination.min_altitude_ft);
  Require(config.initial.altitude_ft.min > config.termination.min_altitude_ft,
          "env.initial.altitude_min_ft", config.initial.altitude_ft.min,
          "above env.termination.min_altitude_ft, " + Text(config.termination.min_altitude_ft));
  RequirePositive("env.termination.max_load_factor_g", config.termination.max_load_factor);
  RequireFinite("env.termination.failure_reward", config.termination.failure_reward);
  RequireFinite("env.termination.success_reward", config.termination.success_reward);
}

}  // namespace skein
