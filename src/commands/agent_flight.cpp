// SPDX-License-Identifier: Apache-2.0
#include "src/commands/agent_flight.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/field_list.h"
#include "base/number_text.h"
#include "envs/aircraft/aircraft.h"
#include "src/config/conditions.h"
#include "src/config/usage_error.h"
#include "src/evaluation/flight_summary.h"
#include "src/fdm/fdm_plant.h"
#include "src/fdm/trim_limits.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

/// An option and the keys that it sets, to what it was given.
struct OptionKeys {
  const char* option;
  std::vector<const char*> keys;
};

const std::vector<OptionKeys>& KeysOfOptions() {
  static const std::vector<OptionKeys> keys = {
      {"--xcg", {"env.cg_chord_fraction"}},
      {"--heng", {"env.engine_angular_momentum_slug_ft2_per_s"}},
      {"--drag-rise", {"env.drag_rise"}},
      {"--thrust-growth", {"env.thrust_growth_above_mach_1"}},
      {"--atmosphere", {"env.atmosphere"}},
      {"--gravity-ft-s2", {"env.gravity_ft_s2"}},
      {"--gravity-falls-with-altitude", {"env.gravity_falls_with_altitude"}},
      {"--turbulence-fps", {"env.wind.turbulence_min_fps", "env.wind.turbulence_max_fps"}},
      {"--turbulence-by-altitude", {"env.wind.turbulence_by_altitude"}},
      {"--rotational-gusts", {"env.wind.rotational_gusts"}},
      {"--step-s", {"env.control_interval_s"}},
      {"--substeps", {"env.substeps"}},
      {"--flight-control", {"env.flight_control"}}};
  return keys;
}

/// An option and what it sets, KEY=VALUE.
using OwnAssignments = std::vector<std::pair<std::string, std::string>>;

/// Of tasks whose targets are drawn around the start: not at all, in settings env.TASK.X_change_Y.
/// A target that is not given then is what the flight begins with.
OwnAssignments TargetsAtStart(const std::string& task) {
  OwnAssignments assignments;
  ProgramConfig config;
  const std::string table = fmt::format("env.{}.", task);
  for (const Field& field : FieldsOf(config)) {
    const bool is_change = field.key.find("_change_", table.size()) != std::string::npos;
    if (field.key.rfind(table, 0) == 0 && is_change) {
      assignments.emplace_back("--target", field.key + "=0");
    }
  }
  return assignments;
}

OwnAssignments WindAssignments(const Eigen::Vector3d& wind) {
  if (wind.z() != 0) {
    throw UsageError("--wind-fps: an environment's steady wind is horizontal; down must be 0");
  }
  const double from_deg = std::atan2(-wind.y(), -wind.x()) * kDegPerRad;
  const char* const option = "--wind-fps";
  OwnAssignments assignments = {{option, "env.wind.step_at_reset=false"}};
  const std::string speed = ShortestText(std::hypot(wind.x(), wind.y()));
  for (const char* end : {"min", "max"}) {
    assignments.emplace_back(option, fmt::format("env.wind.speed_{}_fps={}", end, speed));
    assignments.emplace_back(option,
                             fmt::format("env.wind.from_{}_deg={}", end, ShortestText(from_deg)));
  }
  return assignments;
}

OwnAssignments AssignmentsOf(const CLI::App& command, const AgentFlight& flight) {
  OwnAssignments assignments = {{"--altitude-ft", "env.initial.trimmed=true"}};
  const FlightGrid& grid = flight.condition.grid;
  const std::string altitude = ShortestText(grid.altitude_ft.front()),
                    speed = ShortestText(grid.speed_fps.front());
  for (const char* end : {"min", "max"}) {
    assignments.emplace_back("--altitude-ft",
                             fmt::format("env.initial.altitude_{}_ft={}", end, altitude));
    assignments.emplace_back("--speed-fps",
                             fmt::format("env.initial.true_airspeed_{}_fps={}", end, speed));
  }
  for (const OptionKeys& entry : KeysOfOptions()) {
    const CLI::Option* option = command.get_option(entry.option);
    if (option->count() == 0) continue;
    for (const char* key : entry.keys) {
      assignments.emplace_back(entry.option, fmt::format("{}={}", key, option->as<std::string>()));
    }
  }
  if (flight.wind_ft_s != nullptr) {
    for (auto& own : WindAssignments(*flight.wind_ft_s)) assignments.push_back(std::move(own));
  }
  return assignments;
}

