#include "envs/env_config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "simd/error.h"

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
  std::string field;
  std::function<void(EnvConfig*)> make;
};

TEST(EnvConfigTest, RefusesWhatCannotBeFlownAndNamesTheField) {
  const std::vector<Fault> faults = {
      {"control_interval_s", [](EnvConfig* c) { c->control_interval_s = 0; }},
      {"control_interval_s", [](EnvConfig* c) { c->control_interval_s = 0.05; }},
      {"substeps", [](EnvConfig* c) { c->substeps = 0; }},
      {"action_repeat", [](EnvConfig* c) { c->action_repeat = 0; }},
      {"time_limit_steps", [](EnvConfig* c) { c->time_limit_steps = 0; }},
      {"observation_noise", [](EnvConfig* c) { c->observation_noise = -0.01; }},
      {"reward_scale", [](EnvConfig* c) { c->reward_scale = -1; }},
      {"cg", [](EnvConfig* c) { c->cg = 0; }},
      {"cg", [](EnvConfig* c) { c->cg = 30; }},
      {"engine_angular_momentum", [](EnvConfig* c) { c->engine_angular_momentum = -160; }},
      {"initial.altitude_ft",
       [](EnvConfig* c) {
         c->initial.altitude_ft = {20000, 19000};
       }},
      {"initial.altitude_ft",
       [](EnvConfig* c) {
         c->initial.altitude_ft = {19000, 70000};
       }},
      {"initial.true_airspeed_fps",
       [](EnvConfig* c) {
         c->initial.true_airspeed_fps = {0, 1000};
       }},
      {"heading.altitude_change_ft", [](EnvConfig* c) { c->heading.altitude_change_ft = -1; }},
      {"heading.yaw_change_rad", [](EnvConfig* c) { c->heading.yaw_change_rad = -1; }},
      {"heading.speed_change_fps", [](EnvConfig* c) { c->heading.speed_change_fps = -1; }},
      {"heading.altitude_tolerance_ft", [](EnvConfig* c) { c->heading.altitude_tolerance_ft = 0; }},
      {"heading.yaw_tolerance_deg", [](EnvConfig* c) { c->heading.yaw_tolerance_deg = 0; }},
      {"heading.speed_tolerance_fps", [](EnvConfig* c) { c->heading.speed_tolerance_fps = 0; }},
      {"heading.earliest_success_step",
       [](EnvConfig* c) { c->heading.earliest_success_step = -1; }},
      {"termination.alpha_deg",
       [](EnvConfig* c) {
         c->termination.alpha_deg = {45, -20};
       }},
      // The kernels judge angles by the sides of two directions: an arc of 180 degrees at most.
      {"termination.alpha_deg",
       [](EnvConfig* c) {
         c->termination.alpha_deg = {-95, 95};
       }},
      {"termination.beta_deg",
       [](EnvConfig* c) {
         c->termination.beta_deg = {-100, 30};
       }},
      {"termination.min_mach", [](EnvConfig* c) { c->termination.min_mach = 3; }},
      {"termination.max_mach", [](EnvConfig* c) { c->termination.max_mach = -1; }},
      {"termination.max_load_factor", [](EnvConfig* c) { c->termination.max_load_factor = 0; }},
      // Every episode would end with its first step.
      {"initial.altitude_ft",
       [](EnvConfig* c) { c->termination.min_altitude_ft = c->initial.altitude_ft.min; }},
  };
  for (const Fault& fault : faults) {
    EnvConfig config;
    fault.make(&config);
    EXPECT_NE(Complaint(config).find(fault.field), std::string::npos)
        << "expected a complaint about " << fault.field << ", got \"" << Complaint(config) << '"';
  }
}

TEST(EnvConfigTest, RefusesNumbersThatAreNotFinite) {
  const std::vector<std::pair<std::string, std::function<double*(EnvConfig*)>>> fields = {
      {"cg", [](EnvConfig* c) { return &c->cg; }},
      {"engine_angular_momentum", [](EnvConfig* c) { return &c->engine_angular_momentum; }},
      {"control_interval_s", [](EnvConfig* c) { return &c->control_interval_s; }},
      {"observation_noise", [](EnvConfig* c) { return &c->observation_noise; }},
      {"reward_scale", [](EnvConfig* c) { return &c->reward_scale; }},
      {"initial.altitude_ft", [](EnvConfig* c) { return &c->initial.altitude_ft.min; }},
      {"initial.altitude_ft", [](EnvConfig* c) { return &c->initial.altitude_ft.max; }},
      {"initial.true_airspeed_fps", [](EnvConfig* c) { return &c->initial.true_airspeed_fps.min; }},
      {"initial.true_airspeed_fps", [](EnvConfig* c) { return &c->initial.true_airspeed_fps.max; }},
      {"heading.altitude_change_ft", [](EnvConfig* c) { return &c->heading.altitude_change_ft; }},
      {"heading.yaw_change_rad", [](EnvConfig* c) { return &c->heading.yaw_change_rad; }},
      {"heading.speed_change_fps", [](EnvConfig* c) { return &c->heading.speed_change_fps; }},
      {"heading.altitude_tolerance_ft",
       [](EnvConfig* c) { return &c->heading.altitude_tolerance_ft; }},
      {"heading.yaw_tolerance_deg", [](EnvConfig* c) { return &c->heading.yaw_tolerance_deg; }},
      {"heading.speed_tolerance_fps", [](EnvConfig* c) { return &c->heading.speed_tolerance_fps; }},
      {"termination.alpha_deg", [](EnvConfig* c) { return &c->termination.alpha_deg.min; }},
      {"termination.alpha_deg", [](EnvConfig* c) { return &c->termination.alpha_deg.max; }},
      {"termination.beta_deg", [](EnvConfig* c) { return &c->termination.beta_deg.min; }},
      {"termination.beta_deg", [](EnvConfig* c) { return &c->termination.beta_deg.max; }},
      {"termination.min_mach", [](EnvConfig* c) { return &c->termination.min_mach; }},
      {"termination.max_mach", [](EnvConfig* c) { return &c->termination.max_mach; }},
      {"termination.min_altitude_ft", [](EnvConfig* c) { return &c->termination.min_altitude_ft; }},
      {"termination.max_load_factor", [](EnvConfig* c) { return &c->termination.max_load_factor; }},
      {"termination.failure_reward", [](EnvConfig* c) { return &c->termination.failure_reward; }},
      {"termination.success_reward", [](EnvConfig* c) { return &c->termination.success_reward; }},
  };
  for (const auto& [name, field] : fields) {
    for (const double value : {kNan, kInfinity, -kInfinity}) {
      EnvConfig config;
      *field(&config) = value;
      EXPECT_NE(Complaint(config).find(name), std::string::npos)
          << name << " = " << value << ": \"" << Complaint(config) << '"';
    }
  }
}

TEST(EnvConfigTest, AcceptsTheEdgesOfWhatItAllows) {
  EnvConfig config;
  config.observation_noise = 0;
  config.reward_scale = 0;
  config.heading.altitude_change_ft = config.heading.yaw_change_rad =
      config.heading.speed_change_fps = 0;
  config.heading.earliest_success_step = 0;
  config.time_limit_steps = config.substeps = config.action_repeat = 1;
  config.control_interval_s = 0.04;
  config.initial.altitude_ft = {20000, 20000};
  config.initial.true_airspeed_fps = {1000, 1000};
  config.termination.alpha_deg = {-90, 90};
  config.termination.beta_deg = {-90, 90};
  config.termination.min_mach = 0;
  EXPECT_EQ(Complaint(config), "");
}

}  // namespace
}  // namespace skein
