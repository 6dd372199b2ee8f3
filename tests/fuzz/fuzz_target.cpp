// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzz_target.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "envs/aircraft/aircraft_document.h"
#include "envs/kernels/plant_kernel.h"
#include "src/config/configuration.h"
#include "src/fdm/fdm_evaluation.h"
#include "src/files/output_file.h"
#include "src/report/csv_columns.h"
#include "src/run/metrics.h"
#include "src/run/record_file.h"
#include "src/study/study.h"
#include "tests/scratch_directory.h"
#include "tests/train/small_config.h"
#include "train/policy/recurrent_policy.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

/// Where a reader that wants a path finds the file.
const std::string& InFile(const std::string& bytes, const char* extension = "") {
  static const ScratchDirectory scratch;
  static std::string path;
  path = scratch / "file" + extension;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// The files of a folder of the repository, and of the folders in it, whose names end so.
std::vector<std::string> Shipped(const std::string& folder, const std::string& extension) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(SKEIN_SOURCE "/" + folder)) {
    if (entry.path().extension() == extension) files.push_back(ReadFile(entry.path().string()));
  }
  return files;
}

std::string AsItIs(std::string file) { return file; }

// Containers of tensors: policies and checkpoints.

constexpr std::size_t kLengthBytes = 8, kDigits = 16;

std::uint64_t HeaderLength(const std::string& file) {
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    length |= std::uint64_t{static_cast<unsigned char>(file[i])} << (8 * i);
  }
  return length;
}

/// The header's length is what its end says, and the checksum that of the file.
std::string RepairedContainer(std::string file) {
  if (file.size() < kLengthBytes) return file;
  std::uint64_t length = HeaderLength(file);
  if (length > file.size() - kLengthBytes || file[kLengthBytes + length - 1] == '}') {
    const std::size_t end = file.find("}}");
    if (end == std::string::npos) return file;
    length = end + 2 - kLengthBytes;
    for (std::size_t i = 0; i < kLengthBytes; ++i) file[i] = static_cast<char>(length >> (8 * i));
  }
  const std::string field = "\"checksum\":\"";
  const std::size_t place = file.find(field, kLengthBytes);
  if (place == std::string::npos || place + field.size() + kDigits > kLengthBytes + length) {
    return file;
  }
  file.replace(place + field.size(), kDigits, kDigits, '0');
  FnvHash hash;
  hash.Add(file.data() + kLengthBytes, file.size() - kLengthBytes);
  return file.replace(place + field.size(), kDigits, hash.Hex());
}

TrainConfig FuzzedTraining() {
  TrainConfig config = SmallConfig();
  config.network.hidden_size = config.network.gru_size = 8;
  config.ppo.num_aircraft = 32;
  config.ppo.minibatches = 1;
  config.evaluation.interval_iterations = 0;
  return config;
}

WorkerPool& OneWorker() {
  static WorkerPool pool(1);
  return pool;
}

std::vector<std::string> PolicySeeds() {
  NetworkConfig network;
  network.hidden_size = network.gru_size = 4;
  const std::string path = InFile("", ".skein");
  RecurrentPolicy::Untrained(network, 22, 4, 1).Save(path);
  return {ReadFile(path)};
}

void ReadPolicy(const std::string& file) { RecurrentPolicy::Load(InFile(file, ".skein")); }

std::vector<std::string> CheckpointSeeds() {
  Trainer trainer(FuzzedTraining(), OneWorker());
  trainer.Iterate();
  const std::string path = InFile("", ".skein");
  trainer.Save(path, "100 0123456789abcdef");
  return {ReadFile(path)};
}

/// A checkpoint that is refused leaves the training as it was, and one that is taken is gone on
/// with, whatever its numbers are.
void ReadCheckpoint(const std::string& file) {
  Trainer trainer(FuzzedTraining(), OneWorker());
  const std::uint64_t before = trainer.Signature();
  try {
    trainer.Restore(InFile(file, ".skein"));
  } catch (const Error&) {
    if (trainer.Signature() != before)
      throw std::logic_error("a refused checkpoint has changed it");
    throw;
  }
  if (!trainer.finished()) trainer.Iterate();
}

// Texts.

std::vector<std::string> ConfigurationSeeds() { return Shipped("configs/heading", ".toml"); }

void ReadConfiguration(const std::string& file) {
  CheckConsistent(ResolveConfig({"heading", "default", InFile(file, ".toml"), {}}));
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

std::vector<std::string> AircraftSeeds() { return Shipped("data", ".json"); }

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
  for (report.iteration = 1; report.iteration <= 8; ++report.iteration) rows += MetricsRow(report);
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

}  // namespace

const std::vector<FuzzTarget>& FuzzTargets() {
  static const std::vector<FuzzTarget> targets = {
      {"policy", PolicySeeds, RepairedContainer, ReadPolicy},
      {"checkpoint", CheckpointSeeds, RepairedContainer, ReadCheckpoint},
      {"configuration", ConfigurationSeeds, AsItIs, ReadConfiguration},
      {"study", StudySeeds, AsItIs, CheckStudy},
      {"task", TaskSeeds, AsItIs, ReadTask},
      {"aircraft", AircraftSeeds, AsItIs, ReadAircraft},
      {"fdm", FdmSeeds, AsItIs, ReadFdm},
      {"metrics", MetricsSeeds, AsItIs, ReadMetrics},
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
