#include "src/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "src/commands.h"

namespace skein {
namespace {

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

void PrintError(const std::string& message) {
  std::fflush(stdout);
  fmt::print(stderr, "skein: error: {}\n", FirstLine(message));
}

/// The deepest subcommand that the command line reached, as "skein fdm eval".
std::string CommandPath(const CLI::App& app) {
  std::string path = app.get_name();
  for (const CLI::App* sub : app.get_subcommands()) path += " " + CommandPath(*sub);
  return path;
}

}  // namespace

int RunProgram(int argc, char** argv) {
  CLI::App app("Skein: fixed-wing flight simulation and recurrent PPO on SIMD CPU cores", "skein");
  app.set_version_flag("--version", "skein " SKEIN_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  skein train heading                       train, evaluate, and say where everything lies\n"
      "  skein eval --policy runs/RUN --task heading --deterministic\n"
      "  skein fdm trim --altitude-ft 15000 --speed-fps 500\n"
      "Every command has --help. Exit codes: 0 success, 1 error, 2 wrong usage.");
  AddTrainCommand(&app);
  AddEvalCommand(&app);
  AddFdmCommand(&app);
  AddBenchCommand(&app);
  AddInfoCommand(&app);
  try {
    app.parse(argc, argv);
    return kExitSuccess;
  } catch (const CLI::Success& success) {  // --help and --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    PrintError(fmt::format("{} (see {} --help)", FirstLine(error.what()), CommandPath(app)));
    return kExitUsage;
  } catch (const std::bad_alloc&) {
    PrintError("out of memory; fewer aircraft or shorter rollouts need less");
  } catch (const std::exception& error) {
    PrintError(error.what());
  }
  return kExitFailure;
}

}  // namespace skein
