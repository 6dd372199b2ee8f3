// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "base/field_list.h"
#include "src/commands/aircraft_option.h"
#include "src/commands/commands.h"
#include "src/commands/launched_ranks.h"
#include "src/commands/threads_option.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/files/shell_text.h"
#include "src/report/report_data.h"
#include "src/report/run_report.h"
#include "src/study/study.h"
#include "src/study/study_run.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

/// Of each environment that was trained in.
constexpr int kShownEpisodes = 2;

struct StudyOptions {
  std::string file;
  std::string out;
  StudyChoice choice;
  int threads = 0;
  double rank_timeout_s = kRankTimeoutS;
};

/// The options of the command line that say what of the study is carried out, for it to be resumed.
std::string ChoiceText(const StudyChoice& choice) {
  std::string text;
  for (const std::string& level : choice.levels) text += " --level " + ShellWord(level);
  if (!choice.seeds.empty()) text += fmt::format(" --seeds {}", fmt::join(choice.seeds, ","));
  if (choice.steps) text += fmt::format(" --steps {:.0f}", *choice.steps);
  if (!choice.aircraft.empty()) text += " --aircraft " + ShellWord(choice.aircraft);
  return text;
}

/// On all ranks together.
void CarryOut(const StudyOptions& options, Ranks& ranks) {
  const std::string directory =
      options.out.empty() ? "studies/" + std::filesystem::path(options.file).stem().string()
                          : options.out;
  WorkerPool pool(options.threads);
  Study study;
  DoTogether(ranks,
             [&] { study = AsUsage([&] { return ReadStudy(options.file, options.choice); }); });
  StudyRun run(study, directory, pool, ranks);
  if (!run.Run()) {
    fmt::print("stopped; resume with: {} study {} --out {}{}\n", ProgramWord(),
               ShellWord(options.file), ShellWord(directory), ChoiceText(options.choice));
    return;
  }
  if (ranks.rank() != 0) return;
  fmt::print("{}\nresults         {}/results.csv, results.json\n", run.ToText(), directory);
  WriteReportAtEnd(directory + "/report.html", [&] {
    ReportRequest request;
    request.runs = run.RunPaths();
    request.episodes = 0;  // the study has flown its own
    request.flights = kShownEpisodes;
    request.comparisons = run.ShownComparisons();
    return ReportData(request, pool);
  });
}

}  // namespace

void AddStudyCommand(CLI::App* app) {
  auto options = std::make_shared<StudyOptions>();
  CLI::App* command = app->add_subcommand(
      "study", "Train and evaluate a grid: tasks, levels of a condition, seeds");
  command
      ->add_option("file", options->file, "TOML file that says what (docs/reference/commands.md)")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--out", options->out,
                   "directory of the study; what of it is there already is kept (default: "
                   "studies/NAME for NAME.toml)")
      ->type_name("DIR");
  command
      ->add_option("--level", options->choice.levels,
                   "carry out this level of the file alone; may be repeated (default: all)")
      ->type_name("LEVEL")
      ->allow_extra_args(false);
  command
      ->add_option("--seeds", options->choice.seeds,
                   "seeds of the trainings, separated by commas (default: the file's)")
      ->type_name("SEED,...")
      ->delimiter(',')
      ->transform(WholeNumber(0, kMostWholeNumber));
  command
      ->add_option("--steps", options->choice.steps,
                   "budget of a training, control steps (default: the file's, else the preset's)")
      ->transform(WholeNumber(1, kMostWholeNumber));
  AddAircraftOption(command, &options->choice.aircraft);
  AddThreadsOption(command, &options->threads);
  AddRankTimeoutOption(command, &options->rank_timeout_s);
  command->footer(
      "The same command resumes after an interruption of any kind, and skips what is finished.\n"
      "Seeds and levels may be added later. Under mpirun processes share out trainings and "
      "episodes.\n"
      "Example: skein study configs/studies/noise.toml\n"
      "         skein study configs/studies/heading.toml --level windy-middle --seeds 1,2,3");
  command->callback([options] {
    OnLaunchedRanks(options->rank_timeout_s, [&](Ranks& ranks) { CarryOut(*options, ranks); });
  });
}

}  // namespace skein
