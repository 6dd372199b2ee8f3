#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "simd/peak.h"
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
  const ProgramConfig config =
      ResolveConfig({"heading", options.preset, "", options.assignments});
  CheckConsistent(config);
  return config.train;
}

/// A fixed training of a few seconds: every part of an iteration takes part, at a size that says
/// nothing about quality.
TrainConfig SignatureConfig() {
  return ResolveConfig({"heading",
                        "default",
                        "",
                        {"run.seed=1", "run.total_steps=245760", "env.time_limit_steps=400",
                         "ppo.num_aircraft=512", "ppo.rollout_steps=32", "ppo.minibatches=4",
                         "learner.rollout_tile=64", "learner.tile_samples=512",
                         "evaluation.interval_iterations=0"}})
      .train;
}

void Report(const BenchOptions& options, Json results, int threads) {
  if (options.json.empty()) return;
  results["threads"] = threads;
  results["machine"] = DescribeMachine();
  WriteFile(options.json, results.dump(1) + "\n");
}

simd::PeakRate Peak(const WorkerPool& pool) { return simd::MeasurePeak(pool.threads()); }

std::string OfPeak(double gflops, double peak_gflops) {
  return fmt::format("{:.1f} GFLOP/s, {:.1f} % of the measured peak of {:.1f}", gflops,
                     100 * gflops / peak_gflops, peak_gflops);
}

void BenchSimulator(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const SimulatorRate plant = MeasurePlant(options.aircraft, options.steps, pool);
  const SimulatorRate environment =
      MeasureEnvironment(EnvConfig{}, options.aircraft, options.steps, pool);
  fmt::print(
      "simulator: {} aircraft, {} control steps, {} threads\n"
      "  flight control, actuators, engine, RK4: {:.2f} ms a step, {}aircraft-steps/s\n"
      "  whole environment (observe to reset):   {:.2f} ms a step, {}aircraft-steps/s\n",
      options.aircraft, options.steps, pool.threads(), 1e3 * plant.step_s,
      FormatCount(plant.aircraft_steps_per_s), 1e3 * environment.step_s,
      FormatCount(environment.aircraft_steps_per_s));
}

}  // namespace
}  // namespace skein
