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

}  // namespace

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

}  // namespace skein
