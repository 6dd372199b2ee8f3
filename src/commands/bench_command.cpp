// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <memory>

#include "src/commands/aircraft_option.h"
#include "src/commands/benchmarks.h"
#include "src/commands/commands.h"
#include "src/config/conditions.h"
#include "src/config/whole_number.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

CLI::App* AddBench(CLI::App* bench, const std::string& name, const std::string& description,
                   const std::shared_ptr<BenchOptions>& options, void (*run)(const BenchOptions&)) {
  CLI::App* command = bench->add_subcommand(name, description);
  command->add_option("--threads", options->threads, "worker threads (default: one per CPU)")
      ->transform(WholeNumber(1, 1024));
  command->add_option("--json", options->json, "also write the figures here")->type_name("FILE");
  command->callback([options, run] {
    CheckWritable(options->json);
    run(*options);
  });
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
  command->add_option("--task", options->task, "what is flown")
      ->type_name("TASK")
      ->capture_default_str();
  command
      ->add_option("--low-level", options->low_level,
                   "for task tracking: the low-level policy, as of skein train")
      ->type_name("RUN_OR_POLICY");
  AddConfiguration(command, options);
  return command;
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
  sim->add_option("--steps", options->steps, "control steps timed; the median counts")
      ->transform(WholeNumber(1, 1000000))
      ->capture_default_str();
  AddConfiguration(sim, options);
  sim->footer(
      "Trimmed F-16s through one RK4 step of 0.02 s, without and with flight control; then the "
      "whole\n"
      "environment (observe, step, reward, terminate, reset) at 50 Hz under random actions, "
      "without\n"
      "and with observation noise, of the aircraft that is asked for. Environments of drawn plants "
      "take turns with nominal ones.\n"
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
  AddLearner(bench, "iteration", "Whole iterations, and the time that the budget would take",
             options, BenchIteration)
      ->footer(
          "How much of an iteration rollout and gradients take: the rest is optimiser, advantages\n"
          "and what else lies between.\n"
          "Examples:\n"
          "  skein bench iteration --preset paper --set ppo.rollout_steps=96\n"
          "  skein bench iteration --task tracking --preset planner --low-level "
          "policies/control.skein");
  AddBench(bench, "signature", "One hash of a fixed short training", options, BenchSignature)
      ->footer(
          "The same for any number of threads on one SIMD target: a change of the hash is a change "
          "of\nresults.");
}

}  // namespace skein
