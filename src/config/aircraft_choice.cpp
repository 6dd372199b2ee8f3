// SPDX-License-Identifier: Apache-2.0
#include "src/config/aircraft_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "src/config/configuration.h"
#include "src/config/presets.h"
#include "src/config/settings.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

bool IsSameAircraft(const EnvConfig& a, const EnvConfig& b) {
  return a.aircraft == b.aircraft ||
         IdentifyAircraft(a.aircraft).hash == IdentifyAircraft(b.aircraft).hash;
}

bool HavePresetsInCommon(const EnvConfig& a, const EnvConfig& b) {
  return PresetsOf(a.aircraft) == PresetsOf(b.aircraft);
}

const std::vector<std::string> kKeysNotOfAircraft = {"env.task", "env.task_file_hash",
                                                     "env.task_interface", "env.aircraft"};

/// Applies the settings in the aircraft's file, but for those of other tasks.
void ApplySettingsOf(const std::string& aircraft, ProgramConfig* config) {
  const std::string source = fmt::format("aircraft {}", IdentifyAircraft(aircraft).name);
  std::vector<std::string> settings;
  const std::vector<Field> fields = FieldsOf(*config);
  for (const std::string& setting : AircraftSettings(aircraft)) {
    const std::string key = KeyOf(setting);
    if (std::count(kKeysNotOfAircraft.begin(), kKeysNotOfAircraft.end(), key) > 0) {
      throw Error(fmt::format("{}: {} is not for an aircraft to say", source, key));
    }
    if (FindField(fields, key, source).IsOf(config->train.env.task)) settings.push_back(setting);
  }
  ApplyConditionsAndAssignments({}, settings, config, source);
}

/// Whether the aircraft's file says a key that begins so.
bool Says(const std::string& aircraft, const std::string& beginning) {
  const std::vector<std::string> settings = AircraftSettings(aircraft);
  return std::any_of(settings.begin(), settings.end(), [&](const std::string& setting) {
    return setting.compare(0, beginning.size(), beginning) == 0;
  });
}

bool DifferIn(const std::string& beginning, const ProgramConfig& a, const ProgramConfig& b) {
  const std::vector<std::string> differences = Differences(a, b);
  return std::any_of(differences.begin(), differences.end(), [&](const std::string& difference) {
    return difference.compare(0, beginning.size(), beginning) == 0;
  });
}

/// "use --preset NAME, or " with the preset of the task that serves the aircraft; empty if there is
/// none.
std::string PresetHint(const std::string& task, const std::string& aircraft) {
  const std::string preset = PresetServing(task, aircraft);
  return preset.empty() ? "" : fmt::format("use --preset {}, or ", preset);
}

}  // namespace

void KeepAircraft(const std::string& folder, EnvConfig* env) {
  const auto below = [&folder](const std::string& path) {
    return folder.empty() ? path : (fs::path(folder) / path).string();
  };
  if (IsAircraftPath(env->aircraft)) {
    env->aircraft = KeepAircraftFile(below(env->aircraft));
    return;
  }
  const auto mark = env->aircraft.find('#');
  const std::string file = below(kAircraftOfRun);
  std::error_code failure;
  if (folder.empty() || mark == std::string::npos || !fs::exists(file, failure)) return;
  const std::string kept = KeepAircraftFile(file, env->aircraft.substr(0, mark));
  if (kept == env->aircraft) return;
  throw Error(fmt::format("{}: is the aircraft {}, but the configuration beside it is of {}", file,
                          kept, env->aircraft));
}

ProgramConfig WithAircraft(const ProgramConfig& base,
                           const std::function<void(ProgramConfig*)>& apply) {
  ProgramConfig config = base;
  apply(&config);
  if (IsSameAircraft(base.train.env, config.train.env)) return config;
  ProgramConfig chosen = base;
  EnvConfig& env = chosen.train.env;
  env.aircraft = config.train.env.aircraft;
  const Aircraft aircraft = LoadAircraft(env.aircraft);
  env.cg = aircraft.airframe.cg;
  env.drag_rises = env.drag_rises && !aircraft.drag_rise.mach.empty();
  env.thrust_grows = env.thrust_grows && !aircraft.engine.growth.mach.empty();
  if (!HavePresetsInCommon(base.train.env, env)) ApplySettingsOf(env.aircraft, &chosen);
  apply(&chosen);
  return chosen;
}

void RequireOwnScale(const ProgramConfig& base, const ProgramConfig& config) {
  const EnvConfig &before = base.train.env, &env = config.train.env;
  if (IsSameAircraft(before, env) || HavePresetsInCommon(before, env)) return;
  const Range &speeds = env.initial.true_airspeed_fps, &old = before.initial.true_airspeed_fps;
  if (speeds.min != old.min || speeds.max != old.max) {
    if (!Says(env.aircraft, "env.")) return;  // the user says it all
  } else if (!Says(env.aircraft, "env.initial.true_airspeed_")) {
    throw Error(fmt::format(
        "env.aircraft = {}, but all else is made for {}, from {} ft/s on: {}set "
        "env.initial.true_airspeed_min_fps and _max_fps, and what else is of this aircraft, by "
        "--config or in the section \"env\" of its file",
        env.aircraft, before.aircraft, old.min, PresetHint(env.task, env.aircraft)));
  }
  const std::string table = fmt::format("env.{}.", env.task);
  // A task file says itself what it asks.
  const bool is_said = env.term_task != nullptr || Says(env.aircraft, table);
  if (is_said || DifferIn(table, base, config)) return;
  throw Error(fmt::format(
      "env.aircraft = {}, but what the task asks is made for {}: {}set {}* by --config or in the "
      "section \"env\" of the aircraft's file",
      env.aircraft, before.aircraft, PresetHint(env.task, env.aircraft), table));
}

std::string PresetServing(const std::string& task, const std::string& aircraft) {
  for (const Preset& preset : Presets()) {
    if (preset.task != task) continue;
    const std::string flown = ResolveConfig({task, preset.name, "", {}}).train.env.aircraft;
    if (PresetsOf(flown) == PresetsOf(aircraft)) return preset.name;
  }
  return "";
}

std::string AircraftAssignment(const std::string& aircraft) {
  return "env.aircraft=" +
         nlohmann::json(aircraft).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace skein
