// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/flight_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "envs/actions.h"
#include "envs/aircraft/aircraft.h"
#include "envs/interface_names.h"
#include "envs/reference/plant.h"
#include "envs/task_registry.h"
#include "src/evaluation/state_readings.h"

namespace skein {
namespace {

using State = std::array<float, kNumRecordedColumns>;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// What a high-level policy's action asks of the low-level policy, in its order.
constexpr std::array<const char*, kHighLevelActionSize> kCommands = {"pitch_deg", "yaw_deg",
                                                                     "true_airspeed_fps"};

/// Of a state, in the order of the table's columns.
std::vector<Reading> Readings(const EnvConfig& env, const State& state) {
  RigidBodyState body;
  for (int i = 0; i < kNumRigidBody; ++i) body[i] = state[static_cast<std::size_t>(i)];
  const Eigen::Vector3d wind(state[kWindNorth], state[kWindEast], state[kWindDown]);
  std::vector<Reading> readings =
      StateReadings({body,
                     wind,
                     MeasureAir(env.atmosphere, body, wind),
                     state[kNz],
                     state[kNy],
                     state[kPower],
                     {state[kElevator], state[kAileron], state[kRudder], state[kLeadingEdgeFlap]}});
  if (env.term_task == nullptr || !env.term_task->has_terrain()) return readings;
  const double terrain = env.term_task->TerrainAt(body[kNorth], body[kEast]);
  readings.emplace_back("terrain_ft", terrain);
  readings.emplace_back("height_above_terrain_ft", -body[kDown] - terrain);
  return readings;
}

double ValueOf(const std::vector<Reading>& readings, const std::string& name) {
  const auto found = std::find_if(readings.begin(), readings.end(),
                                  [&](const Reading& reading) { return reading.first == name; });
  if (found == readings.end()) {
    throw Error(fmt::format("the task's target {} is no column of flight files", name));
  }
  return found->second;
}

/// Fills the table of one flight, row by row.
class TableBuilder {
 public:
  TableBuilder(const EnvConfig& env, const RecordedFlight& flight, FlightColumns columns)
      : env_(env),
        flight_(flight),
        is_hierarchical_(!flight.steps.empty() && !flight.steps.front().command.empty()),
        with_observations_(columns == FlightColumns::kStatesAndObservations),
        targets_(MakeTask(env)->target_quantities()),
        observation_names_(ObservationNames(*MakeTask(env))) {}

  FlightTable Build() {
    NameColumns();
    table_.columns.resize(table_.names.size());
    for (auto& column : table_.columns) column.reserve(flight_.steps.size() + 1);
    for (std::size_t row = 0; row <= flight_.steps.size(); ++row) AddRow(row);
    return std::move(table_);
  }

 private:
  void NameColumns() {
    std::vector<std::string>& names = table_.names;
    names.emplace_back("time_s");
    for (const auto& [name, value] : Readings(env_, {})) names.emplace_back(name);
    const auto add = [&names](const std::string& prefix, const auto& all) {
      for (const char* name : all) names.push_back(prefix + name);
    };
    add("action_", kActionNames);
    if (is_hierarchical_) {
      add("action_", kHighLevelActionNames);
      add("command_", kCommands);
    }
    for (const char* prefix : {"target_", "error_"}) {
      for (const TargetQuantity& target : targets_)
        names.push_back(prefix + std::string(target.column));
    }
    names.emplace_back("reward");
    if (!with_observations_) return;
    for (const std::string& name : observation_names_) names.push_back("observation_" + name);
  }

  void Add(double value) { table_.columns[column_++].push_back(value); }

  /// `row` is the number of control steps flown.
  void AddRow(std::size_t row) {
    column_ = 0;
    const RecordedStep* const step = row == 0 ? nullptr : &flight_.steps[row - 1];
    Add(static_cast<double>(row) * env_.control_interval_s);
    const std::vector<Reading> readings = Readings(env_, StateAt(row));
    for (const auto& [name, value] : readings) Add(value);
    for (std::size_t k = 0; k < kActionSize; ++k) Add(step == nullptr ? kNoNumber : step->stick[k]);
    if (is_hierarchical_) AddHighLevelAction(step);
    const std::vector<float>& target = step == nullptr ? flight_.target : step->target;
    for (std::size_t k = 0; k < targets_.size(); ++k) Add(InPeoplesUnit(k, target[k]));
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      const double error = InPeoplesUnit(k, target[k]) - ValueOf(readings, targets_[k].column);
      Add(targets_[k].is_angle ? std::remainder(error, 360.0) : error);
    }
    Add(step == nullptr ? kNoNumber : step->reward);
    if (with_observations_) AddObservation(row);
    table_.terminations.push_back(step == nullptr ? Termination::kNone : step->termination);
  }

  const State& StateAt(std::size_t row) const {
    return row == 0 ? flight_.initial_state : flight_.steps[row - 1].state;
  }

  void AddHighLevelAction(const RecordedStep* step) {
    for (std::size_t k = 0; k < kHighLevelActionSize; ++k) {
      Add(step == nullptr ? kNoNumber : step->action[k]);
    }
    constexpr std::array<double, kHighLevelActionSize> kUnits = {kDegPerRad, kDegPerRad, 1};
    for (std::size_t k = 0; k < kHighLevelActionSize; ++k) {
      Add(step == nullptr ? kNoNumber : step->command[k] * kUnits[k]);
    }
  }

  /// What the policy saw in the policy step of the row's control step.
  void AddObservation(std::size_t row) {
    const std::size_t begin = row == 0 ? 0
                                       : (row - 1) / static_cast<std::size_t>(env_.action_repeat) *
                                             observation_names_.size();
    for (std::size_t i = 0; i < observation_names_.size(); ++i) {
      Add(row == 0 ? kNoNumber : flight_.observations[begin + i]);
    }
  }

  double InPeoplesUnit(std::size_t k, float target) const {
    return target * (targets_[k].is_angle ? kDegPerRad : 1);
  }

  const EnvConfig& env_;
  const RecordedFlight& flight_;
  bool is_hierarchical_, with_observations_;
  std::vector<TargetQuantity> targets_;
  std::vector<std::string> observation_names_;
  FlightTable table_;
  std::size_t column_ = 0;
};

}  // namespace

bool FlightTable::Has(const std::string& name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const std::vector<double>& FlightTable::Column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(fmt::format("flights have no column {}", name));
  return columns[static_cast<std::size_t>(found - names.begin())];
}

FlightTable TableOf(const EnvConfig& env, const RecordedFlight& flight, FlightColumns columns) {
  return TableBuilder(env, flight, columns).Build();
}

AgentFlights FlyAndRecord(const std::string& name, const Agent& agent, const EnvConfig& env,
                          const EvaluationOptions& options, int count, WorkerPool& pool) {
  return {name, env, MakeTask(EvaluationConfig(env))->target_quantities(),
          RecordFlights(agent, env, options, count, pool)};
}

}  // namespace skein
