// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "envs/kernels/plant_kernel.h"
#include "simd/peak.h"
#include "simd/target.h"
#include "src/bench/simulator_rate.h"
#include "src/commands/benchmarks.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/files/text_table.h"
#include "src/run/progress.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const SimulatorRate& rate) {
  return {{"step_ms", 1e3 * rate.step_s}, {"aircraft_steps_per_s", rate.aircraft_steps_per_s}};
}

// NeuralPlane (NeurIPS 2024): one Euler step of 10^6 F-16s without flight control on a GPU.
constexpr double kPaperEulerStepS = 0.2;

/// What is measured in turns with an environment, so that they can be compared.
struct Beside {
  std::string key;   ///< appended to the environment's
  std::string what;  ///< for people
  EnvConfig config;
};

/// The task that was asked for; else the same environment of nominal plants, if its own are drawn,
/// and with an action every control step, if its own are held.
std::vector<Beside> Others(const EnvConfig& config, const BenchOptions& options) {
  if (!options.beside.empty()) {
    BenchOptions other = options;
    other.task = options.beside;
    EnvConfig beside = BenchConfig(other).env;
    beside.action_repeat = config.action_repeat;
    beside.observation_noise = config.observation_noise;
    beside.observation_noise_max = config.observation_noise_max;
    beside.training_noise_max = config.training_noise_max;
    return {{"beside", "of " + options.beside, beside}};
  }
  std::vector<Beside> others;
  if (config.plant.enabled()) {
    others.push_back({"of_nominal_plants", "of nominal plants", config});
    others.back().config.plant = {};
  }
  if (config.action_repeat > 1) {
    others.push_back({"unheld", "with an action every control step", config});
    others.back().config.action_repeat = 1;
  }
  return others;
}

void PrintRate(const std::string& what, const SimulatorRate& rate, const std::string& note = "") {
  fmt::print("  {:<40}  {:9.2f} ms a step, {} aircraft-steps/s{}\n", what, 1e3 * rate.step_s,
             FormatCount(rate.aircraft_steps_per_s), note);
}

std::string Beyond(const SimulatorRate& rate, const SimulatorRate& base) {
  return fmt::format("{:+.0f} %", 100 * (rate.step_s / base.step_s - 1));
}

/// Puts the rate called `key` into the results.
void Keep(const std::string& key, const SimulatorRate& rate, BenchResults& results) {
  results.other[key] = ToJson(rate);
  std::vector<double> milliseconds;
  for (const double seconds : rate.seconds) milliseconds.push_back(1e3 * seconds);
  results.figures.push_back({key + "_step_ms", false, milliseconds});
}

/// Measures, prints and keeps the environment as `key`, with the others behind it. Beside `quiet`,
/// if that is there, the line says how much more it takes.
SimulatorRate ReportEnvironment(const std::string& what, const std::string& key,
                                const EnvConfig& config, const SimulatorRate* quiet,
                                const BenchOptions& options, WorkerPool& pool,
                                BenchResults& results) {
  const std::vector<Beside> others = Others(config, options);
  std::vector<EnvConfig> configs{config};
  for (const Beside& other : others) configs.push_back(other.config);
  const std::vector<SimulatorRate> rates =
      MeasureEnvironments(configs, options.num_aircraft, options.steps, pool);
  PrintRate(what, rates[0], quiet == nullptr ? "" : " (" + Beyond(rates[0], *quiet) + ")");
  Keep(key, rates[0], results);
  for (std::size_t k = 0; k < others.size(); ++k) {
    PrintRate("... " + others[k].what, rates[k + 1],
              " (the one above: " + Beyond(rates[0], rates[k + 1]) + ")");
    Keep(key + "_" + others[k].key, rates[k + 1], results);
  }
  return rates[0];
}

/// Which --action-repeat, or its default, would take the place of.
void RequireNoActionRepeat(const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) {
    if (KeyOf(assignment) != "env.action_repeat") continue;
    throw UsageError(fmt::format("--set {}: here that is --action-repeat", assignment));
  }
}

}  // namespace

void BenchSimulator(const BenchOptions& options) {
  RequireNoActionRepeat(options.assignments);
  WorkerPool pool(options.threads);
  EnvConfig noisy = BenchConfig(options).env;
  noisy.action_repeat = options.action_repeat;
  EnvConfig clean = noisy;
  clean.observation_noise = clean.observation_noise_max = 0;
  const simd::PeakRate peak = simd::MeasurePeak(pool.threads());
  const auto plant = [&](PlantPart part) {
    return MeasurePlant(part, options.num_aircraft, options.steps, pool);
  };
  const SimulatorRate rk4 = plant(PlantPart::kRk4);
  const SimulatorRate controlled = plant(PlantPart::kFlightControlAndRk4);
  const double gflops = rk4.aircraft_steps_per_s * kFlopsPerRk4Step / 1e9;
  fmt::print("simulator: {} aircraft, {}, {}, {}\n", options.num_aircraft,
             Counted(options.steps, "step"), Counted(pool.threads(), "thread"),
             Name(simd::ActiveTarget()));
  PrintRate("F-16: RK4 with engine", rk4, " (" + ShareOfPeak(gflops, peak.gflops) + ")");
  PrintRate("F-16: ... with flight control, actuators", controlled);
  BenchResults results{"sim", pool.threads(), {}, {}, noisy.task_file_hash};
  results.other = {{"aircraft", options.num_aircraft},
                   {"steps", options.steps},
                   {"action_repeat", options.action_repeat}};
  Keep("rk4", rk4, results);
  Keep("plant", controlled, results);
  const SimulatorRate quiet =
      ReportEnvironment("the whole environment, without noise", "environment", clean, nullptr,
                        options, pool, results);
  if (noisy.observation_noise > 0 || noisy.observation_noise_max > 0) {
    ReportEnvironment("the whole environment, with noise", "environment_with_noise", noisy, &quiet,
                      options, pool, results);
  }
  fmt::print("  (the paper's GPU: {:.0f} ms for an Euler step of 10^6 without flight control)\n",
             1e3 * kPaperEulerStepS);
  results.other = WithShareOfPeak(results.other, gflops, peak.gflops);
  Report(options, results);
}

}  // namespace skein
