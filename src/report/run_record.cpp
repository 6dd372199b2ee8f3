// SPDX-License-Identifier: Apache-2.0
#include "src/report/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "src/config/configuration.h"
#include "src/config/presets.h"
#include "src/config/settings.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/run/require_run.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kSeedKey = "run.seed";

/// The table in `file`; if there is none or part of it is torn, a note says so.
CsvColumns ReadTable(const std::string& file, std::vector<std::string>* notes) {
  const std::string name = fs::path(file).filename().string();
  if (!fs::exists(file)) {
    notes->push_back(name + ": not there (yet)");
    return {};
  }
  CsvColumns table = ParseCsv(ReadFile(file, kLargestRecord));
  if (table.rows() == 0) notes->push_back(name + ": no row yet");
  if (table.rows_left_out > 0) {
    notes->push_back(
        fmt::format("{}: {} cut short and left out", name, Counted(table.rows_left_out, "row")));
  }
  return table;
}

Json ReadEvaluation(const std::string& file, std::vector<std::string>* notes) {
  if (!fs::exists(file)) {
    notes->push_back("evaluation.json: not there: the run has not finished");
    return nullptr;
  }
  Json document = Json::parse(ReadFile(file), nullptr, /*allow_exceptions=*/false);
  if (document.is_object()) return document;
  notes->push_back("evaluation.json: damaged, and left out");
  return nullptr;
}

/// The preset that the log's first lines name: "2026-01-31T12:00:00Z   preset default".
std::string PresetIn(const std::string& log) {
  if (!fs::exists(log)) return "";
  std::istringstream lines(ReadFile(log, kLargestRecord));
  const std::string mark = "   preset ";
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(mark);
    if (at != std::string::npos && at == line.find(' ')) return line.substr(at + mark.size());
  }
  return "";
}

bool HasPreset(const std::string& task, const std::string& name) {
  const std::vector<Preset>& presets = Presets();
  return std::any_of(presets.begin(), presets.end(), [&](const Preset& preset) {
    return preset.task == task && preset.name == name;
  });
}

/// The preset's configuration; of one that this version does not have the task's default; of a task
/// without presets the run's own.
ProgramConfig PresetOf(const RunRecord& run) {
  const std::string& task = run.config.train.env.task;
  const std::string own = run.preset.substr(0, run.preset.find(' '));
  for (const std::string& name : {own, std::string("default")}) {
    if (HasPreset(task, name)) return ResolveConfig({task, name, "", {}});
  }
  return run.config;
}

}  // namespace

RunRecord ReadRunRecord(const std::string& path) {
  RequireRun(path);
  RunRecord run;
  run.path = path;
  const fs::path absolute = fs::weakly_canonical(path);
  run.name = absolute.filename().string();
  run.config = ReadRecord(path + "/config.toml");
  run.preset = PresetIn(path + "/log.txt");
  run.metrics = ReadTable(path + "/metrics.csv", &run.notes);
  run.timing = ReadTable(path + "/timing.csv", &run.notes);
  run.evaluation = ReadEvaluation(path + "/evaluation.json", &run.notes);
  return run;
}

Json ConfigurationJson(const RunRecord& run) {
  ProgramConfig own = run.config, preset = PresetOf(run);
  const std::vector<Field> fields = FieldsOf(own), theirs = FieldsOf(preset);
  Json rows = Json::array();
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (!fields[k].IsOf(run.config.train.env.task)) continue;
    Json row = {{"key", fields[k].key}, {"value", TomlText(fields[k])}, {"help", fields[k].help}};
    const std::string there = TomlText(theirs[k]);
    if (there != TomlText(fields[k])) row["preset"] = there;
    rows.push_back(row);
  }
  return rows;
}

std::string Repetition(const RunRecord& run) {
  ProgramConfig config = run.config;
  std::string text;
  for (const Field& field : FieldsOf(config)) {
    if (field.key != kSeedKey) text += field.key + "=" + TomlText(field) + "\n";
  }
  return text;
}

}  // namespace skein
