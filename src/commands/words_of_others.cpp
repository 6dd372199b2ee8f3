// SPDX-License-Identifier: Apache-2.0
#include "src/commands/words_of_others.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "base/ends_with.h"
#include "src/commands/command_tree.h"
#include "src/config/other_names.h"
#include "src/config/presets.h"

namespace skein {
namespace {

struct OptionElsewhere {
  const char* names;  ///< as keys are written, blanks between
  const char* own;    ///< the option or argument of the command that stands for it; "" if any does
  const char* words;  ///< {} is the option as it was typed; "" is "did you mean ...?"
};

constexpr char kPolicies[] =
    "model model_path checkpoint checkpoint_path ckpt load load_run load_path weights";
constexpr char kProcessors[] = "device device_id gpu gpus cuda cpu sim_device rl_device";
constexpr char kTasks[] = "env env_id env_name gym_id";

// Of several rows with a name the first counts whose option the command has.
constexpr OptionElsewhere kOptions[] = {
    {"exp_name experiment_name run_name name log_dir logdir output output_dir save_dir save_path o",
     "--out", ""},
    {kPolicies, "--policy", ""},
    {kPolicies, "--agents", "; did you mean --agents policy:FILE_OR_RUN?"},
    {kPolicies, "--from", "; --from starts from a policy, and --resume goes on with a run"},
    {"policy pretrained init", "--from", ""},
    {"policy policies", "--agents", "; did you mean --agents policy:FILE_OR_RUN?"},
    {"policies", "--policy", ""},
    {"agents", "--policy", "; it flies one --policy, and skein compare several agents"},
    {"controller", "--low-level", "; it is now called --low-level"},
    {"n_eval_episodes eval_episodes num_episodes", "--episodes", ""},
    {"num_threads n_threads num_workers workers num_cpus cpus n_jobs", "--threads", ""},
    {kProcessors, "--threads", "; Skein computes on the CPU, with --threads threads"},
    {kProcessors, "", "; Skein computes on the CPU"},
    {kTasks, "task", "; the task is written alone, without {}"},
    {kTasks, "--task", ""},
    {"wandb wandb_entity wandb_project wandb_project_name logger track tensorboard "
     "tensorboard_log",
     "--resume", "; every run writes TensorBoard's events and metrics.csv"},
    {"algo algorithm", "--resume", "; Skein trains by PPO"},
    {"headless render video capture_video", "",
     "; Skein opens no window; skein replay and skein plot show flights"},
    {"port", "--live", ""},
    {"alt", "--altitude-ft", ""},
    {"airspeed tas velocity", "--speed-fps", ""},
    {"gamma fpa climb_angle", "--flight-path-deg", ""},
    {"duration time", "--seconds", ""},
    {"dt", "--step-s", ""},
    {"sticks", "--commands", ""}};

struct CommandElsewhere {
  const char* names;
  const char* own;
};

constexpr CommandElsewhere kCommands[] = {{"evaluate play enjoy test", "eval"},
                                          {"learn fit", "train"},
                                          {"version", "--version"},
                                          {"benchmark profile", "bench"}};

constexpr std::pair<const char*, const char*> kUnits[] = {
    {"-ft-s2", "ft/s2"}, {"-deg-s", "deg/s"}, {"-fps", "ft/s"}, {"-ft", "ft"}, {"-deg", "deg"}};

}  // namespace

std::string OptionMeantElsewhere(const CLI::App& command, const std::string& option) {
  const std::string name = WrittenAsKey(option);
  for (const OptionElsewhere& row : kOptions) {
    if (!IsAmong(name, row.names) || !(*row.own == '\0' || HasOption(command, row.own))) continue;
    if (*row.words != '\0') return fmt::format(fmt::runtime(row.words), option);
    return DidYouMeanOption(option, row.own);
  }
  return "";
}

std::string CommandMeantElsewhere(const std::string& command) {
  const std::vector<std::string> tasks = PresetTasks();
  if (std::count(tasks.begin(), tasks.end(), command) > 0) {
    return fmt::format("; did you mean train {}?", command);
  }
  for (const CommandElsewhere& row : kCommands) {
    if (IsAmong(command, row.names)) return fmt::format("; did you mean {}?", row.own);
  }
  return "";
}

std::string DidYouMeanOption(const std::string& typed, const std::string& option) {
  const auto* const unit =
      std::find_if(std::begin(kUnits), std::end(kUnits),
                   [&option](const auto& known) { return EndsWith(option, known.first); });
  const bool is_said = unit == std::end(kUnits) || EndsWith(typed, unit->first);
  return fmt::format("; did you mean {}{}?", option,
                     is_said ? "" : fmt::format(" (in {})", unit->second));
}

bool IsInUnitOf(const std::string& option, const std::string& typed) {
  return std::any_of(std::begin(kUnits), std::end(kUnits),
                     [&](const auto& unit) { return option == typed + unit.first; });
}

}  // namespace skein
