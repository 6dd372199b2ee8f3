// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "envs/kernels/plant_kernel.h"
#include "simd/peak.h"
#include "simd/target.h"
#include "src/agents/low_level_option.h"
#include "src/bench/machine.h"
#include "src/bench/simulator_rate.h"
#include "src/commands/commands.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/files/output_file.h"
#include "src/run/progress.h"
#include "train/network/backend_module.h"
#include "train/ppo/learner_rates.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

struct BenchOptions {
  int aircraft = 1000000;
  int steps = 30;
  int threads = 0;
  int iterations = 3;
  std::string task = "heading";
  std::string preset = "default";
  std::string low_level;
  std::vector<std::string> assignments;
  std::string json;
};

TrainConfig BenchConfig(const BenchOptions& options) {
  return AsUsage([&] {
    const ProgramConfig config =
        ResolveConfig({options.task, options.preset, "", options.assignments});
    CheckConsistent(config);
    return config.train;
  });
}

/// With the low-level policy that a high-level policy needs.
TrainConfig LearnerBenchConfig(const BenchOptions& options) {
  TrainConfig config = BenchConfig(options);
  config.low_level = ChooseLowLevelPolicy(config.env, options.low_level).policy;
  return config;
}

/// What the environment's step is in a rollout: that of a high-level policy has the low-level
/// policy in it.
const char* NameSimulator(const TrainConfig& config) {
  return config.low_level == nullptr ? "the simulator" : "the simulator and the low-level policy";
}

/// A fixed training of a few seconds: every part of an iteration takes part, at a size that says
/// nothing about quality. From the built-in defaults, so that tuning a preset does not change it.
TrainConfig SignatureConfig() {
  TrainConfig config;
  config.seed = 1;
  config.total_steps = 245760;
  config.env.action_repeat = 5;
  config.env.stagger_clocks = true;
  config.env.time_limit_steps = 400;
  config.ppo.num_aircraft = 512;
  config.ppo.rollout_steps = 32;
  config.ppo.minibatches = 4;
  config.learner.precision = LearnerPrecision::kFloat32;
  config.learner.rollout_tile = 64;
  config.learner.tile_samples = 512;
  config.evaluation.interval_iterations = 0;
  return config;
}

void Report(const BenchOptions& options, int threads, Json results) {
  if (options.json.empty()) return;
  results["threads"] = threads;
  results["machine"] = DescribeMachine();
  WriteJson(options.json, results);
}

std::string ShareOfPeak(double gflops, double peak_gflops, const char* type = "float32") {
  return fmt::format("{:.1f} GFLOP/s, {:.1f} % of the measured peak of {:.1f} GFLOP/s in {}",
                     gflops, 100 * gflops / peak_gflops, peak_gflops, type);
}

Json WithShareOfPeak(Json results, double gflops, double peak_gflops) {
  results["gflops"] = gflops;
  results["peak_gflops"] = peak_gflops;
  results["fraction_of_peak"] = gflops / peak_gflops;
  return results;
}

Json ToJson(const SimulatorRate& rate) {
  return {{"step_ms", 1e3 * rate.step_s}, {"aircraft_steps_per_s", rate.aircraft_steps_per_s}};
}

// NeuralPlane (NeurIPS 2024): one Euler step of 10^6 F-16s without flight control on a GPU.
constexpr double kPaperEulerStepS = 0.2;

void BenchSimulator(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const EnvConfig noisy = BenchConfig(options).env;
  EnvConfig clean = noisy;
  clean.observation_noise = clean.observation_noise_max = 0;
  const simd::PeakRate peak = simd::MeasurePeak(pool.threads());
  const auto plant = [&](PlantPart part) {
    return MeasurePlant(part, options.aircraft, options.steps, pool);
  };
  const auto environment = [&](const EnvConfig& config) {
    return MeasureEnvironment(config, options.aircraft, options.steps, pool);
  };
  const SimulatorRate rk4 = plant(PlantPart::kRk4);
  const SimulatorRate controlled = plant(PlantPart::kFlightControlAndRk4);
  const SimulatorRate whole = environment(clean);
  const double gflops = rk4.aircraft_steps_per_s * kFlopsPerRk4Step / 1e9;
  fmt::print("simulator: {} aircraft, {} control steps, {} threads, {}\n", options.aircraft,
             options.steps, pool.threads(), Name(simd::ActiveTarget()));
  const auto line = [](const char* what, const SimulatorRate& rate, const std::string& note) {
    fmt::print("  {:<38}  {:9.2f} ms a step, {} aircraft-steps/s{}\n", what, 1e3 * rate.step_s,
               FormatCount(rate.aircraft_steps_per_s), note);
  };
  line("F-16: RK4 with engine", rk4, " (" + ShareOfPeak(gflops, peak.gflops) + ")");
  line("F-16: ... with flight control, actuators", controlled, "");
  line("the whole environment, without noise", whole, "");
  Json results{{"aircraft", options.aircraft},
               {"steps", options.steps},
               {"rk4", ToJson(rk4)},
               {"plant", ToJson(controlled)},
               {"environment", ToJson(whole)}};
  if (noisy.observation_noise > 0 || noisy.observation_noise_max > 0) {
    const SimulatorRate with_noise = environment(noisy);
    line("the whole environment, with noise", with_noise,
         fmt::format(" ({:+.0f} %)", 100 * (with_noise.step_s / whole.step_s - 1)));
    results["environment_with_noise"] = ToJson(with_noise);
  }
  fmt::print("  (the paper's GPU: {:.0f} ms for an Euler step of 10^6 without flight control)\n",
             1e3 * kPaperEulerStepS);
  Report(options, pool.threads(), WithShareOfPeak(results, gflops, peak.gflops));
}

