#include "envs/env_config.h"

#include <cmath>

#include "simd/error.h"

namespace skein {
namespace {

void Require(bool holds, const std::string& field, double value, const std::string& rule) {
  if (!holds) {
    throw Error("environment: " + field + " = " + std::to_string(value) + ", but it must be " +
                rule);
  }
}

void RequireRange(const std::string& field, const Range& range, double least, double most) {
  Require(std::isfinite(range.min) && range.min >= least, field + ".min", range.min,
          "at least " + std::to_string(least));
  Require(std::isfinite(range.max) && range.max <= most, field + ".max", range.max,
          "at most " + std::to_string(most));
  Require(range.min <= range.max, field + ".min", range.min,
          "no more than its max, " + std::to_string(range.max));
}

void RequirePositive(const std::string& field, double value) {
  Require(std::isfinite(value) && value > 0, field, value, "a positive number");
}

void RequireNotNegative(const std::string& field, double value) {
  Require(std::isfinite(value) && value >= 0, field, value, "zero or more");
}

void RequireFinite(const std::string& field, double value) {
  Require(std::isfinite(value), field, value, "a finite number");
}

// The longest control interval for which the discrete flight control's filters keep their shape:
// the fastest has a corner at 50 rad/s, and Tustin's rule needs it below 2/dt.
constexpr double kLongestControlInterval = 0.04;

}  // namespace

void Validate(const EnvConfig& config) {
  RequirePositive("control_interval_s", config.control_interval_s);
  Require(config.control_interval_s <= kLongestControlInterval, "control_interval_s",
          config.control_interval_s, "at most " + std::to_string(kLongestControlInterval));
  Require(config.substeps >= 1, "substeps", config.substeps, "at least 1");
  Require(config.action_repeat >= 1, "action_repeat", config.action_repeat, "at least 1");
  Require(config.time_limit_steps >= 1, "time_limit_steps", config.time_limit_steps, "at least 1");
  RequireNotNegative("observation_noise", config.observation_noise);
  RequireNotNegative("reward_scale", config.reward_scale);
  Require(config.cg > 0 && config.cg < 1, "cg", config.cg, "between 0 and 1 (fraction of chord)");
  RequireNotNegative("engine_angular_momentum", config.engine_angular_momentum);

  RequireRange("initial.altitude_ft", config.initial.altitude_ft, 0, 60000);
  RequireRange("initial.true_airspeed_fps", config.initial.true_airspeed_fps, 100, 3000);

  RequireNotNegative("heading.altitude_change_ft", config.heading.altitude_change_ft);
  RequireNotNegative("heading.yaw_change_rad", config.heading.yaw_change_rad);
  RequireNotNegative("heading.speed_change_fps", config.heading.speed_change_fps);
  RequirePositive("heading.altitude_tolerance_ft", config.heading.altitude_tolerance_ft);
  RequirePositive("heading.yaw_tolerance_deg", config.heading.yaw_tolerance_deg);
  RequirePositive("heading.speed_tolerance_fps", config.heading.speed_tolerance_fps);
  Require(config.heading.earliest_success_step >= 0, "heading.earliest_success_step",
          config.heading.earliest_success_step, "zero or more");

  RequireRange("termination.alpha_deg", config.termination.alpha_deg, -180, 180);
  RequireRange("termination.beta_deg", config.termination.beta_deg, -90, 90);
  // The limits are judged by the sides of two directions, which an arc beyond 180 deg does not
  // have.
  Require(config.termination.alpha_deg.max - config.termination.alpha_deg.min <= 180,
          "termination.alpha_deg.max", config.termination.alpha_deg.max,
          "at most 180 above its min");
  RequireNotNegative("termination.min_mach", config.termination.min_mach);
  RequirePositive("termination.max_mach", config.termination.max_mach);
  Require(config.termination.min_mach < config.termination.max_mach, "termination.min_mach",
          config.termination.min_mach, "below termination.max_mach");
  RequireFinite("termination.min_altitude_ft", config.termination.min_altitude_ft);
  Require(
      config.initial.altitude_ft.min > config.termination.min_altitude_ft,
      "initial.altitude_ft.min", config.initial.altitude_ft.min,
      "above termination.min_altitude_ft, " + std::to_string(config.termination.min_altitude_ft));
  RequirePositive("termination.max_load_factor", config.termination.max_load_factor);
  RequireFinite("termination.failure_reward", config.termination.failure_reward);
  RequireFinite("termination.success_reward", config.termination.success_reward);
}

}  // namespace skein
