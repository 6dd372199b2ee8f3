// SPDX-License-Identifier: Apache-2.0
#include "tests/src/faults/faulted_commands.h"

#include <filesystem>
#include <stdexcept>

#include "src/files/output_file.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

Arguments Joined(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

Arguments ShortFlights(const Arguments& arguments) {
  return Joined(arguments, {"--set", "env.time_limit_steps=60", "--set",
                            "env.heading.earliest_success_step=60"});
}

Arguments ShortTraining(const std::string& folder) {
  return TinyTraining(folder + "/run", {"--steps", "15360", "--set", "checkpoint.keep=2"});
}

void CopyPolicy(const std::string& folder) {
  fs::copy(SKEIN_SOURCE "/policies/heading.skein", folder + "/heading.skein");
}

/// A run that was stopped after its first iteration.
void BeginRun(const std::string& folder) {
  const ProgramResult result = RunSkein(ShortTraining(folder));
  if (result.exit_code != 0) throw std::runtime_error(result.error);
  for (const std::string name :
       {"checkpoint-000002", "checkpoint-000003", "policy-best", "policy-final"}) {
    fs::remove(folder + "/run/checkpoints/" + name + ".skein");
  }
  fs::remove(folder + "/run/evaluation.json");
}

const char* const kStudy = R"(
tasks = ["heading"]
seeds = [3]
agents = ["zero"]
set = ["env.time_limit_steps=60", "env.heading.earliest_success_step=60"]
[training]
steps = 10240
set = ["ppo.num_aircraft=64", "ppo.rollout_steps=16", "ppo.chunk_length=8", "ppo.minibatches=2",
       "network.hidden_size=16", "network.gru_size=16", "evaluation.interval_iterations=1",
       "evaluation.episodes=8", "evaluation.final_episodes=8", "checkpoint.interval_iterations=1"]
[evaluation]
episodes = 8
seed = 5
[[level]]
name = "quiet"
)";

const char* const kSticks = "time_s,pitch\n0.1,0.2\n0.3,0\n";

const char* const kTrajectory = R"({"trajectories": [
 {"initial_state": [500, 0, 20, 0, 0, 0, 0, 0, -15000, 1, 0, 0, 0],
  "trim_controls": [2000, -2, 0, 0, 0], "t": [0, 0.1, 0.4]}]})";

const char* const kPoints = R"({"points": [
 {"state": [500, 0, 20, 0, 0, 0, 0, 0, -15000, 1, 0, 0, 0], "controls": [2000, -2, 0, 0, 0]},
 {"state": [600, 0, 20, 0, 0, 0, 0, 0, -15000, 1, 0, 0, 0], "controls": [2000, -2, 0, 0, 0],
  "params": {"xcg": 0.35}}]})";

/// `fdm COMMAND` at two altitudes and two speeds, with OPTIONS of it that name files to write.
FaultedCommand OverGrid(const char* name, const std::string& command,
                        const std::vector<std::pair<std::string, std::string>>& options) {
  return {name, [](const std::string&) {},
          [=](const std::string& folder) {
            Arguments line = {"fdm",        command,       "--altitude-ft",
                              "5000,15000", "--speed-fps", "500,600"};
            for (const auto& [option, file] : options) {
              line.insert(line.end(), {option, folder + "/" + file});
            }
            return line;
          }};
}

/// `export --format FORMAT -o FILE` of a shipped policy.
FaultedCommand Export(const char* name, const std::string& format) {
  return {name, CopyPolicy, [=](const std::string& folder) {
            return Arguments{"export", folder + "/heading.skein",     "--format", format,
                             "-o",     folder + "/exported." + format};
          }};
}

/// The same of C, which a compiler checks in a temporary folder.
FaultedCommand CheckedExport() {
  FaultedCommand command = Export("export_c", "c");
  command.arguments = [unchecked = command.arguments](const std::string& folder) {
    return Joined(unchecked(folder), {"--check"});
  };
  command.sample = 0;
  return command;
}

