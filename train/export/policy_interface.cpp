// SPDX-License-Identifier: Apache-2.0
#include "train/export/policy_interface.h"

#include <array>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/field_list.h"
#include "base/name_in.h"
#include "base/number_text.h"
#include "envs/actions.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/registry.h"
#include "envs/interface_names.h"
#include "envs/low_level_flight.h"
#include "envs/task_registry.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task_errors.h"
#include "train/policy/policy_environment.h"

namespace skein {
namespace {

/// The environment that `policy` was made in, as far as it says.
EnvConfig MadeIn(const RecurrentPolicy::Parameters& policy,
                 const std::shared_ptr<const TermTaskConfig>& terms) {
  EnvConfig env;
  if (terms != nullptr) env.SetTermTask(*terms);
  env.task = policy.task;
  for (const Field& field : FieldsOf(env)) {
    const auto found = policy.environment.find(field.key);
    if (found != policy.environment.end()) field.SetText(found->second);
  }
  if (const AircraftIdentity made = AircraftMadeWith(policy.environment); !made.name.empty()) {
    env.aircraft = FindAircraft(made);
  }
  return env;
}

/// Tracking's errors lie in axes that the policy chooses; those of the other tasks are of the
/// quantities that targets are compared with.
std::vector<PolicyNumber> ErrorsOf(const EnvConfig& env) {
  std::vector<PolicyNumber> errors;
  const auto task = MakeTask(env);
  for (const TargetQuantity& quantity : task->target_quantities()) {
    errors.push_back({std::string("error_") + quantity.column, quantity.error_unit});
  }
  if (!task->is_point()) return errors;
  std::array<const char*, kNumTaskErrors> names = {"error_north_ft", "error_east_ft",
                                                   "error_altitude_ft"};
  if (env.tracking.error_axes == TrackingAxes::kHeading) {
    names = {"error_ahead_ft", "error_right_ft", "error_altitude_ft"};
  } else if (env.tracking.error_axes == TrackingAxes::kPath) {
    names = {"error_along_path_ft", "error_right_of_path_ft", "error_above_path_ft"};
  }
  for (std::size_t i = 0; i < names.size(); ++i) errors[i].name = names[i];
  return errors;
}

/// Of a task file: in the place of the errors what it observes, and the last actions.
std::vector<PolicyNumber> TermsOf(const Task& task, const std::vector<PolicyNumber>& sensed) {
  std::vector<PolicyNumber> numbers;
  for (const ObservedNumber& number : task.leading_numbers()) {
    numbers.push_back({number.name, number.unit});
  }
  const ObservationLayout& layout = task.observation_layout();
  if (layout.flight) numbers.insert(numbers.end(), sensed.begin(), sensed.end());
  for (int k = 0; k < layout.actions; ++k) {
    numbers.push_back({std::string("last_") + kActionNames[static_cast<std::size_t>(k)]});
  }
  return numbers;
}

/// envs/tasks/observation.h
std::vector<PolicyNumber> ObservationsOf(const EnvConfig& env) {
  const Aircraft aircraft = LoadAircraft(env.aircraft);
  const Actuators& actuators = aircraft.actuators;
  const std::vector<PolicyNumber> sensed = {
      {"altitude_ft", aircraft.units.altitude_ft},
      {"sin_roll"},
      {"cos_roll"},
      {"sin_pitch"},
      {"cos_pitch"},
      {"equivalent_airspeed_fps", aircraft.units.speed_ft_s},
      {"sin_alpha"},
      {"cos_alpha"},
      {"sin_beta"},
      {"cos_beta"},
      {"roll_rate_rad_s"},
      {"pitch_rate_rad_s"},
      {"yaw_rate_rad_s"},
      {"engine_power_percent", kMaximumPower},
      {"elevator_deg", actuators.elevator.max_deg},
      {"aileron_deg", actuators.aileron.max_deg},
      {"rudder_deg", actuators.rudder.max_deg},
      {"leading_edge_flap_deg", actuators.leading_edge_flap.max_deg},
      {"true_over_equivalent_airspeed"}};
  if (env.term_task != nullptr) return TermsOf(*MakeTask(env), sensed);
  std::vector<PolicyNumber> numbers = ErrorsOf(env);
  numbers.insert(numbers.end(), sensed.begin(), sensed.end());
  return numbers;
}

std::vector<PolicyNumber> ActionsOf(const EnvConfig& env, bool is_high_level) {
  if (is_high_level) {
    return {{"pitch_change_rad", env.high_level.pitch_change_rad},
            {"yaw_change_rad", env.high_level.yaw_change_rad},
            {"true_airspeed_change_fps", env.high_level.speed_change_fps}};
  }
  return {{"throttle_fraction", 0.5, 0.5},
          {"pitch_stick_fraction"},
          {"roll_stick_fraction"},
          {"yaw_pedal_fraction"}};
}

void RequireSizes(const PolicyInterface& interface, const NetworkShape& shape,
                  const std::string& who) {
  if (static_cast<int>(interface.observations.size()) == shape.observation_size &&
      static_cast<int>(interface.actions.size()) == shape.output_size) {
    return;
  }
  throw Error(who + " has " + std::to_string(shape.observation_size) + " observations and " +
              std::to_string(shape.output_size) + " actions; its task \"" + interface.env.task +
              "\" has " + std::to_string(interface.observations.size()) + " and " +
              std::to_string(interface.actions.size()));
}

/// One member of each number as a JSON array.
template <typename Member>
std::string Listed(const std::vector<PolicyNumber>& numbers, Member PolicyNumber::*member) {
  nlohmann::json list = nlohmann::json::array();
  for (const PolicyNumber& number : numbers) list.push_back(number.*member);
  return list.dump();
}

}  // namespace

PolicyInterface DescribeInterface(const RecurrentPolicy::Parameters& policy,
                                  const std::shared_ptr<const TermTaskConfig>& terms,
                                  const std::string& who) {
  if (policy.task.empty()) {
    throw Error(who +
                " does not say for which task it was made, so that nothing can be said of its "
                "observations: export a policy that was trained or saved by this version");
  }
  PolicyInterface interface;
  try {
    interface.env = MadeIn(policy, terms);
    Validate(interface.env);
    interface.observations = ObservationsOf(interface.env);
  } catch (const Error& error) {
    throw Error(who + " cannot be described: " + error.what());
  }
  interface.action_repeat = policy.action_repeat;
  interface.actions = ActionsOf(interface.env, policy.low_level != nullptr);
  RequireSizes(interface, policy.shape, who);
  return interface;
}

std::map<std::string, std::string> InterfaceMetadata(const PolicyInterface& interface) {
  const EnvConfig& env = interface.env;
  return {{"task", env.task},
          {"aircraft", env.aircraft},
          {"flight_control", NameIn(kFlightControlNames, env.flight_control)},
          {"control_interval_s", ShortestText(env.control_interval_s)},
          {"action_repeat", std::to_string(interface.action_repeat)},
          {"policy_step_s", RoundedText(interface.policy_step_s(), 9)},
          {"policy_rate_hz", RoundedText(1 / interface.policy_step_s(), 9)},
          {"observation_names", Listed(interface.observations, &PolicyNumber::name)},
          {"observation_scales", Listed(interface.observations, &PolicyNumber::scale)},
          {"action_names", Listed(interface.actions, &PolicyNumber::name)},
          {"action_scales", Listed(interface.actions, &PolicyNumber::scale)},
          {"action_offsets", Listed(interface.actions, &PolicyNumber::offset)}};
}

}  // namespace skein
