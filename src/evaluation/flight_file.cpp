// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/flight_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "base/error.h"
#include "envs/actions.h"
#include "envs/aircraft/aircraft.h"
#include "envs/interface_names.h"
#include "envs/reference/plant.h"
#include "envs/state/attitude.h"
#include "envs/task_registry.h"

namespace skein {
namespace {

using State = std::array<float, kNumRecordedColumns>;
using Quantity = std::pair<const char*, double>;

/// What a state is called and worth in the units of people, in the order of the file's columns.
std::vector<Quantity> Readings(AtmosphereModel atmosphere, const State& state) {
  RigidBodyState body;
  for (int i = 0; i < kNumRigidBody; ++i) body[i] = state[static_cast<std::size_t>(i)];
  const EulerAngles attitude = EulerFromQuaternion(body.segment<4>(kQ0));
  const Eigen::Vector3d wind(state[kWindNorth], state[kWindEast], state[kWindDown]);
  const AirData air = MeasureAir(atmosphere, body, wind);
  return {{"north_ft", body[kNorth]},
          {"east_ft", body[kEast]},
          {"altitude_ft", -body[kDown]},
          {"u_fps", body[kU]},
          {"v_fps", body[kV]},
          {"w_fps", body[kW]},
          {"roll_deg", attitude.roll * kDegPerRad},
          {"pitch_deg", attitude.pitch * kDegPerRad},
          {"yaw_deg", attitude.yaw * kDegPerRad},
          {"p_deg_s", body[kP] * kDegPerRad},
          {"q_deg_s", body[kQ] * kDegPerRad},
          {"r_deg_s", body[kR] * kDegPerRad},
          {"alpha_deg", air.alpha_rad * kDegPerRad},
          {"beta_deg", air.beta_rad * kDegPerRad},
          {"true_airspeed_fps", air.true_airspeed_ft_s},
          {"mach", air.mach},
          {"wind_north_fps", wind.x()},
          {"wind_east_fps", wind.y()},
          {"wind_down_fps", wind.z()},
          {"load_factor_g", state[kNz]},
          {"lateral_load_factor_g", state[kNy]},
          {"power", state[kPower]},
          {"elevator_deg", state[kElevator]},
          {"aileron_deg", state[kAileron]},
          {"rudder_deg", state[kRudder]},
          {"leading_edge_flap_deg", state[kLeadingEdgeFlap]}};
}

double ValueOf(const std::vector<Quantity>& readings, const std::string& name) {
  const auto found = std::find_if(readings.begin(), readings.end(),
                                  [&](const Quantity& reading) { return reading.first == name; });
  if (found == readings.end()) {
    throw Error(fmt::format("the task's target {} is no column of flight files", name));
  }
  return found->second;
}

/// Writes the rows of one configuration's flights.
class FlightTable {
 public:
  FlightTable(const EnvConfig& env, bool is_hierarchical, FlightColumns columns)
      : env_(env),
        is_hierarchical_(is_hierarchical),
        with_observations_(columns == FlightColumns::kStatesAndObservations),
        targets_(MakeTask(env)->target_quantities()) {}

  std::string Header() const {
    std::string header = "episode,time_s";
    for (const auto& [name, value] : Readings(env_.atmosphere, {})) {
      header += fmt::format(",{}", name);
    }
    for (const char* name : kActionNames) header += fmt::format(",action_{}", name);
    if (is_hierarchical_) {
      for (const char* name : kHighLevelActionNames) header += fmt::format(",action_{}", name);
    }
    for (const TargetQuantity& target : targets_)
      header += fmt::format(",target_{}", target.column);
    for (const TargetQuantity& target : targets_) header += fmt::format(",error_{}", target.column);
    header += ",reward,termination";
    if (with_observations_) {
      for (const char* name : kObservationNames) header += fmt::format(",observation_{}", name);
    }
    return header + "\n";
  }

  /// `step` is null for the row at time 0.
  void AppendRow(std::size_t episode, std::size_t steps_flown, const RecordedFlight& flight,
                 const RecordedStep* step, std::string* text) const {
    const auto out = std::back_inserter(*text);
    const auto cell = [&](double value) { fmt::format_to(out, ",{:.7g}", value); };
    fmt::format_to(out, "{}", episode);
    cell(static_cast<double>(steps_flown) * env_.control_interval_s);
    const std::vector<Quantity> readings =
        Readings(env_.atmosphere, step == nullptr ? flight.initial_state : step->state);
    for (const auto& [name, value] : readings) cell(value);
    if (step == nullptr) {
      text->append(kActionNames.size() + (is_hierarchical_ ? kHighLevelActionNames.size() : 0),
                   ',');
    } else {
      for (const float command : step->stick) cell(command);
      if (is_hierarchical_) {
        for (const float command : step->action) cell(command);
      }
    }
    for (std::size_t k = 0; k < targets_.size(); ++k) cell(TargetOf(flight, k));
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      const double error = TargetOf(flight, k) - ValueOf(readings, targets_[k].column);
      cell(targets_[k].is_angle ? std::remainder(error, 360.0) : error);
    }
    if (step == nullptr) {
      text->append(2 + (with_observations_ ? kObservationNames.size() : 0), ',');
    } else {
      cell(step->reward);
      const bool ends = step->termination != Termination::kNone;
      fmt::format_to(out, ",{}",
                     ends ? kTerminationNames[static_cast<std::size_t>(step->termination)] : "");
      if (with_observations_) AppendObservation(flight, steps_flown - 1, text);
    }
    text->append("\n");
  }

 private:
  /// What the policy saw in the policy step of the flight's control step `step`.
  void AppendObservation(const RecordedFlight& flight, std::size_t step, std::string* text) const {
    const std::size_t begin =
        step / static_cast<std::size_t>(env_.action_repeat) * kObservationNames.size();
    for (std::size_t i = 0; i < kObservationNames.size(); ++i) {
      fmt::format_to(std::back_inserter(*text), ",{:.7g}", flight.observations[begin + i]);
    }
  }

  double TargetOf(const RecordedFlight& flight, std::size_t k) const {
    return flight.target[k] * (targets_[k].is_angle ? kDegPerRad : 1);
  }

  const EnvConfig& env_;
  bool is_hierarchical_, with_observations_;
  std::vector<TargetQuantity> targets_;
};

/// Whether a high-level policy's actions were recorded.
bool IsHierarchical(const std::vector<RecordedFlight>& flights) {
  return !flights.empty() && !flights.front().steps.empty() &&
         flights.front().steps.front().action.size() == kHighLevelActionSize;
}

}  // namespace

std::string FlightsCsv(const EnvConfig& env, const std::vector<RecordedFlight>& flights,
                       FlightColumns columns) {
  const FlightTable table(env, IsHierarchical(flights), columns);
  std::string text = table.Header();
  for (std::size_t episode = 0; episode < flights.size(); ++episode) {
    const RecordedFlight& flight = flights[episode];
    table.AppendRow(episode, 0, flight, nullptr, &text);
    for (std::size_t step = 0; step < flight.steps.size(); ++step) {
      table.AppendRow(episode, step + 1, flight, &flight.steps[step], &text);
    }
  }
  return text;
}

}  // namespace skein
