// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "envs/kernels/plant_kernel.h"
#include "simd/peak.h"
#include "simd/target.h"
#include "src/bench/simulator_rate.h"
#include "src/commands/benchmarks.h"
#include "src/run/progress.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const SimulatorRate& rate) {
  return {{"step_ms", 1e3 * rate.step_s}, {"aircraft_steps_per_s", rate.aircraft_steps_per_s}};
}

// NeuralPlane (NeurIPS 2024): one Euler step of 10^6 F-16s without flight control on a GPU.
constexpr double kPaperEulerStepS = 0.2;

/// An environment, and beside it that of the task asked for, or else the same of nominal plants if
/// its own are drawn.
std::vector<SimulatorRate> MeasureBesideOther(const EnvConfig& config, const BenchOptions& options,
                                              WorkerPool& pool) {
  std::vector<EnvConfig> configs{config};
  if (!options.beside.empty()) {
    BenchOptions other = options;
    other.task = options.beside;
    configs.push_back(BenchConfig(other).env);
    configs.back().observation_noise = config.observation_noise;
    configs.back().observation_noise_max = config.observation_noise_max;
  } else if (config.plant.enabled()) {
    configs.push_back(config);
    configs.back().plant = {};
  }
  return MeasureEnvironments(configs, options.num_aircraft, options.steps, pool);
}

void PrintRate(const std::string& what, const SimulatorRate& rate, const std::string& note = "") {
  fmt::print("  {:<38}  {:9.2f} ms a step, {} aircraft-steps/s{}\n", what, 1e3 * rate.step_s,
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

/// Prints and keeps the first of `rates`, with `note`, and the nominal plants' behind it.
void ReportEnvironment(const std::string& what, const std::string& key,
                       const std::vector<SimulatorRate>& rates, const std::string& note,
                       const BenchOptions& options, BenchResults& results) {
  PrintRate(what, rates[0], note);
  Keep(key, rates[0], results);
  if (rates.size() == 1) return;
  if (!options.beside.empty()) {
    PrintRate("... of " + options.beside, rates[1],
              " (" + options.task + ": " + Beyond(rates[0], rates[1]) + ")");
    Keep(key + "_beside", rates[1], results);
    return;
  }
  PrintRate("... of nominal plants", rates[1], " (drawn ones: " + Beyond(rates[0], rates[1]) + ")");
  Keep(key + "_of_nominal_plants", rates[1], results);
}

}  // namespace

void BenchSimulator(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const EnvConfig noisy = BenchConfig(options).env;
  EnvConfig clean = noisy;
  clean.observation_noise = clean.observation_noise_max = 0;
  const simd::PeakRate peak = simd::MeasurePeak(pool.threads());
  const auto plant = [&](PlantPart part) {
    return MeasurePlant(part, options.num_aircraft, options.steps, pool);
  };
  const SimulatorRate rk4 = plant(PlantPart::kRk4);
  const SimulatorRate controlled = plant(PlantPart::kFlightControlAndRk4);
  const double gflops = rk4.aircraft_steps_per_s * kFlopsPerRk4Step / 1e9;
  fmt::print("simulator: {} aircraft, {} control steps, {} threads, {}\n", options.num_aircraft,
             options.steps, pool.threads(), Name(simd::ActiveTarget()));
  PrintRate("F-16: RK4 with engine", rk4, " (" + ShareOfPeak(gflops, peak.gflops) + ")");
  PrintRate("F-16: ... with flight control, actuators", controlled);
  BenchResults results{"sim", pool.threads(), {}, {}};
  results.other = {{"aircraft", options.num_aircraft}, {"steps", options.steps}};
  Keep("rk4", rk4, results);
  Keep("plant", controlled, results);
  const std::vector<SimulatorRate> whole = MeasureBesideOther(clean, options, pool);
  ReportEnvironment("the whole environment, without noise", "environment", whole, "", options,
                    results);
  if (noisy.observation_noise > 0 || noisy.observation_noise_max > 0) {
    const std::vector<SimulatorRate> with_noise = MeasureBesideOther(noisy, options, pool);
    ReportEnvironment("the whole environment, with noise", "environment_with_noise", with_noise,
                      " (" + Beyond(with_noise[0], whole[0]) + ")", options, results);
  }
  fmt::print("  (the paper's GPU: {:.0f} ms for an Euler step of 10^6 without flight control)\n",
             1e3 * kPaperEulerStepS);
  results.other = WithShareOfPeak(results.other, gflops, peak.gflops);
  Report(options, results);
}

}  // namespace skein
