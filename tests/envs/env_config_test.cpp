// SPDX-License-Identifier: Apache-2.0
#include "envs/env_config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace skein {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What Validate says; empty if it is content.
std::string Complaint(const EnvConfig& config) {
  try {
    Validate(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(EnvConfigTest, DefaultsCanBeFlown) { EXPECT_EQ(Complaint({}), ""); }

struct Fault {
  std::string key;
  std::function<void(EnvConfig*)> make;
};

const Fault kFaults[] = {
    {"env.control_interval_s = ", [](EnvConfig* c) { c->control_interval_s = 0; }},
    {"env.control_interval_s = ", [](EnvConfig* c) { c->control_interval_s = 0.05; }},
    {"env.substeps = ", [](EnvConfig* c) { c->substeps = 0; }},
    {"env.action_repeat = ", [](EnvConfig* c) { c->action_repeat = 0; }},
    {"env.time_limit_steps = ", [](EnvConfig* c) { c->time_limit_steps = 0; }},
    {"env.observation_noise = ", [](EnvConfig* c) { c->observation_noise = -0.01; }},
    {"env.observation_noise_max = ", [](EnvConfig* c) { c->observation_noise_max = 0.005; }},
    {"env.training_noise_max = ", [](EnvConfig* c) { c->training_noise_max = -0.01; }},
    {"env.initial.training_altitude_min_ft = ",
     [](EnvConfig* c) { c->initial.training_altitude_min_ft = 2000; }},
    {"env.initial.training_true_airspeed_min_fps = ",
     [](EnvConfig* c) { c->initial.training_true_airspeed_min_fps = -1; }},
    {"env.termination.training_min_altitude_ft = ",
     [](EnvConfig* c) { c->termination.training_min_altitude_ft = 19500; }},
    {"env.wind.training_speed_max_fps = ",
     [](EnvConfig* c) { c->wind.training_speed_max_fps = -1; }},
    {"env.wind.speed_min_fps = ",
     [](EnvConfig* c) {
       c->wind.speed_fps = {60, 30};
     }},
    {"env.wind.speed_max_fps = ",
     [](EnvConfig* c) {
       c->wind.speed_fps = {0, 600};
     }},
    {"env.wind.from_max_deg = ",
     [](EnvConfig* c) {
       c->wind.from_deg = {0, 400};
     }},
    {"env.wind.turbulence_min_fps = ",
     [](EnvConfig* c) {
       c->wind.turbulence_fps = {-1, 5};
     }},
    {"env.hold_s = ", [](EnvConfig* c) { c->hold_s = 1e9; }},
    {"env.hold_s = ", [](EnvConfig* c) { c->hold_s = 0.001; }},
    {"env.heading.dwell_s = ", [](EnvConfig* c) { c->heading.dwell_s = 1e9; }},
    {"env.control.dwell_s = ", [](EnvConfig* c) { c->control.dwell_s = 1e-9; }},
    {"env.mission.length_s = ", [](EnvConfig* c) { c->mission.length_s = 1e12; }},
    {"env.mission.dwell_s = ", [](EnvConfig* c) { c->mission.dwell_s = 1e12; }},
    // Flights would end as they begin.
    {"env.termination.max_load_factor_g = ",
     [](EnvConfig* c) { c->termination.max_load_factor = 1; }},
    {"env.termination.alpha_max_deg = ",
     [](EnvConfig* c) {
       c->termination.alpha_deg = {-20, -10};
     }},
    {"env.termination.alpha_min_deg = ",
     [](EnvConfig* c) {
       c->termination.alpha_deg = {1, 45};
     }},
    {"env.termination.beta_max_deg = ",
     [](EnvConfig* c) {
       c->termination.beta_deg = {-30, -1};
     }},
    {"env.termination.beta_min_deg = ",
     [](EnvConfig* c) {
       c->termination.beta_deg = {1, 30};
     }},
    {"env.reward_scale = ", [](EnvConfig* c) { c->reward_scale = -1; }},
    {"env.cg_chord_fraction = ", [](EnvConfig* c) { c->cg = 0; }},
    {"env.cg_chord_fraction = ", [](EnvConfig* c) { c->cg = 30; }},
    {"env.engine_angular_momentum_slug_ft2_per_s = ",
     [](EnvConfig* c) { c->engine_angular_momentum = -160; }},
    {"env.initial.altitude_min_ft = ",
     [](EnvConfig* c) {
       c->initial.altitude_ft = {20000, 19000};
     }},
    {"env.initial.altitude_max_ft = ",
     [](EnvConfig* c) {
       c->initial.altitude_ft = {19000, 70000};
     }},
    {"env.initial.true_airspeed_min_fps = ",
     [](EnvConfig* c) {
       c->initial.true_airspeed_fps = {0, 1000};
     }},
    {"env.heading.altitude_change_ft = ", [](EnvConfig* c) { c->heading.altitude_change_ft = -1; }},
    {"env.heading.yaw_change_rad = ", [](EnvConfig* c) { c->heading.yaw_change_rad = -1; }},
    {"env.heading.speed_change_fps = ", [](EnvConfig* c) { c->heading.speed_change_fps = -1; }},
    {"env.heading.altitude_tolerance_ft = ",
     [](EnvConfig* c) { c->heading.altitude_tolerance_ft = 0; }},
    {"env.heading.yaw_tolerance_deg = ", [](EnvConfig* c) { c->heading.yaw_tolerance_deg = 0; }},
    {"env.heading.speed_tolerance_fps = ",
     [](EnvConfig* c) { c->heading.speed_tolerance_fps = 0; }},
    {"env.heading.earliest_success_step = ",
     [](EnvConfig* c) { c->heading.earliest_success_step = -1; }},
    // No episode would last long enough to succeed.
    {"env.heading.earliest_success_step = ",
     [](EnvConfig* c) { c->heading.earliest_success_step = c->time_limit_steps + 1; }},
    {"env.heading.training_tolerance_min = ",
     [](EnvConfig* c) { c->heading.training_tolerance_min = 0; }},
    {"env.heading.training_tolerance_min = ",
     [](EnvConfig* c) { c->heading.training_tolerance_min = 1.1; }},
    {"env.control.pitch_change_rad = ", [](EnvConfig* c) { c->control.pitch_change_rad = -1; }},
    {"env.control.yaw_change_rad = ", [](EnvConfig* c) { c->control.yaw_change_rad = -1; }},
    {"env.control.speed_change_fps = ", [](EnvConfig* c) { c->control.speed_change_fps = -1; }},
    {"env.control.pitch_tolerance_deg = ",
     [](EnvConfig* c) { c->control.pitch_tolerance_deg = 0; }},
    {"env.control.yaw_tolerance_deg = ", [](EnvConfig* c) { c->control.yaw_tolerance_deg = 0; }},
    {"env.control.speed_tolerance_fps = ",
     [](EnvConfig* c) { c->control.speed_tolerance_fps = 0; }},
    {"env.heading.error_norm_weight = ", [](EnvConfig* c) { c->heading.error_norm_weight = -1; }},
    {"env.heading.speed_error_weight = ", [](EnvConfig* c) { c->heading.speed_error_weight = -1; }},
    {"env.heading.altitude_error_weight = ",
     [](EnvConfig* c) { c->heading.altitude_error_weight = -1; }},
    {"env.heading.yaw_error_weight = ", [](EnvConfig* c) { c->heading.yaw_error_weight = -1; }},
    {"env.control.training_tolerance_min = ",
     [](EnvConfig* c) { c->control.training_tolerance_min = 0; }},
    {"env.control.training_tolerance_min = ",
     [](EnvConfig* c) { c->control.training_tolerance_min = 1.1; }},
    {"env.control.angle_error_weight = ", [](EnvConfig* c) { c->control.angle_error_weight = -1; }},
    {"env.control.speed_error_weight = ", [](EnvConfig* c) { c->control.speed_error_weight = -1; }},
    {"env.tracking.distance_min_ft = ",
     [](EnvConfig* c) {
       c->tracking.distance_ft = {30000, 10000};
     }},
    {"env.tracking.distance_max_ft = ",
     [](EnvConfig* c) {
       c->tracking.distance_ft = {10000, 1e7};
     }},
    {"env.tracking.azimuth_deg = ", [](EnvConfig* c) { c->tracking.azimuth_deg = -1; }},
    {"env.tracking.distance_weight = ", [](EnvConfig* c) { c->tracking.distance_weight = -1; }},
    {"env.tracking.approach_weight = ", [](EnvConfig* c) { c->tracking.approach_weight = -1; }},
    {"env.tracking.elevation_deg = ", [](EnvConfig* c) { c->tracking.elevation_deg = -1; }},
    {"env.tracking.training_tolerance_max = ",
     [](EnvConfig* c) { c->tracking.training_tolerance_max = 0.9; }},
    {"env.tracking.position_tolerance_ft = ",
     [](EnvConfig* c) { c->tracking.position_tolerance_ft = 0; }},
    {"env.high_level.pitch_change_rad = ",
     [](EnvConfig* c) { c->high_level.pitch_change_rad = -1; }},
    {"env.high_level.yaw_change_rad = ", [](EnvConfig* c) { c->high_level.yaw_change_rad = -1; }},
    {"env.high_level.speed_change_fps = ",
     [](EnvConfig* c) { c->high_level.speed_change_fps = -1; }},
    {"env.termination.alpha_min_deg = ",
     [](EnvConfig* c) {
       c->termination.alpha_deg = {45, -20};
     }},
    // The kernels compare angles by the sides of two directions: an arc of 180 degrees at most.
    {"env.termination.alpha_max_deg = ",
     [](EnvConfig* c) {
       c->termination.alpha_deg = {-95, 95};
     }},
    {"env.termination.beta_min_deg = ",
     [](EnvConfig* c) {
       c->termination.beta_deg = {-100, 30};
     }},
    {"env.termination.min_mach = ", [](EnvConfig* c) { c->termination.min_mach = 3; }},
    {"env.termination.max_mach = ", [](EnvConfig* c) { c->termination.max_mach = -1; }},
    {"env.termination.max_load_factor_g = ",
     [](EnvConfig* c) { c->termination.max_load_factor = 0; }},
    // Every episode would end with its first step.
    {"env.initial.altitude_min_ft = ",
     [](EnvConfig* c) { c->termination.min_altitude_ft = c->initial.altitude_ft.min; }},
};

TEST(EnvConfigTest, RefusesWhatCannotBeFlownAndNamesTheKey) {
  for (const Fault& fault : kFaults) {
    EnvConfig config;
    fault.make(&config);
    EXPECT_NE(Complaint(config).find(fault.key), std::string::npos)
        << "expected a complaint about " << fault.key << ", got \"" << Complaint(config) << '"';
  }
}

using NumberOf = std::function<double*(EnvConfig*)>;

const std::pair<std::string, NumberOf> kNumbers[] = {
    {"env.cg_chord_fraction = ", [](EnvConfig* c) { return &c->cg; }},
    {"env.engine_angular_momentum_slug_ft2_per_s = ",
     [](EnvConfig* c) { return &c->engine_angular_momentum; }},
    {"env.control_interval_s = ", [](EnvConfig* c) { return &c->control_interval_s; }},
    {"env.observation_noise = ", [](EnvConfig* c) { return &c->observation_noise; }},
    {"env.reward_scale = ", [](EnvConfig* c) { return &c->reward_scale; }},
    {"env.initial.altitude_min_ft = ", [](EnvConfig* c) { return &c->initial.altitude_ft.min; }},
    {"env.initial.altitude_max_ft = ", [](EnvConfig* c) { return &c->initial.altitude_ft.max; }},
    {"env.initial.true_airspeed_min_fps = ",
     [](EnvConfig* c) { return &c->initial.true_airspeed_fps.min; }},
    {"env.initial.true_airspeed_max_fps = ",
     [](EnvConfig* c) { return &c->initial.true_airspeed_fps.max; }},
    {"env.heading.altitude_change_ft = ",
     [](EnvConfig* c) { return &c->heading.altitude_change_ft; }},
    {"env.heading.yaw_change_rad = ", [](EnvConfig* c) { return &c->heading.yaw_change_rad; }},
    {"env.heading.speed_change_fps = ", [](EnvConfig* c) { return &c->heading.speed_change_fps; }},
    {"env.heading.altitude_tolerance_ft = ",
     [](EnvConfig* c) { return &c->heading.altitude_tolerance_ft; }},
    {"env.heading.yaw_tolerance_deg = ",
     [](EnvConfig* c) { return &c->heading.yaw_tolerance_deg; }},
    {"env.heading.speed_tolerance_fps = ",
     [](EnvConfig* c) { return &c->heading.speed_tolerance_fps; }},
    {"env.heading.training_tolerance_min = ",
     [](EnvConfig* c) { return &c->heading.training_tolerance_min; }},
    {"env.heading.error_norm_weight = ",
     [](EnvConfig* c) { return &c->heading.error_norm_weight; }},
    {"env.heading.speed_error_weight = ",
     [](EnvConfig* c) { return &c->heading.speed_error_weight; }},
    {"env.heading.altitude_error_weight = ",
     [](EnvConfig* c) { return &c->heading.altitude_error_weight; }},
    {"env.heading.yaw_error_weight = ", [](EnvConfig* c) { return &c->heading.yaw_error_weight; }},
    {"env.control.pitch_change_rad = ", [](EnvConfig* c) { return &c->control.pitch_change_rad; }},
    {"env.control.yaw_change_rad = ", [](EnvConfig* c) { return &c->control.yaw_change_rad; }},
    {"env.control.speed_change_fps = ", [](EnvConfig* c) { return &c->control.speed_change_fps; }},
    {"env.control.pitch_tolerance_deg = ",
     [](EnvConfig* c) { return &c->control.pitch_tolerance_deg; }},
    {"env.control.yaw_tolerance_deg = ",
     [](EnvConfig* c) { return &c->control.yaw_tolerance_deg; }},
    {"env.control.speed_tolerance_fps = ",
     [](EnvConfig* c) { return &c->control.speed_tolerance_fps; }},
    {"env.control.training_tolerance_min = ",
     [](EnvConfig* c) { return &c->control.training_tolerance_min; }},
    {"env.control.angle_error_weight = ",
     [](EnvConfig* c) { return &c->control.angle_error_weight; }},
    {"env.control.speed_error_weight = ",
     [](EnvConfig* c) { return &c->control.speed_error_weight; }},
    {"env.tracking.distance_weight = ", [](EnvConfig* c) { return &c->tracking.distance_weight; }},
    {"env.tracking.approach_weight = ", [](EnvConfig* c) { return &c->tracking.approach_weight; }},
    {"env.termination.alpha_min_deg = ",
     [](EnvConfig* c) { return &c->termination.alpha_deg.min; }},
    {"env.termination.alpha_max_deg = ",
     [](EnvConfig* c) { return &c->termination.alpha_deg.max; }},
    {"env.termination.beta_min_deg = ", [](EnvConfig* c) { return &c->termination.beta_deg.min; }},
    {"env.termination.beta_max_deg = ", [](EnvConfig* c) { return &c->termination.beta_deg.max; }},
    {"env.termination.min_mach = ", [](EnvConfig* c) { return &c->termination.min_mach; }},
    {"env.termination.max_mach = ", [](EnvConfig* c) { return &c->termination.max_mach; }},
    {"env.termination.min_altitude_ft = ",
     [](EnvConfig* c) { return &c->termination.min_altitude_ft; }},
    {"env.termination.max_load_factor_g = ",
     [](EnvConfig* c) { return &c->termination.max_load_factor; }},
    {"env.termination.failure_reward = ",
     [](EnvConfig* c) { return &c->termination.failure_reward; }},
    {"env.termination.late_reward_factor = ",
     [](EnvConfig* c) { return &c->termination.late_reward_factor; }},
    {"env.termination.success_reward = ",
     [](EnvConfig* c) { return &c->termination.success_reward; }},
};

TEST(EnvConfigTest, RefusesNumbersThatAreNotFinite) {
  for (const auto& [name, field] : kNumbers) {
    for (const double value : {kNan, kInfinity, -kInfinity}) {
      EnvConfig config;
      *field(&config) = value;
      EXPECT_NE(Complaint(config).find(name), std::string::npos)
          << name << " = " << value << ": \"" << Complaint(config) << '"';
    }
  }
}

TEST(EnvConfigTest, SaysWhatWouldBeRight) {
  EnvConfig config;
  config.time_limit_steps = 100;
  EXPECT_EQ(Complaint(config),
            "configuration: env.heading.earliest_success_step = 300, but it must be no more than "
            "env.time_limit_steps, 100: else no episode could succeed");
  config = {};
  config.control_interval_s = 0.05;
  EXPECT_EQ(
      Complaint(config),
      "configuration: env.control_interval_s = 0.05 is out of range; it must be in (0, 0.04]");
}

TEST(EnvConfigTest, ShortEpisodesOfOtherTasksNeedNothingOfHeading) {
  EnvConfig config;
  config.task = "control";
  config.time_limit_steps = 100;
  EXPECT_EQ(Complaint(config), "");
}

TEST(EnvConfigTest, AcceptsTheEdgesOfWhatItAllows) {
  EnvConfig config;
  config.observation_noise = 0;
  config.reward_scale = 0;
  config.heading.altitude_change_ft = config.heading.yaw_change_rad =
      config.heading.speed_change_fps = config.heading.error_norm_weight = 0;
  config.heading.earliest_success_step = 0;
  config.control.pitch_change_rad = config.control.yaw_change_rad =
      config.control.speed_change_fps = config.control.angle_error_weight =
          config.control.speed_error_weight = 0;
  config.time_limit_steps = config.substeps = config.action_repeat = 1;
  config.control_interval_s = 0.04;
  config.initial.altitude_ft = {20000, 20000};
  config.initial.true_airspeed_fps = {1000, 1000};
  config.termination.alpha_deg = {-90, 90};
  config.termination.beta_deg = {-90, 90};
  config.termination.min_mach = 0;
  EXPECT_EQ(Complaint(config), "");
  config.heading.earliest_success_step = config.time_limit_steps;
  EXPECT_EQ(Complaint(config), "");
}

TEST(EnvConfigTest, EvaluationsTakeTheDefaultsOfWhatServesLearningAlone) {
  EnvConfig config;
  config.stagger_clocks = true;
  config.training_noise_max = 0.1;
  config.initial.training_altitude_min_ft = 5000;
  config.initial.training_true_airspeed_min_fps = 500;
  config.initial.training_bank_max_deg = 90;
  config.initial.training_load_factor_max = 7;
  config.wind.training_speed_max_fps = config.wind.training_turbulence_max_fps = 10;
  config.termination.training_min_mach = 0.3;
  config.termination.training_min_altitude_ft = 3000;
  config.heading.training_tolerance_min = 0.1;
  config.tracking.training_tolerance_max = 8;
  config.heading.altitude_tolerance_ft = 70;
  const EnvConfig evaluated = EvaluationConfig(config);
  EXPECT_FALSE(evaluated.stagger_clocks);
  EXPECT_EQ(evaluated.training_noise_max, 0);
  EXPECT_EQ(evaluated.initial.training_altitude_min_ft, 0);
  EXPECT_EQ(evaluated.initial.training_true_airspeed_min_fps, 0);
  EXPECT_EQ(evaluated.initial.training_bank_max_deg, 0);
  EXPECT_EQ(evaluated.initial.training_load_factor_max, 1);
  EXPECT_FALSE(evaluated.wind.enabled());
  EXPECT_EQ(evaluated.termination.Flown().min_mach, config.termination.min_mach);
  EXPECT_EQ(evaluated.termination.Flown().min_altitude_ft, config.termination.min_altitude_ft);
  EXPECT_EQ(evaluated.heading.training_tolerance_min, 1);
  EXPECT_EQ(evaluated.tracking.training_tolerance_max, 1);
  EXPECT_EQ(evaluated.heading.altitude_tolerance_ft, 70) << "belongs to the task";
}

TEST(EnvConfigTest, LimitsAndWindsOfTrainingCountWhereTheyAreBeyondTheOthers) {
  EnvConfig config;
  TerminationConfig& limits = config.termination;
  limits.min_altitude_ft = -100;
  EXPECT_EQ(limits.Flown().min_altitude_ft, -100) << "0 is no limit of training";
  limits.training_min_altitude_ft = 3000;
  limits.training_min_mach = 0.3;
  EXPECT_EQ(limits.Flown().min_altitude_ft, 3000);
  EXPECT_EQ(limits.Flown().min_mach, 0.3);
  limits.min_altitude_ft = 4000;
  limits.min_mach = 0.4;
  EXPECT_EQ(limits.Flown().min_altitude_ft, 4000);
  EXPECT_EQ(limits.Flown().min_mach, 0.4);
  config.wind.speed_fps = {20, 50};
  config.wind.training_speed_max_fps = 40;
  EXPECT_EQ(config.wind.drawn_speed_fps().max, 50);
  config.wind.training_speed_max_fps = 60;
  EXPECT_EQ(config.wind.drawn_speed_fps().min, 20);
  EXPECT_EQ(config.wind.drawn_speed_fps().max, 60);
  config.wind.rotational_gusts = true;
  EXPECT_FALSE(config.wind.has_rotational_gusts());
  config.wind.training_turbulence_max_fps = 5;
  EXPECT_TRUE(config.wind.has_rotational_gusts());
}

}  // namespace
}  // namespace skein
