// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/field_list.h"
#include "envs/aircraft/registry.h"
#include "python/bindings/bindings.h"
#include "python/bindings/settings_text.h"
#include "src/config/aircraft_choice.h"
#include "src/config/conditions.h"
#include "src/config/configuration.h"
#include "src/config/presets.h"
#include "src/config/settings.h"
#include "src/config/task_file.h"
#include "src/config/usage_error.h"

namespace nb = nanobind;

namespace skein {
namespace {

ProgramConfig Resolve(const std::string& task, const std::string& preset, const std::string& file,
                      const std::vector<std::string>& conditions,
                      const std::vector<std::string>& assignments) {
  return AsUsage([&] {
    ProgramConfig config = ResolveConfig({task, preset, file, assignments, conditions, "settings"});
    CheckConsistent(config);
    return config;
  });
}

/// `config` with the TOML file `file` on top, if that is not empty, and what comes on top of that.
ProgramConfig WithSettings(const ProgramConfig& config, const std::string& file,
                           const std::vector<std::string>& conditions,
                           const std::vector<std::string>& assignments) {
  return AsUsage([&] {
    ProgramConfig changed = WithAircraft(config, [&](ProgramConfig* set) {
      if (!file.empty()) ApplyTomlFile(file, set);
      ApplyConditionsAndAssignments(conditions, assignments, set, "settings");
      RequireTask(set->train.env, config.train.env);
    });
    RequireOwnScale(config, changed);
    CheckConsistent(changed);
    return changed;
  });
}

nb::object ValueOf(const Field& field) {
  return std::visit(
      [](const auto& place) -> nb::object {
        if constexpr (std::is_same_v<std::decay_t<decltype(place)>, NamedChoice>) {
          return nb::cast(place.name());
        } else {
          return nb::cast(*place);
        }
      },
      field.place);
}

/// Those that mean something to the task.
std::vector<Field> FieldsOfTask(ProgramConfig* config) {
  std::vector<Field> fields = FieldsOf(*config);
  const auto means_nothing = [config](const Field& field) {
    return !field.IsOf(config->train.env.task);
  };
  fields.erase(std::remove_if(fields.begin(), fields.end(), means_nothing), fields.end());
  return fields;
}

nb::dict SettingsOf(ProgramConfig config) {
  nb::dict settings;
  for (const Field& field : FieldsOfTask(&config)) settings[field.key.c_str()] = ValueOf(field);
  return settings;
}

/// Raises a ConfigurationError that is a KeyError, too.
[[noreturn]] void RaiseUnknownName(const char* message) {
  PyErr_SetString(nb::module_::import_("skein.checks").attr("UnknownName").ptr(), message);
  throw nb::python_error();
}

nb::object SettingOf(ProgramConfig config, const nb::handle& key) {
  std::string name;
  if (!nb::try_cast(key, name)) {
    const std::string type = nb::type_name(key.type()).c_str();
    throw nb::type_error(("a configuration's keys are texts, not " + type).c_str());
  }
  try {
    return ValueOf(FindField(FieldsOfTask(&config), name, "settings"));
  } catch (const Error& error) {
    RaiseUnknownName(error.what());
  }
}

/// A view of settings(), as dict's method `method` gives it.
nb::object ViewOf(const ProgramConfig& config, const char* method) {
  return SettingsOf(config).attr(method)();
}

/// The files by which the directory of a run records a configuration, by their names; and whether
/// it flies a task file without what of that only serves training, which they do not say.
nb::tuple RecordOf(const ProgramConfig& config) {
  const EnvConfig& env = config.train.env;
  const TermTaskConfig* const terms = env.term_task.get();
  nb::dict files;
  files["config.toml"] = DumpToml(config);
  if (terms != nullptr) files[kTaskFileOfRun] = terms->text;
  if (IsKeptFile(env.aircraft)) files[kAircraftOfRun] = AircraftText(env.aircraft);
  const bool is_final =
      terms != nullptr && terms->training_tolerance_min == 1 && terms->training_tolerance_max == 1;
  return nb::make_tuple(files, is_final);
}

/// The configuration of such files, of which `path` is config.toml.
ProgramConfig ReadRecordOf(const std::string& path, bool is_final) {
  ProgramConfig config = ReadRecord(path);
  EnvConfig& env = config.train.env;
  if (is_final && env.term_task != nullptr) env.SetTermTask(env.term_task->ForEvaluation());
  return config;
}

/// Of a task file there are none.
std::vector<std::string> PresetsOfTask(const std::string& task) {
  std::vector<std::string> names;
  for (const Preset& preset : Presets()) {
    if (preset.task == task) names.emplace_back(preset.name);
  }
  // Says which tasks there are.
  if (names.empty() && !IsTaskFile(task)) AsUsage([&] { return FindPreset(task, ""); });
  return names;
}

}  // namespace

void BindConfiguration(nb::module_& module) {
  nb::class_<ProgramConfig>(module, "Config",
                            "A task, its aircraft and conditions, and how it is trained: every "
                            "configuration key with its value.")
      .def_prop_ro(
          "task", [](const ProgramConfig& config) { return config.train.env.task; },
          "What is flown.")
      .def_prop_ro(
          "conditions",
          [](const ProgramConfig& config) { return DescribeConditions(config.train.env); },
          "What it is flown under, for people.")
      .def(
          "__getitem__", &SettingOf, nb::arg("key").none(),
          "The value of a key, such as \"env.heading.dwell_s\". A configuration is a Mapping of "
          "the "
          "keys of its task to their values; any other key is a ConfigurationError and a KeyError.")
      .def(
          "__contains__",
          [](const ProgramConfig& config, const nb::handle& key) {
            return SettingsOf(config).contains(key);
          },
          nb::arg("key").none())
      .def("__iter__", [](const ProgramConfig& config) { return nb::iter(SettingsOf(config)); })
      .def("__len__", [](const ProgramConfig& config) { return nb::len(SettingsOf(config)); })
      .def("keys", [](const ProgramConfig& config) { return ViewOf(config, "keys"); })
      .def("values", [](const ProgramConfig& config) { return ViewOf(config, "values"); })
      .def("items", [](const ProgramConfig& config) { return ViewOf(config, "items"); })
      .def(
          "get",
          [](const ProgramConfig& config, const nb::handle& key, const nb::object& otherwise) {
            return SettingsOf(config).attr("get")(key, otherwise);
          },
          nb::arg("key").none(), nb::arg("default") = nb::none())
      .def(
          "__eq__",
          [](const ProgramConfig& config, const ProgramConfig& other) {
            return SettingsText(config) == SettingsText(other);
          },
          nb::arg("other"), nb::is_operator())
      .def("__hash__",
           [](const ProgramConfig& config) {
             return std::hash<std::string>()(SettingsText(config));
           })
      .def("settings", &SettingsOf, "Every key of the task with its value.")
      .def("to_toml", &DumpToml, "The same as a TOML file, each key with its meaning.")
      .def(
          "evaluation",
          [](const ProgramConfig& config) {
            ProgramConfig evaluated = config;
            evaluated.train.env = EvaluationConfig(config.train.env);
            return evaluated;
          },
          "The same without what only serves training: staggered clocks, training tolerances, "
          "stronger noise, starts in a bank or a pull.")
      .def("with_settings", &WithSettings, nb::arg("file"), nb::arg("conditions"),
           nb::arg("assignments"))
      .def("__repr__", [](const ProgramConfig& config) {
        return "<skein.Config of " + config.train.env.task + ": " +
               DescribeConditions(config.train.env) + ">";
      });
  module.def("resolve", &Resolve, nb::arg("task"), nb::arg("preset"), nb::arg("file"),
             nb::arg("conditions"), nb::arg("assignments"));
  module.def("record_of", &RecordOf, nb::arg("config"));
  module.def("read_record", &ReadRecordOf, nb::arg("path"), nb::arg("is_final") = false);
  module.def("presets_of", &PresetsOfTask, nb::arg("task"));
}

}  // namespace skein
