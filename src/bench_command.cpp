#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "envs/dynamics/plant_kernel.h"
#include "simd/peak.h"
#include "simd/target.h"
#include "src/commands.h"
#include "src/configuration.h"
#include "src/machine.h"
#include "src/output_file.h"
#include "src/progress.h"
#include "src/simulator_rate.h"
#include "train/trainer.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

struct BenchOptions {
  int aircraft = 1000000;
  int steps = 30;
  int threads = 0;
  std::string preset = "default";
  std::vector<std::string> assignments;
  std::string json;
};

TrainConfig BenchConfig(const BenchOptions& options) {
  const ProgramConfig config = ResolveConfig({"heading", options.preset, "", options.assignments});
  CheckConsistent(config);
  return config.train;
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
  config.learner.rollout_tile = 64;
  config.learner.tile_samples = 512;
  config.evaluation.interval_iterations = 0;
  return config;
}

void Report(const BenchOptions& options, int threads, Json results) {
  if (options.json.empty()) return;
  results["threads"] = threads;
  results["machine"] = DescribeMachine();
  WriteFile(options.json, results.dump(1) + "\n");
}

std::string ShareOfPeak(double gflops, double peak_gflops) {
  return fmt::format("{:.1f} GFLOP/s, {:.1f} % of the measured peak of {:.1f} GFLOP/s", gflops,
                     100 * gflops / peak_gflops, peak_gflops);
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
  clean.observation_noise = 0;
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
  line("RK4 with engine", rk4, " (" + ShareOfPeak(gflops, peak.gflops) + ")");
  line("flight control, actuators, engine, RK4", controlled, "");
  line("the whole environment, without noise", whole, "");
  Json results{{"aircraft", options.aircraft},
               {"steps", options.steps},
               {"rk4", ToJson(rk4)},
               {"plant", ToJson(controlled)},
               {"environment", ToJson(whole)}};
  if (noisy.observation_noise > 0) {
    const SimulatorRate with_noise = environment(noisy);
    line("the whole environment, with noise", with_noise,
         fmt::format(" (+{:.0f} %)", 100 * (with_noise.step_s / whole.step_s - 1)));
    results["environment_with_noise"] = ToJson(with_noise);
  }
  fmt::print("  (the paper's GPU: {:.0f} ms for an Euler step of 10^6 without flight control)\n",
             1e3 * kPaperEulerStepS);
  Report(options, pool.threads(), WithShareOfPeak(results, gflops, peak.gflops));
}

void BenchRollout(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const TrainConfig config = BenchConfig(options);
  const simd::PeakRate peak = simd::MeasurePeak(pool.threads());
  const LearnerRates rates = MeasureLearner(config, pool);
  const double control_steps_per_s = rates.rollout_decisions_per_s * config.env.action_repeat;
  const double gflops = rates.rollout_decisions_per_s * rates.rollout_flops_per_decision / 1e9;
  fmt::print("rollout: {} aircraft, {} threads: {} decisions/s, {} control steps/s ({}); {}\n",
             config.ppo.num_aircraft, pool.threads(), FormatCount(rates.rollout_decisions_per_s),
             FormatCount(control_steps_per_s), ShareOfPeak(gflops, peak.gflops),
             Describe(rates.backend));
  Report(options, pool.threads(),
         WithShareOfPeak({{"backend", Name(rates.backend.backend)},
                          {"decisions_per_s", rates.rollout_decisions_per_s},
                          {"control_steps_per_s", control_steps_per_s},
                          {"flops_per_decision", rates.rollout_flops_per_decision}},
                         gflops, peak.gflops));
}

void BenchUpdate(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const TrainConfig config = BenchConfig(options);
  const simd::PeakRate peak = simd::MeasurePeak(pool.threads());
  const LearnerRates rates = MeasureLearner(config, pool);
  const double gflops = rates.update_samples_per_s * rates.update_flops_per_sample / 1e9;
  fmt::print("update: {} threads: {} samples/s ({}); {}\n", pool.threads(),
             FormatCount(rates.update_samples_per_s), ShareOfPeak(gflops, peak.gflops),
             Describe(rates.backend));
  Report(options, pool.threads(),
         WithShareOfPeak({{"backend", Name(rates.backend.backend)},
                          {"samples_per_s", rates.update_samples_per_s},
                          {"flops_per_sample", rates.update_flops_per_sample}},
                         gflops, peak.gflops));
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
      ->check(CLI::Range(1, 1024));
  command->add_option("--json", options->json, "also write the figures here")->type_name("FILE");
  command->callback([options, run] { run(*options); });
  return command;
}

void AddConfiguration(CLI::App* command, const std::shared_ptr<BenchOptions>& options) {
  command->add_option("--preset", options->preset, "preset of task heading")->capture_default_str();
  command->add_option("--set", options->assignments, "one configuration key; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

}  // namespace

void AddBenchCommand(CLI::App* app) {
  CLI::App* bench = app->add_subcommand("bench", "Measure speed, or print the signature");
  bench->require_subcommand(1);
  const auto options = std::make_shared<BenchOptions>();
  CLI::App* sim =
      AddBench(bench, "sim", "Aircraft-steps per second of the simulator", options, BenchSimulator);
  sim->add_option("--aircraft", options->aircraft, "aircraft stepped at once")
      ->check(CLI::Range(1, 100000000))
      ->capture_default_str();
  sim->add_option("--steps", options->steps, "control steps timed; the median counts")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  AddConfiguration(sim, options);
  sim->footer(
      "Trimmed F-16s through one RK4 step of 0.02 s, without and with flight control; then the "
      "whole\n"
      "environment (observe, step, reward, terminate, reset) at 50 Hz under random actions, "
      "without\n"
      "and with observation noise.\n"
      "Example: skein bench sim --aircraft 1000000 --steps 30 --threads 2");
  AddConfiguration(
      AddBench(bench, "rollout", "Decisions per second of policy and simulator together", options,
               BenchRollout),
      options);
  AddConfiguration(
      AddBench(bench, "update", "Samples per second through forward, loss, backward and optimiser",
               options, BenchUpdate),
      options);
  AddBench(bench, "signature", "One hash of a fixed short training", options, BenchSignature)
      ->footer(
          "The same for any number of threads on one SIMD target: a change of the hash is a change "
          "of\nresults.");
}

}  // namespace skein
