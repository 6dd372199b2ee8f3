// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/resource.h>

#include "simd/matrix_product.h"
#include "simd/target.h"
#include "src/agents/low_level_option.h"
#include "src/bench/learner_rates.h"
#include "src/bench/machine.h"
#include "src/commands/benchmarks.h"
#include "src/commands/launched_ranks.h"
#include "src/config/usage_error.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/run/progress.h"
#include "train/network/backend_module.h"
#include "train/network/precision.h"
#include "train/ppo/trainer.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

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

/// What learner benchmarks compare: the fused kernels in the configuration's precision first, in
/// every other one that this processor knows, and LibTorch, if it is there, in tiles that suit it.
std::vector<TrainConfig> LearnersOf(const TrainConfig& config) {
  // LibTorch's best sizes: each of its operations walks through a whole tile.
  constexpr int kLibTorchTileSamples = 4096, kLibTorchRolloutTile = 512;
  std::vector<TrainConfig> learners{config};
  std::vector<LearnerPrecision> precisions{LearnerPrecision::kFloat32};
  if (simd::NativeTiles()) precisions.push_back(LearnerPrecision::kAmx);
  if (simd::NativeBfloat16()) {
    precisions.insert(precisions.end(), {LearnerPrecision::kMixed, LearnerPrecision::kBfloat16,
                                         LearnerPrecision::kFast});
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

/// What the instruction multiplies that products of `precision` take here.
const char* NameOfOperands(simd::Precision precision) {
  if (precision == simd::Precision::kBfloat16 && simd::NativeBfloat16()) return "bfloat16";
  return simd::IsOfTiles(precision) && simd::NativeTiles() ? "tiles of bfloat16" : "float32";
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
    const simd::Precision roof = RoofPrecision(rates.backend.precision);
    fmt::print("  {:<14} {:>6} {}/s  {}({})\n", ShortName(rates.backend), FormatCount(rate),
               comparison.unit,
               has_reference ? fmt::format("{:5.2f} x LibTorch  ", rate / reference) : "",
               ShareOfPeak(gflops, rates.peak_gflops, NameOfOperands(roof)));
    all.push_back(
        WithShareOfPeak({{"backend", Name(rates.backend.backend)},
                         {"precision", Name(rates.backend.precision)},
                         {comparison.key, rate},
                         {"times_libtorch", has_reference ? Json(rate / reference) : Json()}},
                        gflops, rates.peak_gflops));
  }
  if (has_reference && LibTorchBlas() == kBlasOfUnknownProcessors &&
      simd::FusesMultiplyAdd(simd::ActiveTarget())) {
    fmt::print(
        "  LibTorch multiplies without AVX: its OpenBLAS does not know this processor "
        "(OPENBLAS_CORETYPE=SkylakeX or Haswell says which one it is like)\n");
  }
  Json results = all[0];
  results["learners"] = all;
  return results;
}

using Samples = LearnerRates::Samples;

/// One figure of every learner.
std::vector<Figure> FiguresOf(const std::vector<LearnerRates>& learners, const std::string& name,
                              std::vector<double> Samples::*samples) {
  std::vector<Figure> figures;
  for (const LearnerRates& rates : learners) {
    const BackendChoice& backend = rates.backend;
    figures.push_back(
        {fmt::format("{}_{}_{}", Name(backend.backend), Name(backend.precision), name), true,
         rates.samples.*samples});
  }
  return figures;
}

double PeakMemoryGb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e9;
}

std::string Workers(int ranks, int shards, int threads) {
  const std::string each = Counted(threads, "thread");
  return ranks == 1 ? each : fmt::format("{} ranks x {}, {} shards", ranks, each, shards);
}

/// What whole iterations came to.
struct IterationFigures {
  IterationFigures(const TrainConfig& config, const LearnerRates& rates)
      : control_steps(static_cast<double>(config.ppo.num_aircraft) * config.ppo.rollout_steps *
                      config.env.action_repeat),
        steps_per_s(control_steps / rates.iteration_s),
        budget_h(static_cast<double>(config.total_steps) / steps_per_s / 3600) {}

  double control_steps, steps_per_s, budget_h;
};

void PrintIteration(const TrainConfig& config, const LearnerRates& rates, int ranks, int threads) {
  const IterationFigures figures(config, rates);
  fmt::print(
      "iteration: {} aircraft x {} policy steps, {} epochs, {}; {}\n"
      "  {:.2f} s an iteration, {} control steps/s\n"
      "  rollout {} policy steps/s ({} {:.0f} % of it), gradients {} samples/s\n"
      "  these two alone would take {:.1f} % of the time; {:.2f} GB of memory at most\n"
      "  {} control steps would take {:.2f} h\n",
      config.ppo.num_aircraft, config.ppo.rollout_steps, config.ppo.epochs,
      Workers(ranks, config.learner.shards, threads), Describe(rates.backend), rates.iteration_s,
      FormatCount(figures.steps_per_s), FormatCount(rates.rollout_policy_steps_per_s),
      NameSimulator(config), 100 * rates.simulator_share, FormatCount(rates.gradient_samples_per_s),
      100 * rates.efficiency, PeakMemoryGb(), FormatCount(static_cast<double>(config.total_steps)),
      figures.budget_h);
  if (ranks == 1) return;
  fmt::print(
      "  ranks exchange, or wait for each other, {:.1f} % of the time and {:.3f} s in all, some of "
      "them while they compute; {:.1f} MB sent each\n",
      100 * rates.exchange_share, rates.exchange_s, rates.sent_bytes / 1e6);
}

