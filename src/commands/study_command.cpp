// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "src/commands/commands.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/study/study.h"
#include "src/study/study_run.h"

namespace skein {
namespace {

struct StudyOptions {
  std::string file;
  std::string out;
  int threads = 0;
};

void CarryOut(const StudyOptions& options) {
  const Study study = AsUsage([&] { return ReadStudy(options.file); });
  const std::string directory =
      options.out.empty() ? "studies/" + std::filesystem::path(options.file).stem().string()
                          : options.out;
  WorkerPool pool(options.threads);
  StudyRun run(study, directory, pool);
  if (!run.Run()) {
    fmt::print("stopped; resume with: skein study {} --out {}\n", options.file, directory);
    return;
  }
  fmt::print("{}\nresults         {}/results.csv, results.json\n", run.ToText(), directory);
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
      ->add_option("--threads", options->threads,
                   "worker threads; results do not depend on it (default: one per CPU)")
      ->transform(WholeNumber(1, 1024));
  command->footer(
      "The same command resumes after an interruption of any kind, and skips what is finished.\n"
      "Example: skein study configs/studies/noise.toml");
  command->callback([options] { CarryOut(*options); });
}

}  // namespace skein
