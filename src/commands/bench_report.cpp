// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <utility>

#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/bench/machine.h"
#include "src/commands/aircraft_option.h"
#include "src/commands/benchmarks.h"
#include "src/config/aircraft_choice.h"
#include "src/config/configuration.h"
#include "src/config/task_file.h"
#include "src/config/usage_error.h"
#include "src/files/output_file.h"

namespace skein {

using Json = nlohmann::ordered_json;

std::vector<std::string> FilesRead(const BenchOptions& options) {
  std::vector<std::string> files = AircraftFilesIn(options.aircraft, options.assignments);
  for (const std::string& task : {options.task, options.beside}) {
    if (!IsTaskFile(task)) continue;
    files.push_back(task);
    files.push_back(AsUsage([&] { return AircraftFileNamedIn(task); }));
  }
  const std::string low_level = IsAutopilot(options.low_level) ? "" : options.low_level;
  for (const auto& more : {FilesOfPolicy(low_level), CLI::detail::split(options.before, ','),
                           CLI::detail::split(options.after, ',')}) {
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

TrainConfig BenchConfig(const BenchOptions& options) {
  return AsUsage([&] {
    std::vector<std::string> assignments = options.assignments;
    if (!options.aircraft.empty()) {
      assignments.insert(assignments.begin(), AircraftAssignment(options.aircraft));
    }
    const ProgramConfig config =
        ResolveConfig({options.task, options.preset, "", assignments, options.conditions});
    CheckConsistent(config);
    return config.train;
  });
}

void Report(const BenchOptions& options, const BenchResults& results) {
  if (options.json.empty()) return;
  Json document{{"benchmark", results.benchmark}};
  document.update(results.other);
  if (!results.figures.empty()) document["figures"] = ToJson(results.figures);
  document["settings"] = {{"task", options.task},           {"beside", options.beside},
                          {"preset", options.preset},       {"aircraft", options.aircraft},
                          {"low_level", options.low_level}, {"conditions", options.conditions},
                          {"set", options.assignments}};
  if (results.benchmark == "sim") {
    document["settings"]["num_aircraft"] = options.num_aircraft;
    document["settings"]["action_repeat"] = options.action_repeat;
  }
  if (!results.task_hash.empty()) document["task_hash"] = results.task_hash;
  document["threads"] = results.threads;
  document["machine"] = DescribeMachine();
  WriteJson(options.json, document);
}

std::string ShareOfPeak(double gflops, double peak_gflops, const char* type) {
  return fmt::format("{:.1f} GFLOP/s, {:.1f} % of the measured peak of {:.1f} GFLOP/s in {}",
                     gflops, 100 * gflops / peak_gflops, peak_gflops, type);
}

Json WithShareOfPeak(Json results, double gflops, double peak_gflops) {
  results["gflops"] = gflops;
  results["peak_gflops"] = peak_gflops;
  results["fraction_of_peak"] = gflops / peak_gflops;
  return results;
}

}  // namespace skein
