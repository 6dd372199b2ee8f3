// SPDX-License-Identifier: Apache-2.0
#include "train/export/c_flight_control.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/reference/flight_control.h"
#include "train/export/c_text.h"

namespace skein {
namespace data {
extern const std::string_view c_flight_control_template;
}  // namespace data

namespace {

constexpr int kTestSteps = 60;

using Gains = FlightControlGains;
template <typename Value>
using Named = std::pair<const char*, Value Gains::*>;

constexpr std::array<Named<FirstOrder>, 14> kFilters{
    {{"alpha_filter", &Gains::alpha_filter},
     {"pitch_rate_filter", &Gains::pitch_rate_filter},
     {"pitch_rate_washout", &Gains::pitch_rate_washout},
     {"load_factor_filter", &Gains::load_factor_filter},
     {"load_factor_command_filter", &Gains::load_factor_command_filter},
     {"pitch_lead", &Gains::pitch_lead},
     {"roll_rate_filter", &Gains::roll_rate_filter},
     {"roll_command_filter", &Gains::roll_command_filter},
     {"yaw_rate_filter", &Gains::yaw_rate_filter},
     {"yaw_washout", &Gains::yaw_washout},
     {"yaw_lead", &Gains::yaw_lead},
     {"pedal_filter", &Gains::pedal_filter},
     {"lateral_acceleration_filter", &Gains::lateral_acceleration_filter},
     {"flap_filter", &Gains::flap_filter}}};

constexpr std::array<Named<Ramp>, 5> kRamps{
    {{"min_load_factor_command", &Gains::min_load_factor_command},
     {"limiter_rate_fade", &Gains::limiter_rate_fade},
     {"roll_rate_fade", &Gains::roll_rate_fade},
     {"roll_integrator_fade", &Gains::roll_integrator_fade},
     {"pedal_fade", &Gains::pedal_fade}}};

constexpr std::array<Named<double>, 34> kNumbers{
    {{"alpha_min_deg", &Gains::alpha_min_deg},
     {"alpha_max_deg", &Gains::alpha_max_deg},
     {"pitch_gain_pressure_psf", &Gains::pitch_gain_pressure_psf},
     {"roll_gain_pressure_psf", &Gains::roll_gain_pressure_psf},
     {"yaw_gain_pressure_psf", &Gains::yaw_gain_pressure_psf},
     {"max_load_factor_command", &Gains::max_load_factor_command},
     {"max_load_factor_reduction", &Gains::max_load_factor_reduction},
     {"min_load_factor_relative_reduction", &Gains::min_load_factor_relative_reduction},
     {"pitch_proportional_deg_per_g", &Gains::pitch_proportional_deg_per_g},
     {"pitch_integral_per_s", &Gains::pitch_integral_per_s},
     {"pitch_rate_gain_g_s_per_deg", &Gains::pitch_rate_gain_g_s_per_deg},
     {"alpha_to_elevator", &Gains::alpha_to_elevator},
     {"limiter_rate_lead_s", &Gains::limiter_rate_lead_s},
     {"alpha_onset_deg", &Gains::alpha_onset_deg},
     {"alpha_onset_gain_g_per_deg", &Gains::alpha_onset_gain_g_per_deg},
     {"alpha_limit_deg", &Gains::alpha_limit_deg},
     {"alpha_limit_gain_g_per_deg", &Gains::alpha_limit_gain_g_per_deg},
     {"pitch_integrator_limit_deg", &Gains::pitch_integrator_limit_deg},
     {"max_roll_rate_deg_s", &Gains::max_roll_rate_deg_s},
     {"roll_rate_gain_s", &Gains::roll_rate_gain_s},
     {"roll_integral_per_s", &Gains::roll_integral_per_s},
     {"roll_integrator_gate", &Gains::roll_integrator_gate},
     {"roll_integrator_antiwindup_per_s", &Gains::roll_integrator_antiwindup_per_s},
     {"roll_integrator_leak_per_s", &Gains::roll_integrator_leak_per_s},
     {"roll_integrator_limit_deg", &Gains::roll_integrator_limit_deg},
     {"max_pedal_rudder_deg", &Gains::max_pedal_rudder_deg},
     {"yaw_rate_gain_s", &Gains::yaw_rate_gain_s},
     {"lateral_acceleration_gain_deg_per_g", &Gains::lateral_acceleration_gain_deg_per_g},
     {"aileron_rudder_interconnect_per_deg", &Gains::aileron_rudder_interconnect_per_deg},
     {"interconnect_min", &Gains::interconnect_min},
     {"interconnect_max", &Gains::interconnect_max},
     {"flap_alpha_gain", &Gains::flap_alpha_gain},
     {"flap_pressure_gain_deg", &Gains::flap_pressure_gain_deg},
     {"flap_bias_deg", &Gains::flap_bias_deg}}};

std::string Number(double value) { return CNumber(static_cast<float>(value)); }

/// One line for each gain, filters as they are at the control interval.
std::string Constants(const Aircraft& aircraft, double dt, const std::string& name) {
  const Gains& gains = aircraft.flight_control;
  std::string text;
  const auto add = [&](const std::string& type, const std::string& of, const std::string& value) {
    text += "static const " + type + " " + name + "_" + of + " = " + value + ";\n";
  };
  for (const auto& [of, member] : kFilters) {
    const LinearFilter filter = Discretise(gains.*member, dt);
    add(name + "_filter", of,
        "{" + Number(filter.n0) + ", " + Number(filter.n1) + ", " + Number(filter.d1) + "}");
  }
  for (const auto& [of, member] : kRamps) {
    const Ramp& ramp = gains.*member;
    add(name + "_ramp", of,
        "{" + Number(ramp.x_low) + ", " + Number(ramp.y_low) + ", " + Number(ramp.x_high) + ", " +
            Number(ramp.y_high) + "}");
  }
  for (const auto& [of, member] : kNumbers) add("float", of, Number(gains.*member));
  add("float", "deg_per_rad", Number(kDegPerRad));
  const Actuators& actuators = aircraft.actuators;
  const std::array<std::pair<const char*, const Actuator*>, 4> surfaces{
      {{"elevator", &actuators.elevator},
       {"aileron", &actuators.aileron},
       {"rudder", &actuators.rudder},
       {"leading_edge_flap", &actuators.leading_edge_flap}}};
  for (const auto& [surface, actuator] : surfaces) {
    add("float", std::string(surface) + "_min_deg", Number(actuator->min_deg));
    add("float", std::string(surface) + "_max_deg", Number(actuator->max_deg));
  }
  return text;
}

}  // namespace

std::string FlightControlName(const EnvConfig& env) {
  std::string name = IdentifyAircraft(env.aircraft).name + "_flight_control";
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

std::string CFlightControl(const EnvConfig& env, const FlightControlTrace& recorded,
                           const std::string& version) {
  if (env.flight_control != FlightControlMode::kFull) {
    throw Error(
        "there are no flight control laws to write: with env.flight_control = direct full stick is "
        "full deflection");
  }
  const std::string name = FlightControlName(env);
  const int steps = std::min(kTestSteps, recorded.steps());
  const auto first = [steps](const std::vector<float>& rows, int size) {
    return std::vector<float>(rows.begin(),
                              rows.begin() + static_cast<std::ptrdiff_t>(steps) * size);
  };
  return FillIn(data::c_flight_control_template,
                {{"name", name},
                 {"NAME", UpperCase(name)},
                 {"aircraft", env.aircraft},
                 {"version", version},
                 {"state_size", std::to_string(kNumFlightControlStates)},
                 {"step_s", Number(env.control_interval_s)},
                 {"constants", Constants(LoadAircraft(env.aircraft), env.control_interval_s, name)},
                 {"recording", CArray(name + "_test_inputs",
                                      first(recorded.inputs, FlightControlTrace::kInputs)) +
                                   CArray(name + "_test_commands",
                                          first(recorded.commands, FlightControlTrace::kCommands))},
                 {"test_steps", std::to_string(steps)}});
}

}  // namespace skein
