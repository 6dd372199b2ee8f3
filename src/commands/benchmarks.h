// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/bench/figure.h"
#include "src/commands/launched_ranks.h"
#include "train/ppo/train_config.h"

namespace skein {

/// What the command line of `skein bench` says.
struct BenchOptions {
  int num_aircraft = 1000000;
  int steps = 30;
  int action_repeat = 1;
  int threads = 0;
  int iterations = 3;
  std::string task = "heading";
  std::string beside;  ///< another task; empty: none
  std::string preset = "default";
  std::string aircraft;  ///< what flies; empty: as the preset says
  std::string low_level;
  std::vector<std::string> conditions, assignments;
  std::string json;
  double rank_timeout_s = kRankTimeoutS;
  std::string launcher = "mpirun --oversubscribe --bind-to none";  ///< starts the ranks of scaling
  std::string before, after;  ///< files that are compared, separated by commas
  bool other_machine = false;
};

/// Each prints its figures for people, and writes them to options.json if that is given. Throws
/// Error on a configuration that cannot be.
void BenchSimulator(const BenchOptions& options);
void BenchRollout(const BenchOptions& options);
void BenchUpdate(const BenchOptions& options);
void BenchIteration(const BenchOptions& options);
void BenchSignature(const BenchOptions& options);
void BenchScaling(const BenchOptions& options);
void CompareBenchmarkFiles(const BenchOptions& options);

/// The files that a benchmark reads: what is flown, and what is compared.
std::vector<std::string> FilesRead(const BenchOptions& options);

/// The configuration of the task's preset with the conditions and assignments.
TrainConfig BenchConfig(const BenchOptions& options);

/// What was measured.
struct BenchResults {
  std::string benchmark;
  int threads = 0;
  std::vector<Figure> figures;
  nlohmann::ordered_json other;  ///< by the names of docs/reference/commands.md
  std::string task_hash = "";    ///< EnvConfig::task_file_hash
};

/// Writes it, with how and on what it was measured, to options.json if that is given.
void Report(const BenchOptions& options, const BenchResults& results);

/// What part of the measured peak of products in `type` it is, for people and for files.
std::string ShareOfPeak(double gflops, double peak_gflops, const char* type = "float32");
nlohmann::ordered_json WithShareOfPeak(nlohmann::ordered_json results, double gflops,
                                       double peak_gflops);

}  // namespace skein