/// What learner benchmarks compare: the fused kernels in the configuration's precision first, in
/// every other one that this processor knows, and LibTorch, if it is there, in tiles that suit it.
std::vector<TrainConfig> LearnersOf(const TrainConfig& config) {
  // LibTorch's best sizes: each of its operations walks through a whole tile.
  constexpr int kLibTorchTileSamples = 4096, kLibTorchRolloutTile = 512;
  std::vector<TrainConfig> learners{config};
  std::vector<LearnerPrecision> precisions{LearnerPrecision::kFloat32};
  if (simd::NativeBfloat16()) {
    precisions = {LearnerPrecision::kFloat32, LearnerPrecision::kMixed, LearnerPrecision::kBfloat16,
                  LearnerPrecision::kFast};
  }
  LearnerPrecision own = config.learner.precision;
  if (own == LearnerPrecision::kAuto) own = DefaultPrecision();
  for (const LearnerPrecision precision : precisions) {
    if (precision == own) continue;
    learners.push_back(config);
    learners.back().learner.precision = precision;
  }
  if (config.learner.backend == Backend::kLibTorch) return {config};
  if (LibTorchVersion().empty()) return learners;
  learners.push_back(config);
  learners.back().learner.backend = Backend::kLibTorch;
  learners.back().learner.tile_samples = kLibTorchTileSamples;
  learners.back().learner.rollout_tile = kLibTorchRolloutTile;
  return learners;
}

std::string ShortName(const BackendChoice& backend) {
  if (backend.backend == Backend::kLibTorch) return "LibTorch";
  return std::string("fused, ") + Name(backend.precision);
}

/// One rate of several learners, the last of them LibTorch's if it is there.
struct Comparison {
  const char* unit;  ///< what is counted, for people
  const char* key;   ///< of the rate in files
  double LearnerRates::*rate;
  double LearnerRates::*flops;
};

/// Prints a line for each learner, and gives the first one's figures with all of them as
/// "learners".
Json Compare(const std::vector<LearnerRates>& learners, const Comparison& comparison) {
  const bool has_reference = learners.back().backend.backend == Backend::kLibTorch;
  const double reference = learners.back().*comparison.rate;
  auto all = Json::array();
  for (const LearnerRates& rates : learners) {
    const double rate = rates.*comparison.rate;
    const double gflops = rate * (rates.*comparison.flops) / 1e9;
    // The other precisions have products in float32, too.
    const bool is_bfloat16 =
        rates.backend.precision == LearnerPrecision::kBfloat16 && simd::NativeBfloat16();
    fmt::print("  {:<14} {:>6} {}/s  {}({})\n", ShortName(rates.backend), FormatCount(rate),
               comparison.unit,
               has_reference ? fmt::format("{:5.2f} x LibTorch  ", rate / reference) : "",
               ShareOfPeak(gflops, rates.peak_gflops, is_bfloat16 ? "bfloat16" : "float32"));
    all.push_back(
        WithShareOfPeak({{"backend", Name(rates.backend.backend)},
                         {"precision", Name(rates.backend.precision)},
                         {comparison.key, rate},
                         {"times_libtorch", has_reference ? Json(rate / reference) : Json()}},
                        gflops, rates.peak_gflops));
  }
  Json results = all[0];
  results["learners"] = all;
  return results;
}

void BenchRollout(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const TrainConfig config = LearnerBenchConfig(options);
  const std::vector<LearnerRates> learners =
      MeasureLearners(LearnersOf(config), options.iterations, pool);
  fmt::print("rollout: {} aircraft, {} threads; {}\n", config.ppo.num_aircraft, pool.threads(),
             Describe(learners[0].backend));
  Json results = Compare(
      learners, {"policy steps", "policy_steps_per_s", &LearnerRates::rollout_policy_steps_per_s,
                 &LearnerRates::rollout_flops_per_policy_step});
  const double control_steps = learners[0].rollout_policy_steps_per_s * config.env.action_repeat;
  fmt::print("  {} control steps/s with the first; {} takes {:.0f} % of its time\n",
             FormatCount(control_steps), NameSimulator(config), 100 * learners[0].simulator_share);
  results["control_steps_per_s"] = control_steps;
  results["simulator_share"] = learners[0].simulator_share;
  Report(options, pool.threads(), results);
}