/// Those that ask the flight dynamics model.
std::vector<FaultedCommand> ModelCommands() {
  return {
      {"fdm_eval", [](const std::string& folder) { WriteFile(folder + "/points.json", kPoints); },
       [](const std::string& folder) {
         return Arguments{
             "fdm", "eval", "--in", folder + "/points.json", "--out", folder + "/evaluated.json"};
       }},
      {"fdm_simulate",
       [](const std::string& folder) { WriteFile(folder + "/flights.json", kTrajectory); },
       [](const std::string& folder) {
         return Arguments{
             "fdm", "simulate", "--in", folder + "/flights.json", "--out", folder + "/flown.json"};
       }},
      OverGrid("fdm_trim", "trim",
               {{"--json", "trim.json"},
                {"--csv", "trim.csv"},
                {"--picture", "trim.svg"},
                {"--polar", "polar.svg"}}),
      OverGrid("fdm_linearise", "linearise",
               {{"--json", "modes.json"}, {"--picture", "modes.svg"}}),
      OverGrid("fdm_sweep", "sweep", {{"--json", "levels.json"}, {"--picture", "levels.svg"}}),
      {"fdm_fly", [](const std::string& folder) { WriteFile(folder + "/sticks.csv", kSticks); },
       [](const std::string& folder) {
         return Arguments{"fdm",
                          "fly",
                          "--altitude-ft",
                          "15000",
                          "--speed-fps",
                          "500",
                          "--commands",
                          folder + "/sticks.csv",
                          "--seconds",
                          "0.5",
                          "-o",
                          folder + "/flown.csv"};
       }},
      {"aircraft_tune",
       [](const std::string& folder) {
         fs::copy(SKEIN_SOURCE "/data/aerosonde/aircraft.json", folder + "/aerosonde.json");
       },
       [](const std::string& folder) {
         return Arguments{"aircraft", "tune", folder + "/aerosonde.json", "-o",
                          folder + "/tuned.json"};
       },
       0},
  };
}

}  // namespace

std::vector<FaultedCommand> FaultedCommands() {
  const auto nothing = [](const std::string&) {};
  std::vector<FaultedCommand> commands = {
      {"train", nothing, ShortTraining, 3},
      {"resume", BeginRun,
       [](const std::string& folder) {
         return Arguments{"train", "--resume", folder + "/run"};
       },
       2},
      {"eval", CopyPolicy,
       [](const std::string& folder) {
         return ShortFlights({"eval", "--policy", folder + "/heading.skein", "--episodes", "8",
                              "--json", folder + "/eval.json", "--flights", folder + "/flown.csv",
                              "--acmi", folder + "/flown.acmi"});
       }},
      {"compare", CopyPolicy,
       [](const std::string& folder) {
         return ShortFlights({"compare", "--task", "heading", "--agents",
                              "zero,policy:" + folder + "/heading.skein", "--episodes", "8",
                              "--json", folder + "/compared.json", "--csv",
                              folder + "/compared.csv", "--no-html"});
       }},
      {"replay", CopyPolicy,
       [](const std::string& folder) {
         return ShortFlights({"replay", "--policy", folder + "/heading.skein", "--episodes", "2",
                              "-o", folder + "/flown.zip.acmi"});
       }},
      {"plot", BeginRun,
       [](const std::string& folder) {
         return Arguments{"plot", "curves", folder + "/run", "-o", folder + "/curves.svg"};
       }},
      {"report", BeginRun,
       [](const std::string& folder) {
         return Arguments{"report", folder + "/run", "-o", folder + "/report.html"};
       }},
      {"study", [](const std::string& folder) { WriteFile(folder + "/study.toml", kStudy); },
       [](const std::string& folder) {
         return Arguments{"study", folder + "/study.toml", "--out", folder + "/study"};
       },
       2},
      CheckedExport(),
      Export("export_onnx", "onnx"),
      Export("export_safetensors", "safetensors"),
  };
  const std::vector<FaultedCommand> of_model = ModelCommands();
  commands.insert(commands.end(), of_model.begin(), of_model.end());
  return commands;
}

}  // namespace skein
