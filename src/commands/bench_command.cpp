// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "src/commands/aircraft_option.h"
#include "src/commands/benchmarks.h"
#include "src/commands/commands.h"
#include "src/commands/launched_ranks.h"
#include "src/commands/threads_option.h"
#include "src/config/conditions.h"
#include "src/config/whole_number.h"
#include "src/files/output_file.h"
#include "train/ranks/rank_module.h"

namespace skein {
namespace {

CLI::App* AddAny(CLI::App* bench, const std::string& name, const std::string& description,
                 const std::shared_ptr<BenchOptions>& options, void (*run)(const BenchOptions&)) {
  CLI::App* command = bench->add_subcommand(name, description);
  command->add_option("--json", options->json, "also write the figures here")->type_name("FILE");
  command->callback([options, run] {
    // Of several processes one alone writes: the benchmark sees to it.
    if (LaunchedProcesses() == 1) CheckWritable({options->json}, FilesRead(*options));
    RequireEnding(options->json, ".json", "--json writes JSON");
    run(*options);
  });
  return command;
}

CLI::App* AddBench(CLI::App* bench, const std::string& name, const std::string& description,
                   const std::shared_ptr<BenchOptions>& options, void (*run)(const BenchOptions&)) {
  CLI::App* command = AddAny(bench, name, description, options, run);
  AddThreadsOption(command, &options->threads)
      ->description("worker threads (default: one for each CPU it may use)");
  return command;
}

/// Refuses counts, which --aircraft of `skein bench sim` once was.
CLI::Validator IsNoCount() {
  return {[](const std::string& aircraft) -> std::string {
            if (!ReadNumber(aircraft)) return "";
            return aircraft + " is no aircraft: how many are stepped at once is --num-aircraft";
          },
          ""};
}

void AddConfiguration(CLI::App* command, const std::shared_ptr<BenchOptions>& options) {
  command->add_option("--preset", options->preset, "preset of the task")
      ->type_name("PRESET")
      ->capture_default_str();
  AddAircraftOption(command, &options->aircraft)->check(IsNoCount());
  command->add_option("--condition", options->conditions, ConditionHelp())
      ->type_name("NAME=LEVEL")
      ->allow_extra_args(false);
  command->add_option("--set", options->assignments, "one configuration key; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

CLI::App* AddLearner(CLI::App* bench, const std::string& name, const std::string& description,
                     const std::shared_ptr<BenchOptions>& options,
                     void (*run)(const BenchOptions&)) {
  CLI::App* command = AddBench(bench, name, description, options, run);
  command->add_option("--iterations", options->iterations, "iterations timed; the median counts")
      ->transform(WholeNumber(1, 1000))
      ->capture_default_str();
  command->add_option("--task", options->task, "what is flown, or a task file, FILE.toml")
      ->type_name("TASK")
      ->capture_default_str();
  command
      ->add_option("--low-level", options->low_level,
                   "for task tracking: the low-level policy, as of skein train")
      ->type_name("RUN_OR_POLICY");
  AddConfiguration(command, options);
  return command;
}

void AddScaling(CLI::App* bench, const std::shared_ptr<BenchOptions>& options) {
  CLI::App* command =
      AddLearner(bench, "scaling", "Iterations on ranks x threads that use all processors", options,
                 BenchScaling);
  command->get_option("--threads")->description("processors used in all (default: all)");
  command
      ->add_option("--launcher", options->launcher,
                   "what starts ranks: these words, -n and how many")
      ->type_name("WORDS")
      ->capture_default_str();
  command->footer(
      "Starts skein bench iteration with one process, and by the launcher with as many ranks as "
      "powers of\n"
      "two divide the processors; learner.shards, unless set, is the largest of them.\n"
      "Example: skein bench scaling --launcher \"mpirun --map-by socket --bind-to socket\"");
}

void AddCompare(CLI::App* bench, const std::shared_ptr<BenchOptions>& options) {
  CLI::App* command =
      AddAny(bench, "compare", "What changed between runs of a benchmark, and what is beyond noise",
             options, CompareBenchmarkFiles);
  command
      ->add_option("before", options->before,
                   "what a benchmark wrote with --json; of several runs FILE,FILE,...")
      ->type_name("BEFORE")
      ->required();
  command->add_option("after", options->after, "as many of the other build")
      ->type_name("AFTER")
      ->required();
  command->add_flag("--other-machine", options->other_machine,
                    "compare runs of another processor, SIMD target or number of threads, too");
  command->footer(
      "Ratios, after / before, with 95 % intervals. Run both builds in turns, several times: with "
      "one\n"
      "run each, the intervals leave out run-to-run variation.\n"
      "Example: skein bench compare old.1.json,old.2.json,old.3.json "
      "new.1.json,new.2.json,new.3.json");
}

}  // namespace

void AddBenchCommand(CLI::App* app) {
  CLI::App* bench = app->add_subcommand("bench", "Measure speed, or print the signature");
  bench->require_subcommand(1);
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* sim =
      AddBench(bench, "sim", "Aircraft-steps per second of the simulator", options, BenchSimulator);
  sim->add_option("--num-aircraft", options->num_aircraft, "aircraft stepped at once")
      ->transform(WholeNumber(1, 100000000))
      ->capture_default_str();
  sim->add_option("--task", options->task, "what is flown, or a task file, FILE.toml")
      ->type_name("TASK")
      ->capture_default_str();
  sim->add_option("--beside", options->beside,
                  "measure the environment of this task, too, in turns with the other")
      ->type_name("TASK");
  sim->add_option("--steps", options->steps, "steps timed; the median counts")
      ->transform(WholeNumber(1, 1000000))
      ->capture_default_str();
  sim->add_option(
         "--action-repeat", options->action_repeat,
         "control steps for which an environment holds an action; from 2 on beside one that "
         "does not")
      ->transform(WholeNumber(1, 1000))
      ->capture_default_str();
  AddConfiguration(sim, options);
  sim->footer(
      "Trimmed F-16s through one RK4 step of 0.02 s, without and with flight control; then the "
      "whole\n"
      "environment (observe, step, reward, terminate, reset) under random actions, without and "
      "with\n"
      "observation noise, of the aircraft that is asked for: times are of a control step. "
      "Environments\n"
      "of drawn plants take turns with nominal ones.\n"
      "Examples:\n"
      "  skein bench sim --num-aircraft 1000000 --steps 30 --threads 2\n"
      "  skein bench sim --num-aircraft 4096 --steps 2000 --condition plant=middle");
  AddLearner(bench, "rollout", "Policy steps per second of policy and simulator together", options,
             BenchRollout)
      ->footer(
          "The fused kernels beside LibTorch, iteration by iteration in turns; medians.\n"
          "Example: skein bench rollout --set learner.rollout_tile=128");
  AddLearner(bench, "update", "Samples per second through forward, loss, backward and optimiser",
             options, BenchUpdate)
      ->footer(
          "The fused kernels beside LibTorch, iteration by iteration in turns; medians. Where the\n"
          "processor multiplies bfloat16, every precision.\n"
          "Example: skein bench update --set learner.precision=bf16");
  CLI::App* iteration =
      AddLearner(bench, "iteration", "Whole iterations, and the time that the budget would take",
                 options, BenchIteration);
  AddRankTimeoutOption(iteration, &options->rank_timeout_s);
  iteration->footer(
      "How much of an iteration rollout and gradients take: the rest is optimiser, advantages\n"
      "and what else lies between. Under mpirun processes train together.\n"
      "Examples:\n"
      "  skein bench iteration --preset paper --set ppo.rollout_steps=96\n"
      "  skein bench iteration --task tracking --preset planner --low-level "
      "policies/control.skein\n"
      "  mpirun -np 2 --bind-to none skein bench iteration --threads 8");
  AddScaling(bench, options);
  AddCompare(bench, options);
  AddBench(bench, "signature", "One hash of a fixed short training", options, BenchSignature)
      ->footer(
          "The same for any number of threads on one SIMD target: a change of the hash is a change "
          "of\nresults.");
}

}  // namespace skein
