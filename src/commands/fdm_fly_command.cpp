// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/field_list.h"
#include "base/number_text.h"
#include "envs/aircraft/engine.h"
#include "src/commands/agent_flight.h"
#include "src/commands/fdm_commands.h"
#include "src/commands/flight_condition.h"
#include "src/config/number_in.h"
#include "src/config/one_of.h"
#include "src/config/whole_number.h"
#include "src/fdm/commanded_flight.h"
#include "src/fdm/left_tables.h"
#include "src/files/csv_columns.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

constexpr double kMostSteps = 1e7;
constexpr int kTimeDigits = 12;  // so that the product of steps and their length is round

const std::map<std::string, FlightControlMode> kModes = {{"full", FlightControlMode::kFull},
                                                         {"direct", FlightControlMode::kDirect}};

struct FlyOptions {
  FlightCondition condition;
  CommandedFlight flight;
  FlownAgents flown;
  bool by_altitude = false;
  std::string mode = "full";
  std::string wind, commands;
  std::string out = "flight.csv";
  CLI::Option* out_option = nullptr;

  bool OutIsDefault() const { return out_option->count() == 0; }
};

/// Throws UsageError of a flight without a step, or of more steps than can be.
void RequireSteps(const CommandedFlight& flight) {
  if (flight.seconds / flight.step_s > kMostSteps) {
    throw UsageError(fmt::format("{} s in steps of {} s are more than {:.0f} steps", flight.seconds,
                                 flight.step_s, kMostSteps));
  }
  if (flight.Steps() < 1) {
    throw UsageError(fmt::format("{} s are less than a step of {} s: raise --seconds",
                                 flight.seconds, flight.step_s));
  }
}

void FlySticks(const FlyOptions& options) {
  std::vector<std::string> read = options.condition.model.FilesRead();
  read.push_back(options.commands);
  CheckWritable({options.out}, read);
  RequireEnding(options.out, ".csv", "flights are written as CSV");
  CommandedFlight flight = options.flight;
  flight.mode = kModes.at(options.mode);
  if (options.by_altitude) flight.gusts.law = TurbulenceLaw::kByAltitude;
  const Plant plant = options.condition.MakePlant();
  const SteadyFlight start = FindSteadyFlight(plant, options.condition.grid.At(plant, 0, 0));
  if (!options.commands.empty()) {
    PilotCommands trimmed;
    trimmed.throttle = start.throttle;
    flight.commands = ReadStickCommands(options.commands, trimmed);
  }
  const std::string flown = FlyCommands(plant, start.trim, flight);
  const std::string out_name = OutputName(options.out, options.OutIsDefault());
  WriteFile(options.out, flown);
  for (const ExceededLimit& limit : start.exceeded_limits) {
    fmt::print("the flight at its start {}\n", limit.words);
  }
  const double seconds = static_cast<double>(flight.Steps()) * flight.step_s;
  fmt::print("flew {} for {} s: {}\n", options.condition.Describe(plant),
             RoundedText(seconds, kTimeDigits), out_name);
  for (const std::string& left : LeftTables(plant, ParseCsv(flown))) fmt::print("  {}\n", left);
}

void Fly(const CLI::App& command, FlyOptions options) {
  CommandedFlight& flight = options.flight;
  if (!options.condition.grid.IsOnePoint())
    throw UsageError("one altitude and one speed are flown");
  RequireSteps(flight);
  if (!options.wind.empty()) flight.wind_ft_s = ReadWind(options.wind);
  if (options.flown.policy.empty() && options.flown.agents.empty()) {
    RequireNoAgentOptions(command);
    if (flight.gusts.standard_deviation_ft_s == 0 && command.get_option("--seed")->count() > 0) {
      throw UsageError("--seed: nothing is drawn without --turbulence-fps, --policy or --agents");
    }
    return FlySticks(options);
  }
  options.flown.flight.seed = flight.gusts.seed;
  FlyAgents(command,
            {options.condition, options.wind.empty() ? nullptr : &flight.wind_ft_s, flight.seconds,
             options.out, options.OutIsDefault()},
            std::move(options.flown));
}

}  // namespace

void AddFlyCommand(CLI::App* fdm) {
  auto options = std::make_shared<FlyOptions>();
  CLI::App* command = fdm->add_subcommand(
      "fly",
      "Fly from steady flight with flight control, actuators and engine: by a file of sticks, by a "
      "policy or by an autopilot");
  FlightConditionForm form;
  form.is_one_point = true;
  AddFlightCondition(command, &options->condition, form);
  AddWind(command, &options->wind);
  CLI::Option* turbulence =
      command
          ->add_option("--turbulence-fps", options->flight.gusts.standard_deviation_ft_s,
                       "standard deviation of Dryden gusts, ft/s (MIL-F-8785C at 20,000 ft: light "
                       "3.7, moderate 7.3, severe 21)")
          ->transform(NumberIn(0, 200))
          ->capture_default_str();
  command
      ->add_flag("--turbulence-by-altitude", options->by_altitude,
                 "that is the deviation at 20,000 ft, elsewhere it is MIL-F-8785C's")
      ->needs(turbulence);
  command
      ->add_flag("--rotational-gusts", options->flight.gusts.rotational,
                 "gusts also turn, as MIL-F-8785C has it for the aircraft's span")
      ->needs(turbulence);
  command
      ->add_option("--seed", options->flight.gusts.seed,
                   "of the gusts, and of all that agents meet")
      ->transform(WholeNumber(0, kMostWholeNumber))
      ->capture_default_str();
  CLI::Option* commands =
      command
          ->add_option("--commands", options->commands,
                       "CSV of time_s and any of throttle, pitch, roll, yaw, held until the next "
                       "row (default: hands off)")
          ->type_name("FILE");
  AddAgentsOfFly(command, &options->flown);
  for (const char* agents : {"--policy", "--agents"}) {
    commands->excludes(command->get_option(agents));
  }
  command->add_option("--seconds", options->flight.seconds, "length of the flight, s")
      ->transform(NumberAboveZero())
      ->capture_default_str();
  command->add_option("--step-s", options->flight.step_s, "control interval, s")
      ->transform(NumberAboveZero())
      ->capture_default_str();
  command->add_option("--substeps", options->flight.substeps, "Runge-Kutta steps in it")
      ->transform(WholeNumber(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--flight-control", options->mode,
                   "full: sticks through the laws; direct: full stick is full deflection")
      ->check(OneOf(kModes))
      ->capture_default_str();
  options->out_option = command
                            ->add_option("-o,--out", options->out,
                                         "columns of files of flights, which skein plot flights "
                                         "draws")
                            ->type_name("FILE.csv")
                            ->capture_default_str();
  command->footer(
      "A file of sticks is flown in float64. Agents fly as in skein replay, in the environment of "
      "the policy's run or of the preset,\n"
      "with what is given here set in it.\n"
      "Example: skein fdm fly --altitude-ft 15000 --speed-fps 500 --commands sticks.csv -o "
      "fly.csv\n"
      "         skein fdm fly --altitude-ft 15000 --speed-fps 800 --agents autopilot --task "
      "heading "
      "\\\n"
      "           --target yaw_deg=90 --target altitude_ft=16000 --seconds 60\n"
      "         skein plot flights fly.csv --columns load_factor_g,alpha_deg,elevator_deg");
  command->callback([options, command] { Fly(*command, *options); });
}

}  // namespace skein