Json IterationJson(const TrainConfig& config, const LearnerRates& rates, int ranks) {
  const IterationFigures figures(config, rates);
  return {{"backend", Name(rates.backend.backend)},
          {"precision", Name(rates.backend.precision)},
          {"ranks", ranks},
          {"shards", config.learner.shards},
          {"iteration_s", rates.iteration_s},
          {"control_steps_per_s", figures.steps_per_s},
          {"policy_steps_per_s", rates.rollout_policy_steps_per_s},
          {"simulator_share", rates.simulator_share},
          {"gradient_samples_per_s", rates.gradient_samples_per_s},
          {"efficiency", rates.efficiency},
          {"exchange_share", rates.exchange_share},
          {"exchange_s", rates.exchange_s},
          {"exchanges", rates.exchanges},
          {"sent_mb", rates.sent_bytes / 1e6},
          {"memory_gb", PeakMemoryGb()},
          {"budget_steps", config.total_steps},
          {"budget_h", figures.budget_h}};
}

/// On all ranks together.
void MeasureIteration(const BenchOptions& options, Ranks& ranks) {
  TrainConfig config;
  DoTogether(ranks, [&] {
    config = LearnerBenchConfig(options);
    ChooseShards(options.assignments, ranks, &config);
    if (ranks.rank() == 0) CheckWritable({options.json}, FilesRead(options));
  });
  RequireSameOnRanks(ranks, "what they measure", DescribeProgram());
  WorkerPool pool(options.threads);
  const LearnerRates rates = MeasureLearners({config}, options.iterations, pool, ranks)[0];
  if (ranks.rank() != 0) return;
  PrintIteration(config, rates, ranks.count(), pool.threads());
  Report(options, {"iteration",
                   pool.threads(),
                   {{"iteration_s", false, rates.samples.iteration_s},
                    {"policy_steps_per_s", true, rates.samples.rollout_policy_steps_per_s},
                    {"gradient_samples_per_s", true, rates.samples.gradient_samples_per_s}},
                   IterationJson(config, rates, ranks.count()),
                   config.env.task_file_hash});
}

}  // namespace

void BenchRollout(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const TrainConfig config = LearnerBenchConfig(options);
  const std::vector<LearnerRates> learners =
      MeasureLearners(LearnersOf(config), options.iterations, pool);
  fmt::print("rollout: {} aircraft, {}; {}\n", config.ppo.num_aircraft,
             Counted(pool.threads(), "thread"), Describe(learners[0].backend));
  Json results = Compare(
      learners, {"policy steps", "policy_steps_per_s", &LearnerRates::rollout_policy_steps_per_s,
                 &LearnerRates::rollout_flops_per_policy_step});
  const double control_steps = learners[0].rollout_policy_steps_per_s * config.env.action_repeat;
  fmt::print("  {} control steps/s with the first; {} takes {:.0f} % of its time\n",
             FormatCount(control_steps), NameSimulator(config), 100 * learners[0].simulator_share);
  results["control_steps_per_s"] = control_steps;
  results["simulator_share"] = learners[0].simulator_share;
  Report(options, {"rollout", pool.threads(),
                   FiguresOf(learners, "policy_steps_per_s", &Samples::rollout_policy_steps_per_s),
                   results, config.env.task_file_hash});
}

void BenchUpdate(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  const TrainConfig config = LearnerBenchConfig(options);
  const std::vector<LearnerRates> learners =
      MeasureLearners(LearnersOf(config), options.iterations, pool);
  fmt::print("update: {}; {}\n", Counted(pool.threads(), "thread"), Describe(learners[0].backend));
  const Json results =
      Compare(learners, {"samples", "samples_per_s", &LearnerRates::update_samples_per_s,
                         &LearnerRates::update_flops_per_sample});
  Report(options, {"update", pool.threads(),
                   FiguresOf(learners, "samples_per_s", &Samples::update_samples_per_s), results,
                   config.env.task_file_hash});
}

void BenchIteration(const BenchOptions& options) {
  OnLaunchedRanks(options.rank_timeout_s, [&](Ranks& ranks) { MeasureIteration(options, ranks); });
}

void BenchSignature(const BenchOptions& options) {
  WorkerPool pool(options.threads);
  Trainer trainer(SignatureConfig(), pool);
  while (!trainer.finished()) trainer.Iterate();
  const std::string signature = fmt::format("{:016x}", trainer.Signature());
  fmt::print("{}\n", signature);
  Report(options, {"signature",
                   pool.threads(),
                   {},
                   {{"signature", signature}, {"iterations", trainer.iteration()}}});
}

}  // namespace skein
