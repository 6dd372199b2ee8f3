// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <memory>

#include "base/error.h"
#include "src/commands/commands.h"
#include "src/commands/threads_option.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/files/output_file.h"
#include "src/files/shell_text.h"
#include "src/report/live_report.h"
#include "src/report/report_page.h"
#include "src/report/report_server.h"
#include "src/report/run_record.h"
#include "src/report/training_times.h"
#include "src/run/run_directory.h"
#include "src/run/run_signals.h"

namespace skein {
namespace {

struct ReportOptions {
  ReportRequest request;
  std::string output, json;
  bool opens = false, watches = false;
  int threads = 0;
};

bool HasDesktop() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

/// Hands a file or an address to the desktop's browser, and waits for it two seconds at most: a
/// desktop without a browser fails at once, and one with it may go on for as long as that is open.
void Open(const std::string& place) {
  const std::string command = "command -v xdg-open >/dev/null || exit 1; xdg-open " +
                              ShellWord(place) +
                              " >/dev/null 2>&1 & for i in 1 2 3 4 5 6 7 8 9 10; do sleep 0.2; "
                              "kill -0 $! 2>/dev/null || { wait $!; exit; }; done";
  if (!HasDesktop() || std::system(command.c_str()) != 0) {
    fmt::print("no browser could be started; open {} yourself\n", place);
  }
}

void Watch(const ReportOptions& options, WorkerPool& pool) {
  const RunSignals signals(pool);
  const std::string page = LivePage(ReportTemplate());  // without one there is nothing to fly for
  LiveReport report(options.request, pool);
  report.Data();  // what is wrong with the runs is said here, and not in a browser
  ReportServer server(page, [&] { return report.Data(); });
  fmt::print("{}  until Ctrl-C; for this machine alone\n", server.address());
  std::fflush(stdout);
  if (options.opens) Open(server.address());
  server.Serve([&] { return pool.stopping(); });
}

/// Throws Error if none of the runs has come to its first iteration.
void CheckSomethingToShow(const std::vector<std::string>& runs) {
  const auto has_rows = [](const std::string& run) {
    return ReadRunRecord(run).metrics.rows() > 0;
  };
  // Each is read, so that what is wrong with any of them is said before the flights.
  if (std::count_if(runs.begin(), runs.end(), has_rows) > 0) return;
  throw Error(fmt::format(
      "{}: no iteration in metrics.csv yet, so there is nothing to show; --watch waits for them",
      runs.front()));
}

/// What the trainings took, as far as they say it.
void SayTimes(const ReportOptions& options) {
  auto all = nlohmann::ordered_json::array();
  for (const std::string& run : options.request.runs) {
    const std::optional<TrainingTimes> times = TimesOf(ReadRunRecord(run));
    if (!times) continue;
    fmt::print("{}\n{}\n{}\n", run, ToText(*times), SharesText(*times));
    all.push_back({{"run", run}});
    all.back().update(ToJson(*times));
  }
  if (!options.json.empty()) WriteJson(options.json, all);
}

void Report(const ReportOptions& options) {
  WorkerPool pool(options.threads);
  if (options.watches) {
    Watch(options, pool);
    return;
  }
  const bool is_of_one = options.request.runs.size() == 1;
  const std::string output = !options.output.empty() ? options.output
                             : is_of_one             ? options.request.runs.front() + "/report.html"
                                                     : "report.html";
  CheckSomethingToShow(options.request.runs);
  CheckWritable({output, options.json}, FilesOfRuns(options.request.runs));
  RequireEnding(output, ".html", "the report is a page");
  RequireEnding(options.json, ".json", "--json writes JSON");
  SayTimes(options);
  ReportTemplate();
  const std::string data = ReportData(options.request, pool);
  // A run's own page is there to be renewed.
  const std::string name = OutputName(output, options.output.empty() && !is_of_one);
  WriteReport(output, data);
  fmt::print("{}\n", name);
  if (options.opens) Open(output);
}

}  // namespace

void AddReportCommand(CLI::App* app) {
  auto options = std::make_shared<ReportOptions>();
  options->request.flights_option = "--flights-count";
  CLI::App* command = app->add_subcommand(
      "report", "Write a page that shows runs: curves, metrics, flights in 3-D");
  command->add_option("runs", options->request.runs, "directories of runs")
      ->type_name("RUN...")
      ->required();
  CLI::Option* output =
      command
          ->add_option("-o,--output,--out", options->output,
                       "the page, one file that needs no network (default: RUN/report.html; of "
                       "several runs report.html)")
          ->type_name("FILE");
  command
      ->add_option(
          "--episodes", options->request.episodes,
          "episodes flown by policies and autopilots for the table of metrics; 0: no table")
      ->transform(WholeNumber(0, 1000000))
      ->capture_default_str();
  command
      ->add_option("--flights-count,--flights", options->request.flights,
                   "how many of them are shown in space; 0: none")
      ->transform(WholeNumber(0, 1000))
      ->capture_default_str();
  CLI::Option* watch =
      command
          ->add_flag("--watch", options->watches,
                     "serve the page on 127.0.0.1, and keep it fresh while the runs go on")
          ->excludes(output);
  command->add_flag("--open", options->opens, "show it in a browser");
  command
      ->add_option("--json", options->json,
                   "write what the trainings took here: seconds, and the share of each part")
      ->type_name("FILE")
      ->excludes(watch);
  AddThreadsOption(command, &options->threads);
  command->footer(
      "Runs of one configuration are shown as mean and band over their seeds.\n"
      "Example: skein report runs/short --open\n"
      "         skein report runs/seed-1 runs/seed-2 runs/seed-3 -o seeds.html\n"
      "         skein report runs/short --watch");
  command->callback([options] { Report(*options); });
}

}  // namespace skein
