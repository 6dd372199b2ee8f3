// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzz_target.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/error.h"
#include "envs/aircraft/aircraft_document.h"
#include "envs/kernels/plant_kernel.h"
#include "src/config/aircraft_choice.h"
#include "src/config/configuration.h"
#include "src/fdm/fdm_evaluation.h"
#include "src/files/csv_columns.h"
#include "src/files/output_file.h"
#include "src/run/metrics.h"
#include "src/run/record_file.h"
#include "src/study/study.h"
#include "tests/fuzz/container_readers.h"
#include "tests/fuzz/fuzzed_file.h"
#include "tests/fuzz/simd_agreement.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

/// The files of a folder of the repository, and of the folders in it, whose names end so.
std::vector<std::string> Shipped(const std::string& folder, const std::string& extension) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(SKEIN_SOURCE "/" + folder)) {
    if (entry.path().extension() == extension) files.push_back(ReadFile(entry.path().string()));
  }
  return files;
}

std::string AsItIs(std::string file) { return file; }

std::vector<std::string> ConfigurationSeeds() { return Shipped("configs/heading", ".toml"); }

/// As ResolveConfig does, but for the preset, which is read once: it takes as long as a file.
void ReadConfiguration(const std::string& file) {
  static const ProgramConfig preset = ResolveConfig({"heading", "default", "", {}});
  const std::string path = InFile(file, ".toml");
  const ProgramConfig config = WithAircraft(preset, [&path](ProgramConfig* changed) {
    ApplyTomlFile(path, changed);
    RequireTask(changed->train.env, preset.train.env);
  });
  RequireOwnScale(preset, config);
  CheckConsistent(config);
}

std::vector<std::string> StudySeeds() { return Shipped("configs/studies", ".toml"); }

void CheckStudy(const std::string& file) {
  const Study study = ReadStudy(InFile(file, ".toml"));
  LevelConfig(study, study.tasks.front(), study.levels.front());
}

std::vector<std::string> TaskSeeds() { return Shipped("examples/tasks", ".toml"); }

void ReadTask(const std::string& file) {
  CheckConsistent(ResolveConfig({InFile(file, ".toml"), "default", "", {}}));
}

using nlohmann::json;

/// Nested lists over the axes `names`, from the `level`-th on, at the axes' multiples of 25 deg.
json Thinned(const json& values, const json& axes, const json& names, std::size_t level = 0) {
  if (level == names.size()) return values;
  const auto axis = axes.at(names[level]).get<std::vector<double>>();
  json kept;
  for (std::size_t i = 0; i < axis.size(); ++i) {
    if (std::fmod(axis[i], 25) == 0) kept.push_back(Thinned(values[i], axes, names, level + 1));
  }
  return kept;
}

/// The repository's own, of tables every few lines: all of them would be most of the time.
std::vector<std::string> AircraftSeeds() {
  std::vector<std::string> seeds;
  for (const std::string& file : Shipped("data", ".json")) {
    json aircraft = json::parse(file);
    if (aircraft.value("model", "") == "tables") {
      json& aerodynamics = aircraft["aerodynamics"];
      const json axes = aerodynamics["axes"];
      for (json& table : aerodynamics["tables"]) {
        table["values"] = Thinned(table["values"], axes, table["axes"]);
      }
      for (auto& [name, axis] : aerodynamics["axes"].items()) axis = Thinned(axis, axes, {name});
    }
    seeds.push_back(aircraft.dump());
  }
  return seeds;
}

void ReadAircraft(const std::string& file) {
  MakeKernelAircraft(MakeAircraft(ReadAircraftDocument("fuzzed", file, "fuzzed")),
                     AtmosphereModel::kStandard1976);
}

std::vector<std::string> FdmSeeds() {
  return {R"({"points": [{"state": [500, 0, 20, 0, 0, 0, 0, 0, -15000, 1, 0, 0, 0],
 "controls": [2000, -2, 0, 0, 0], "params": {"xcg": 0.3, "heng": 160}}],
 "edge_points": [], "trajectories": [{"initial_state": [500, 0, 20, 0, 0, 0, 0, 0, -15000, 1, 0,
 0, 0], "trim_controls": [2000, -2, 0, 0, 0], "params": {}, "pulses":
 [{"control_index": 1, "t_start": 0, "t_end": 0.1, "delta": 1}], "t": [0, 0.1]}]})"};
}

void ReadFdm(const std::string& file) {
  EvaluatePoints(ReadFdmFile(InFile(file, ".json")).points, {});
}

std::vector<std::string> MetricsSeeds() {
  std::string rows = MetricsHeader();
  IterationReport report;
  for (report.iteration = 4; report.iteration <= 6; ++report.iteration) rows += MetricsRow(report);
  return {rows, "iteration,env_steps\n1,5120\n2,10240\n"};
}

/// As a resumed run does: what is there is judged, trimmed and gone on with; as a report does.
void ReadMetrics(const std::string& file) {
  constexpr std::uint64_t kIteration = 5;
  const std::string path = InFile(file, ".csv");
  BeginsAs(path, "1000 0123456789abcdef");
  TrimRows(path, kIteration, MetricsHeader());
  RecordFile(path, MetricsHeader()).Append(MetricsRow({}));
  ParseCsv(ReadFile(path));
}

constexpr std::size_t kContainerBytes = 50000, kTextBytes = 8000, kAircraftBytes = 30000,
                      kRecordBytes = 4000;

}  // namespace

const std::vector<FuzzTarget>& FuzzTargets() {
  static const std::vector<FuzzTarget> targets = {
      {"policy", PolicySeeds, RepairedContainer, ReadPolicy, kContainerBytes},
      {"checkpoint", CheckpointSeeds, RepairedContainer, ReadCheckpoint, kContainerBytes},
      {"configuration", ConfigurationSeeds, AsItIs, ReadConfiguration, kTextBytes},
      {"study", StudySeeds, AsItIs, CheckStudy, kTextBytes},
      {"task", TaskSeeds, AsItIs, ReadTask, kTextBytes},
      {"aircraft", AircraftSeeds, AsItIs, ReadAircraft, kAircraftBytes},
      {"fdm", FdmSeeds, AsItIs, ReadFdm, kTextBytes},
      {"metrics", MetricsSeeds, AsItIs, ReadMetrics, kTextBytes},
      {"plant", PlantSeeds, WholePlantRecords, ComparePlants, kRecordBytes},
      {"network", NetworkSeeds, WholeNetworkRecords, CompareNetworks, kRecordBytes},
  };
  return targets;
}

bool Takes(const FuzzTarget& target, const std::string& file) {
  try {
    target.read(file);
    return true;
  } catch (const Error& error) {
    const std::string message = error.what();
    if (message.empty() || message.find('\n') != std::string::npos) {
      throw std::logic_error("not one line: " + message);
    }
    return false;
  }
}

}  // namespace skein
