// SPDX-License-Identifier: Apache-2.0
#include "envs/mission_rules.h"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

/// Altitude that a mission has lost or won is given back by the pitch of what comes next, rad per
/// ft, and at most: targets drawn anywhere would lead into the ground in the end.
constexpr double kPitchPerFootLost = 5e-5;
constexpr double kLargestPitchBack = 0.25;
/// No target of a mission leads lower than this share of the height at which the flight began, even
/// if it is dived for until its time is up, at this many times the airspeed of the flight's start.
/// Heights are above the altitude at which flights end.
constexpr double kMissionClearance = 0.1;
constexpr double kMissionDiveSpeed = 1.3;

int ControlSteps(const EnvConfig& config, double seconds) {
  return static_cast<int>(std::lround(seconds / config.control_interval_s));
}

}  // namespace

void LimitDescent(const EnvConfig& config, double altitude_ft, FlightStart* start) {
  const double floor_ft = config.termination.Flown().min_altitude_ft;
  start->lowest_altitude_ft = floor_ft + kMissionClearance * (start->altitude_ft - floor_ft);
  const double flown_ft = kMissionDiveSpeed * start->true_airspeed_ft_s * config.time_limit_steps *
                          config.control_interval_s;
  const double descent = (altitude_ft - start->lowest_altitude_ft) / flown_ft;
  start->lowest_pitch_rad = -std::asin(std::clamp(descent, -1.0, 1.0));
}

void LeadBack(double altitude_ft, FlightStart* start) {
  start->pitch_rad = std::clamp(kPitchPerFootLost * (start->altitude_ft - altitude_ft),
                                -kLargestPitchBack, kLargestPitchBack);
}

void JoinMission(const EnvConfig& config, bool is_point, simd::RandomStream* random,
                 FlightStart* start) {
  const double altitude_ft = start->altitude_ft;
  const auto drawn = [random](const Range& range) { return random->Uniform(range.min, range.max); };
  start->altitude_ft = drawn(config.initial.altitude_ft);
  start->true_airspeed_ft_s = drawn(config.initial.true_airspeed_fps);
  LimitDescent(config, altitude_ft, start);
  LeadBack(altitude_ft, start);
  if (is_point) start->altitude_ft = altitude_ft;
}

int TimeLimitSteps(const EnvConfig& config, double share) {
  const MissionConfig& mission = config.mission;
  if (!mission.is_of_training() || mission.training_time_limit_s == 0) {
    return config.time_limit_steps;
  }
  const int first = ControlSteps(config, mission.training_time_limit_s);
  return first + static_cast<int>(std::lround(share * (config.time_limit_steps - first)));
}

ProgressRules RulesOf(const EnvConfig& config, const Task& task) {
  const auto steps = [&config](double seconds) { return ControlSteps(config, seconds); };
  const bool is_mission_of_states = config.mission.enabled() && !task.is_point();
  ProgressRules rules;
  rules.dwell_steps = steps(is_mission_of_states ? config.mission.dwell_s : task.dwell_s());
  rules.hold_steps = steps(config.hold_s);
  rules.mission_steps = steps(config.mission.flown_length_s());
  rules.time_limit_steps = TimeLimitSteps(config, 0);
  rules.reached_reward = static_cast<float>(config.termination.success_reward);
  rules.missed_reward =
      config.truncate_at_time_limit ? 0 : static_cast<float>(config.termination.late_reward());
  return rules;
}

}  // namespace skein
