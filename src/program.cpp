// SPDX-License-Identifier: Apache-2.0
#include "src/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "base/choice_error.h"
#include "base/reason_of.h"
#include "src/bench/version.h"
#include "src/commands/command_tree.h"
#include "src/commands/commands.h"
#include "src/commands/plot_command.h"
#include "src/commands/wrong_usage.h"
#include "src/config/configuration.h"
#include "src/config/key_reference.h"
#include "src/config/usage_error.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

/// Takes the descriptors of standard streams that were closed, so that no file opened later becomes
/// one of them; the wrong way round, so that using it stays an error.
void OccupyStandardStreams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) >= 0) continue;
    static_cast<void>(open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

void PrintError(const std::string& message) {
  std::fflush(stdout);
  fmt::print(stderr, "skein: error: {}\n", FirstLine(message));
}

/// Throws on an empty argument and on "--option=": an unset variable of a shell is no choice.
void RefuseEmptyValues(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.empty()) {
      throw CLI::ValidationError(fmt::format("the argument after {} is empty", argv[i - 1]));
    }
    if (argument.rfind("--", 0) == 0 && argument.find('=') == argument.size() - 1) {
      throw CLI::ValidationError(argument + " has no value");
    }
  }
}

/// The exit code of a command that went well, if what it said has reached the standard output.
int ExitCode() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return kExitSuccess;
  fmt::print(stderr, "skein: error: the standard output cannot be written: {}\n", SystemReason());
  std::clearerr(stdout);
  return kExitFailure;
}

std::string VersionText() {
  const BuildInfo& build = Build();
  return fmt::format("skein {} (commit {}, {}, {})", build.version, build.commit, build.compiler,
                     build.type);
}

void AddCommands(CLI::App* app) {
  app->set_version_flag("--version", VersionText);
  app->add_flag_callback(
      "--help-keys",
      [] {
        fmt::print("{}", DescribeKeys(ProgramConfig{}));
        throw CLI::Success();
      },
      "list every configuration key and exit (skein train TASK --help-keys: with its preset)");
  app->require_subcommand(1);
  AddTrainCommand(app);
  AddEvalCommand(app);
  AddCompareCommand(app);
  AddReplayCommand(app);
  AddStudyCommand(app);
  AddPlotCommand(app);
  AddReportCommand(app);
  AddFdmCommand(app);
  AddAircraftCommand(app);
  AddExportCommand(app);
  AddBenchCommand(app);
  AddListCommand(app);
  AddInfoCommand(app);
  AddHelpCommand(app);
  AddCompletionCommand(app);
  AddManualCommand(app);
  NameNumbers(app);
  RefuseOptionsAsValues(app);
  // After the commands, which would inherit it.
  app->footer(
      "Examples:\n"
      "  skein train heading                       train, evaluate, and say where everything lies\n"
      "  skein eval --policy runs/RUN --task heading\n"
      "  skein compare --task heading --agents policy:runs/RUN,random\n"
      "  skein fdm trim --altitude-ft 15000 --speed-fps 500\n"
      "Every command has --help. Exit codes: 0 success, 1 failure, 2 wrong usage.");
}

/// What the command line asks for. Throws what goes wrong beyond the line itself.
int RunCommand(int argc, char** argv) {
  CLI::App app("Skein: fixed-wing flight simulation and recurrent PPO on SIMD CPU cores", "skein");
  AddCommands(&app);
  try {
    RefuseEmptyValues(argc, argv);
    app.parse(argc, argv);
    return ExitCode();
  } catch (const CLI::Success& success) {  // --help and --version
    app.exit(success);
    return ExitCode();
  } catch (const CLI::ParseError& error) {
    PrintError(WrongUsage(app, error));
    return kExitUsage;
  }
}

/// The same, which throws nothing but std::bad_alloc.
int RunToExitCode(int argc, char** argv) {
  try {
    return RunCommand(argc, argv);
  } catch (const UsageError& error) {
    PrintError(error.what());
    return kExitUsage;
  } catch (const ChoiceError& error) {
    PrintError(error.what());
    return kExitUsage;
  } catch (const std::filesystem::filesystem_error& error) {
    PrintError(fmt::format("{}: {}", error.path1().string(), error.code().message()));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    PrintError(error.what());
  }
  return kExitFailure;
}

/// In a way that needs no memory.
void PrintOutOfMemory(const std::bad_alloc& failure) {
  std::fflush(stdout);
  std::fprintf(stderr, "skein: error: %s\n", ReasonOf(failure));
}

std::terminate_handler TerminateOtherwise();

/// Libraries ask for memory in functions that may throw nothing (CLI11's search for subcommands,
/// destructors of the JSON library): where there is none, that is said as anywhere else.
[[noreturn]] void EndWithoutMemory() {
  try {
    if (std::current_exception() != nullptr) throw;
  } catch (const std::bad_alloc& failure) {
    PrintOutOfMemory(failure);
    std::_Exit(kExitFailure);
  } catch (...) {
  }
  TerminateOtherwise()();
  std::abort();
}

/// What ends the program for all other reasons. The first call puts EndWithoutMemory before it.
std::terminate_handler TerminateOtherwise() {
  static const std::terminate_handler handler = std::set_terminate(EndWithoutMemory);
  return handler;
}

}  // namespace

int RunProgram(int argc, char** argv) {
  OccupyStandardStreams();
  // It asks a training to save: before there is one, or after it, it is no reason to die.
  std::signal(SIGUSR1, SIG_IGN);
  TerminateOtherwise();
  try {
    return RunToExitCode(argc, argv);
  } catch (const std::bad_alloc& failure) {
    PrintOutOfMemory(failure);
    return kExitFailure;
  }
}

}  // namespace skein
