// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/worker_pool.h"
#include "src/bench/figure.h"
#include "src/commands/benchmarks.h"
#include "src/config/usage_error.h"
#include "src/files/output_file.h"
#include "src/files/scratch_folder.h"
#include "src/files/shell_text.h"
#include "src/files/text_table.h"
#include "src/run/progress.h"
#include "train/ranks/rank_module.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

/// Ranks, and threads of each.
struct Grid {
  int ranks = 1, threads = 1;
};

/// One processor, and every way to use all of them.
std::vector<Grid> GridsOf(int processors) {
  std::vector<Grid> grids{{1, 1}};
  if (processors > 1) grids.push_back({1, processors});
  for (int ranks = 2; ranks <= processors; ranks *= 2) {
    if (processors % ranks == 0) grids.push_back({ranks, processors / ranks});
  }
  return grids;
}

bool IsThere(const std::string& program) {
  return std::system(("command -v " + ShellWord(program) + " >/dev/null 2>&1").c_str()) == 0;
}

/// With shards for the most ranks, unless the user has said how many.
std::vector<std::string> Assignments(const BenchOptions& options, int most_ranks) {
  std::vector<std::string> assignments = options.assignments;
  assignments.insert(assignments.begin(), fmt::format("learner.shards={}", most_ranks));
  return assignments;
}

/// The line of the shell that measures iterations on a grid and leaves the figures in `json`.
std::string CommandLine(const BenchOptions& options, const Grid& grid, int most_ranks,
                        const std::string& json) {
  std::vector<std::string> words = {std::filesystem::read_symlink("/proc/self/exe").string(),
                                    "bench", "iteration", "--json", json};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--threads", std::to_string(grid.threads));
  add("--iterations", std::to_string(options.iterations));
  add("--task", options.task);
  add("--preset", options.preset);
  add("--aircraft", options.aircraft);
  add("--low-level", options.low_level);
  for (const std::string& condition : options.conditions) add("--condition", condition);
  for (const std::string& assignment : Assignments(options, most_ranks)) add("--set", assignment);
  std::string line = grid.ranks > 1 ? fmt::format("{} -n {}", options.launcher, grid.ranks) : "";
  for (const std::string& word : words) line += " " + ShellWord(word);
  return line + " >/dev/null";
}

/// What was measured on a grid.
struct Point {
  Grid grid;
  Json document;  ///< of skein bench iteration

  std::string name() const { return fmt::format("{}x{}", grid.ranks, grid.threads); }
  double steps_per_s() const { return document["control_steps_per_s"]; }
  /// What of the processors' speed is left, if one alone does `alone` steps per second.
  double Efficiency(double alone) const {
    return steps_per_s() / (alone * grid.ranks * grid.threads);
  }
};

std::vector<Point> Measure(const BenchOptions& options, const std::vector<Grid>& grids) {
  const ScratchFolder folder;
  const std::string json = folder / "iteration.json";
  std::vector<Point> points;
  for (const Grid& grid : grids) {
    RunShell(CommandLine(options, grid, grids.back().ranks, json), folder,
             fmt::format("{} x {}", Counted(grid.ranks, "rank"), Counted(grid.threads, "thread")));
    points.push_back({grid, Json::parse(ReadFile(json))});
  }
  return points;
}

void Print(const std::vector<Point>& points) {
  const double alone = points[0].steps_per_s();
  std::vector<std::vector<std::string>> rows{{"  ranks x threads", "s an iteration",
                                              "control steps/s", "efficiency", "exchanging",
                                              "MB sent by a rank"}};
  for (const Point& point : points) {
    const Json& json = point.document;
    rows.push_back({fmt::format("  {} x {}", point.grid.ranks, point.grid.threads),
                    fmt::format("{:.3f}", json["iteration_s"].get<double>()),
                    FormatCount(point.steps_per_s()),
                    fmt::format("{:.1f} %", 100 * point.Efficiency(alone)),
                    fmt::format("{:.1f} %", 100 * json["exchange_share"].get<double>()),
                    fmt::format("{:.1f}", json["sent_mb"].get<double>())});
  }
  fmt::print(
      "{}  (efficiency: of so many times the speed of 1 x 1; exchanging: or waiting for "
      "others)\n",
      InColumns(rows));
}

BenchResults ResultsOf(const std::vector<Point>& points, int processors) {
  BenchResults results{"scaling", processors, {}, {{"points", Json::array()}}};
  for (const Point& point : points) {
    const Json& json = point.document;
    results.other["points"].push_back({{"ranks", point.grid.ranks},
                                       {"threads", point.grid.threads},
                                       {"iteration_s", json["iteration_s"]},
                                       {"control_steps_per_s", json["control_steps_per_s"]},
                                       {"efficiency", point.Efficiency(points[0].steps_per_s())},
                                       {"exchange_share", json["exchange_share"]},
                                       {"sent_mb", json["sent_mb"]}});
    for (Figure& figure : ReadFigures(json["figures"], point.name())) {
      if (figure.name != "iteration_s") continue;
      figure.name = point.name() + "_iteration_s";
      results.figures.push_back(std::move(figure));
    }
  }
  return results;
}

}  // namespace

void BenchScaling(const BenchOptions& options) {
  if (LaunchedProcesses() > 1) {
    throw UsageError("bench scaling starts ranks itself: start one process, or under " +
                     std::string("a launcher skein bench iteration"));
  }
  const int processors = WorkerPool(options.threads).threads();
  std::vector<Grid> grids = GridsOf(processors);
  const std::string launcher = options.launcher.substr(0, options.launcher.find(' '));
  const bool has_launcher = IsThere(launcher);
  if (!has_launcher) {
    grids.erase(
        std::remove_if(grids.begin(), grids.end(), [](const Grid& grid) { return grid.ranks > 1; }),
        grids.end());
  }
  const TrainConfig config = BenchConfig(options);
  fmt::print("scaling: {}, {} aircraft x {} policy steps, {}; medians of {}\n", options.task,
             config.ppo.num_aircraft, config.ppo.rollout_steps, Counted(processors, "processor"),
             Counted(options.iterations, "iteration"));
  std::fflush(stdout);
  const std::vector<Point> points = Measure(options, grids);
  Print(points);
  if (!has_launcher) fmt::print("  ({} is not there: no ranks)\n", launcher);
  BenchResults results = ResultsOf(points, processors);
  results.task_hash = config.env.task_file_hash;
  Report(options, results);
}

}  // namespace skein
