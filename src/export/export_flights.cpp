// SPDX-License-Identifier: Apache-2.0
#include "src/export/export_flights.h"

#include <fmt/format.h>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "src/config/aircraft_choice.h"
#include "src/config/configuration.h"
#include "src/config/presets.h"
#include "src/run/run_directory.h"

namespace skein {
namespace {

constexpr const char* kUsualPreset = "default";

/// The preset with the aircraft, and what its file says of the environment.
EnvConfig PresetWith(const std::string& preset, const EnvConfig& made_in) {
  return ResolveConfig({made_in.task, preset, "", {AircraftAssignment(made_in.aircraft)}})
      .train.env;
}

constexpr const char* kFromRun =
    "export it from the directory of its run, which says where it flew";

/// What the task file says, with the aircraft.
EnvConfig TaskFileOf(const EnvConfig& made_in) {
  ConfigSources sources{made_in.task, kUsualPreset, "", {AircraftAssignment(made_in.aircraft)}};
  sources.task_text = made_in.term_task->text;
  sources.text_aircraft = made_in.aircraft;
  try {
    return ResolveConfig(sources).train.env;
  } catch (const Error& error) {  // the run's --config may have said where this aircraft flies
    throw Error(fmt::format("{}; or {}", error.what(), kFromRun));
  }
}

/// The usual preset if it has the aircraft, else the first that does.
EnvConfig PresetOf(const EnvConfig& made_in) {
  if (made_in.term_task != nullptr) return TaskFileOf(made_in);
  EnvConfig usual = ResolveConfig({made_in.task, kUsualPreset, "", {}}).train.env;
  if (usual.aircraft == made_in.aircraft) return usual;
  for (const Preset& preset : Presets()) {
    if (preset.task != made_in.task) continue;
    EnvConfig env = ResolveConfig({made_in.task, preset.name, "", {}}).train.env;
    if (env.aircraft == made_in.aircraft) return env;
    if (PresetsOf(env.aircraft) == PresetsOf(made_in.aircraft)) {
      return PresetWith(preset.name, made_in);
    }
  }
  if (IsKeptFile(made_in.aircraft)) return PresetWith(kUsualPreset, made_in);
  throw Error(fmt::format("no preset of task {} flies the aircraft {} of the policy: {}",
                          made_in.task, made_in.aircraft, kFromRun));
}

}  // namespace

EnvConfig ExportEnvironment(const std::string& path, const EnvConfig& made_in) {
  EnvConfig env =
      IsRunDirectory(path) ? ReadRecord(path + "/config.toml").train.env : PresetOf(made_in);
  env.control_interval_s = made_in.control_interval_s;
  env.flight_control = made_in.flight_control;
  env.high_level = made_in.high_level;
  return EvaluationConfig(env);
}

PolicyTrace RecordExportFlights(const std::string& path, const RecurrentPolicy& policy,
                                const EnvConfig& made_in) {
  constexpr std::uint64_t kSeed = 1;
  return RecordTrace(policy, ExportEnvironment(path, made_in), kExportFlights, kExportSteps, kSeed);
}

}  // namespace skein
