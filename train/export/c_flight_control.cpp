// SPDX-License-Identifier: Apache-2.0
#include "train/export/c_flight_control.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "envs/aircraft/flight_control_file.h"
#include "envs/aircraft/registry.h"
#include "envs/reference/flight_control.h"
#include "train/export/c_text.h"

namespace skein {
namespace data {
extern const std::string_view c_flight_control_template;
}  // namespace data

namespace {

constexpr int kTestSteps = 60;

std::string Number(double value) { return CNumber(static_cast<float>(value)); }

std::string Constant(const std::string& type, const std::string& name, const std::string& value) {
  return "static const " + type + " " + name + " = " + value + ";\n";
}

/// One line for each gain, called by `name`: filters as they are at the control interval, then
/// ramps, then numbers.
class GainLines {
 public:
  GainLines(std::string name, double dt) : name_(std::move(name)), dt_(dt) {}

  void Add(const std::string& of, const FirstOrder& law) {
    const LinearFilter filter = Discretise(law, dt_);
    filters_ += Constant(
        name_ + "_filter", name_ + "_" + of,
        "{" + Number(filter.n0) + ", " + Number(filter.n1) + ", " + Number(filter.d1) + "}");
  }
  void Add(const std::string& of, const Ramp& ramp) {
    ramps_ += Constant(name_ + "_ramp", name_ + "_" + of,
                       "{" + Number(ramp.x_low) + ", " + Number(ramp.y_low) + ", " +
                           Number(ramp.x_high) + ", " + Number(ramp.y_high) + "}");
  }
  void Add(const std::string& of, double value) {
    numbers_ += Constant("float", name_ + "_" + of, Number(value));
  }

  std::string text() const { return filters_ + ramps_ + numbers_; }

 private:
  std::string name_, filters_, ramps_, numbers_;
  double dt_;
};

/// One line for each gain and limit.
std::string Constants(const Aircraft& aircraft, double dt, const std::string& name) {
  GainLines gains(name, dt);
  const auto add = [&gains](const char* of, const auto* value) { gains.Add(of, *value); };
  VisitFlightControlGains(aircraft.flight_control, add);
  VisitFlapGains(aircraft.flight_control, add);
  gains.Add("deg_per_rad", kDegPerRad);
  const Actuators& actuators = aircraft.actuators;
  const std::array<std::pair<const char*, const Actuator*>, 4> surfaces{
      {{"elevator", &actuators.elevator},
       {"aileron", &actuators.aileron},
       {"rudder", &actuators.rudder},
       {"leading_edge_flap", &actuators.leading_edge_flap}}};
  for (const auto& [surface, actuator] : surfaces) {
    gains.Add(std::string(surface) + "_min_deg", actuator->min_deg);
    gains.Add(std::string(surface) + "_max_deg", actuator->max_deg);
  }
  return gains.text();
}

}  // namespace

std::string FlightControlName(const EnvConfig& env) {
  std::string name = IdentifyAircraft(env.aircraft).name + "_flight_control";
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  // No identifier of C begins with a digit.
  return std::isdigit(static_cast<unsigned char>(name.front())) != 0 ? "aircraft_" + name : name;
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
