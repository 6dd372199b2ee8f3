// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace skein {

// Each adds one subcommand to `app`. Its callback does the work and throws Error on failure.
void AddTrainCommand(CLI::App* app);
void AddEvalCommand(CLI::App* app);
void AddCompareCommand(CLI::App* app);
void AddReplayCommand(CLI::App* app);
void AddReportCommand(CLI::App* app);
void AddStudyCommand(CLI::App* app);
void AddFdmCommand(CLI::App* app);
void AddAircraftCommand(CLI::App* app);
void AddBenchCommand(CLI::App* app);
void AddExportCommand(CLI::App* app);
void AddInfoCommand(CLI::App* app);
void AddListCommand(CLI::App* app);
void AddHelpCommand(CLI::App* app);
void AddCompletionCommand(CLI::App* app);
void AddManualCommand(CLI::App* app);

}  // namespace skein