void RequireLevelStart(const CLI::App& command) {
  for (const char* option : {"--flight-path-deg", "--turn-rate-deg-s", "--pull-up-g"}) {
    if (command.get_option(option)->count() == 0) continue;
    throw UsageError(fmt::format("{}: what agents fly begins in level flight", option));
  }
}

/// Throws UsageError on a condition that says where flights begin: the options do.
void RequireStartOfOptions(const std::vector<std::string>& conditions) {
  for (const std::string& condition : conditions) {
    for (const std::string& key : AsUsage([&] { return ConditionAssignments({condition}); })) {
      if (key.rfind("env.initial.", 0) != 0) continue;
      throw UsageError(fmt::format(
          "--condition {}: --altitude-ft and --speed-fps say where the flight begins", condition));
    }
  }
}

/// Throws ChoiceError that says why, if the environment has no steady flight to begin with.
void RequireSteadyFlight(const EnvConfig& env) {
  if (!env.initial.trimmed) return;
  const Plant plant =
      MakePlant(env.aircraft, env.atmosphere, env.gravity,
                {env.cg, env.engine_angular_momentum, env.drag_rises, env.thrust_grows});
  TrimOrExplain(plant, {env.initial.altitude_ft.min, env.initial.true_airspeed_fps.min});
}

/// " of 20, ended by low_altitude" of a flight that ended before the `seconds` asked for, or empty.
std::string EndOf(const AgentFlights& flown, Termination end, double seconds) {
  if (end == Termination::kNone) return "";
  const std::string label =
      EndLabel(EvaluationConfig(flown.env).mission.enabled(), static_cast<std::size_t>(end));
  return fmt::format(" of {}, {}", ShortestText(seconds),
                     label.empty() ? "flown to the end" : label);
}

/// Where the flight led: how it ended, and of each target what was asked for and reached.
void Report(const AgentFlights& flown, double seconds) {
  const RecordedFlight& flight = flown.flights.front();
  const FlightTable table = TableOf(flown.env, flight);
  fmt::print("{}: {:.6g} s{}\n", flown.agent, table.columns.front().back(),
             EndOf(flown, table.terminations.back(), seconds));
  std::vector<std::vector<std::string>> rows = {{"", "at the start", "target", "at the end"}};
  for (const TargetQuantity& quantity : flown.targets) {
    const std::string name = quantity.column;
    const auto figure = [](double value) { return fmt::format("{:.2f}", value); };
    rows.push_back({name, figure(table.Column(name).front()),
                    figure(table.Column("target_" + name).back()),
                    figure(table.Column(name).back())});
  }
  fmt::print("{}", InColumns(rows));
}

}  // namespace

void AddAgentsOfFly(CLI::App* command, FlownAgents* flown) {
  AddAgents(command, flown);
  AddEnvironmentOptions(command, TextsOfFlownAgents(), &flown->flight);
  command
      ->add_option("--target", flown->targets,
                   "what an agent flies to, such as altitude_ft=16000, yaw_deg=90, "
                   "true_airspeed_fps=600; may be repeated (default: as the flight begins, of "
                   "points and task files as drawn)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

void RequireNoAgentOptions(const CLI::App& command) {
  RequireNotGiven(command, {"--task", "--preset", "--config", "--condition", "--set", "--target"});
}

void FlyAgents(const CLI::App& command, const AgentFlight& flight, FlownAgents flown) {
  RequireLevelStart(command);
  const std::vector<std::string> names = NamesOf(flown);
  std::vector<std::string> paths;
  for (const std::string& name : names) {
    paths.push_back(names.size() == 1 ? flight.out : PathOfAgent(flight.out, name));
  }
  FlightOptions& options = flown.flight;
  RequireStartOfOptions(options.conditions);
  if (command.get_option("--aircraft")->count() > 0) {
    options.aircraft = flight.condition.model.aircraft;
  }
  CheckWritable(paths, FilesRead(flown));
  RequireEnding(flight.out, ".csv", "flights are written as CSV");
  options.own_assignments = AssignmentsOf(command, flight);
  for (auto& own : TargetsAtStart(TaskOf(flown))) options.own_assignments.push_back(std::move(own));
  options.episodes = 1;
  flown.seconds = flight.seconds;
  RequireSteadyFlight(ConfigurationOf(flown).train.env);
  const std::vector<AgentFlights> agents = FlyEpisodes(flown);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    Report(agents[i], flight.seconds);
    WriteFlightsCsv(options, paths[i], "by " + agents[i].agent, agents[i], flight.out_is_default);
  }
}

}  // namespace skein