void BenchUpdate(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const TrainConfig config = LearnerBenchConfig(options);
  const std::vector<LearnerRates> learners =
      MeasureLearners(LearnersOf(config), options.iterations, pool);
  fmt::print("update: {} threads; {}\n", pool.threads(), Describe(learners[0].backend));
  Report(options, pool.threads(),
         Compare(learners, {"samples", "samples_per_s", &LearnerRates::update_samples_per_s,
                            &LearnerRates::update_flops_per_sample}));
}

double PeakMemoryGb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e9;
}

void BenchIteration(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const TrainConfig config = LearnerBenchConfig(options);
  const LearnerRates rates = MeasureLearners({config}, options.iterations, pool)[0];
  const double steps = static_cast<double>(config.ppo.num_aircraft) * config.ppo.rollout_steps *
                       config.env.action_repeat;
  const double steps_per_s = steps / rates.iteration_s;
  const double hours = static_cast<double>(config.total_steps) / steps_per_s / 3600;
  fmt::print(
      "iteration: {} aircraft x {} policy steps, {} epochs, {} threads; {}\n"
      "  {:.2f} s an iteration, {} control steps/s\n"
      "  rollout {} policy steps/s ({} {:.0f} % of it), gradients {} samples/s\n"
      "  these two alone would take {:.1f} % of the time; {:.2f} GB of memory at most\n"
      "  {} control steps would take {:.2f} h\n",
      config.ppo.num_aircraft, config.ppo.rollout_steps, config.ppo.epochs, pool.threads(),
      Describe(rates.backend), rates.iteration_s, FormatCount(steps_per_s),
      FormatCount(rates.rollout_policy_steps_per_s), NameSimulator(config),
      100 * rates.simulator_share, FormatCount(rates.gradient_samples_per_s),
      100 * rates.efficiency, PeakMemoryGb(), FormatCount(static_cast<double>(config.total_steps)),
      hours);
  Report(options, pool.threads(),
         {{"backend", Name(rates.backend.backend)},
          {"precision", Name(rates.backend.precision)},
          {"iteration_s", rates.iteration_s},
          {"control_steps_per_s", steps_per_s},
          {"policy_steps_per_s", rates.rollout_policy_steps_per_s},
          {"simulator_share", rates.simulator_share},
          {"gradient_samples_per_s", rates.gradient_samples_per_s},
          {"efficiency", rates.efficiency},
          {"memory_gb", PeakMemoryGb()},
          {"budget_steps", config.total_steps},
          {"budget_h", hours}});
}

void BenchSignature(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  Trainer trainer(SignatureConfig(), pool);
  while (!trainer.finished()) trainer.Iterate();
  const std::string signature = fmt::format("{:016x}", trainer.Signature());
  fmt::print("{}\n", signature);
  Report(options, pool.threads(), {{"signature", signature}, {"iterations", trainer.iteration()}});
}

CLI::App* AddBench(CLI::App* bench, const std::string& name, const std::string& description,
                   const std::shared_ptr<BenchOptions>& options, void (*run)(const BenchOptions&)) {
  CLI::App* command = bench->add_subcommand(name, description);
  command->add_option("--threads", options->threads, "worker threads (default: one per CPU)")
      ->transform(WholeNumber(1, 1024));
  command->add_option("--json", options->json, "also write the figures here")->type_name("FILE");
  command->callback([options, run] { run(*options); });
  return command;
}

void AddConfiguration(CLI::App* command, const std::shared_ptr<BenchOptions>& options) {
  command->add_option("--preset", options->preset, "preset of the task")
      ->type_name("PRESET")
      ->capture_default_str();
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
  sim->add_option("--aircraft", options->aircraft, "aircraft stepped at once")
      ->transform(WholeNumber(1, 100000000))
      ->capture_default_str();
  sim->add_option("--steps", options->steps, "control steps timed; the median counts")
      ->transform(WholeNumber(1, 1000000))
      ->capture_default_str();
  AddConfiguration(sim, options);
  sim->footer(
      "Trimmed F-16s through one RK4 step of 0.02 s, without and with flight control; then the "
      "whole\n"
      "environment (observe, step, reward, terminate, reset) at 50 Hz under random actions, "
      "without\n"
      "and with observation noise.\n"
      "Example: skein bench sim --aircraft 1000000 --steps 30 --threads 2");
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
