// SPDX-License-Identifier: Apache-2.0
#include "src/aircraft/start_findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "src/config/aircraft_choice.h"
#include "src/config/configuration.h"
#include "src/config/task_file.h"
#include "src/config/usage_error.h"
#include "src/fdm/trim_limits.h"

namespace skein {
namespace {

/// The preset of the task that flies the aircraft. A task file has none.
std::string PresetOf(const std::string& task, const std::string& aircraft) {
  const std::string preset = IsTaskFile(task) ? "" : PresetServing(task, aircraft);
  return preset.empty() ? "default" : preset;
}

/// The preset with the aircraft and the settings of its file. Throws Error if these are no
/// configuration that can be flown.
void CheckSettings(const ConfigSources& sources) {
  const ProgramConfig preset = ResolveConfig({sources.task, sources.preset, "", {}});
  const ProgramConfig config = WithAircraft(preset, [&](ProgramConfig* changed) {
    ApplyConditionsAndAssignments({}, sources.assignments, changed, sources.assignments_are);
  });
  CheckFlyable(config.train.env);
}

/// What is wrong with steady level flight there, if anything is.
std::optional<Finding> CheckLevelFlight(const Plant& plant, const std::string& task,
                                        double altitude_ft, double speed_fps) {
  TrimRequest request;
  request.altitude_ft = altitude_ft;
  request.true_airspeed_ft_s = speed_fps;
  Finding::Kind kind = Finding::kError;
  std::vector<std::string> limits = WordsOf(BelowStall(plant, request));
  if (limits.empty()) {
    try {
      limits = WordsOf(ExceededLimits(plant, request, Trim(plant, request)));
      kind = Finding::kWarning;
    } catch (const Error& error) {
      limits = WordsOf(LimitsOnTheWay(plant, request));
      if (limits.empty()) limits = {fmt::format("cannot be: {}", error.what())};
    }
  }
  if (limits.empty()) return std::nullopt;
  return Finding{kind, fmt::format("task {} begins at {} ft and {} ft/s (env.initial), and level "
                                   "flight there {}",
                                   task, altitude_ft, speed_fps, fmt::join(limits, ", and "))};
}

}  // namespace

std::vector<Finding> CheckStart(const std::string& aircraft, const std::string& task) {
  AsUsage([&] { return ResolveConfig({task, "default", "", {}}); });  // refuses an unknown task
  const std::string known = IsAircraftPath(aircraft) ? KeepAircraftFile(aircraft) : aircraft;
  const ConfigSources sources = {task, PresetOf(task, known), "", {AircraftAssignment(known)}, {},
                                 task};
  try {
    CheckSettings(sources);
  } catch (const Error& error) {
    return {{Finding::kError, fmt::format("it cannot fly task {}: {}", task, error.what())}};
  }
  ProgramConfig config;
  try {
    config = ResolveConfig(sources);
  } catch (const Error& error) {
    return {{Finding::kWarning, fmt::format("it cannot fly task {} yet: {}", task, error.what())}};
  }
  const EnvConfig& env = config.train.env;
  const Plant plant(LoadAircraft(env.aircraft), env.atmosphere, 1, env.gravity);
  std::vector<Finding> findings;
  for (const double speed :
       {env.initial.true_airspeed_fps.min, env.initial.true_airspeed_fps.max}) {
    for (const double altitude : {env.initial.altitude_ft.max, env.initial.altitude_ft.min}) {
      const std::optional<Finding> found = CheckLevelFlight(plant, env.task, altitude, speed);
      if (!found) continue;
      findings.push_back(*found);
      break;
    }
  }
  return findings;
}

}  // namespace skein
