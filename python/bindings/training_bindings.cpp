// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/string.h>

#include <cstddef>
#include <string>
#include <utility>

#include "base/worker_pool.h"
#include "envs/tasks/termination.h"
#include "python/bindings/bindings.h"
#include "src/agents/low_level_option.h"
#include "src/agents/policy_file.h"
#include "src/config/program_config.h"
#include "src/run/training_run.h"

namespace nb = nanobind;

namespace skein {
namespace {

nb::dict ToDict(const IterationReport& report) {
  nb::dict row;
  row["iteration"] = report.iteration;
  row["env_steps"] = report.env_steps;
  row["episodes"] = report.episodes;
  row["return_mean"] = report.return_mean;
  row["success_rate"] = report.success_rate;
  nb::dict terminations;
  for (std::size_t k = 1; k < kTerminationNames.size(); ++k) {
    terminations[kTerminationNames[k]] = report.terminations[k];
  }
  row["terminations"] = terminations;
  row["policy_loss"] = report.policy_loss;
  row["value_loss"] = report.value_loss;
  row["entropy"] = report.entropy;
  row["approximate_kl"] = report.approximate_kl;
  row["clip_fraction"] = report.clip_fraction;
  row["explained_variance"] = report.explained_variance;
  row["learning_rate"] = report.learning_rate;
  row["log_std_mean"] = report.log_std_mean;
  row["evaluation_success_rate"] =
      report.evaluation_success_rate < 0 ? nb::none() : nb::cast(report.evaluation_success_rate);
  row["is_best"] = report.best;
  return row;
}

/// Trains and evaluates in a run directory. What the callback throws ends the run as its false
/// does, saved, and is thrown on.
void Train(const ProgramConfig& config, const std::string& out, const std::string& from,
           const std::string& low_level, int threads, const nb::object& callback) {
  ProgramConfig trained = config;
  RunOrigin origin;
  if (!from.empty()) origin.from = NetworksFileOf(from);
  const ChosenLowLevelPolicy below = ChooseLowLevelPolicy(config.train.env, low_level);
  trained.train.low_level = below.policy;
  origin.low_level = below.description;
  std::exception_ptr failure;
  if (!callback.is_none()) {
    origin.goes_on = [&](const IterationReport& report) {
      const nb::gil_scoped_acquire acquired;
      try {
        return !callback(ToDict(report)).is(nb::bool_(false));
      } catch (...) {
        failure = std::current_exception();
        return false;
      }
    };
  }
  WorkerPool pool(threads);
  {
    const nb::gil_scoped_release released;
    TrainingRun::Begin(trained, out, pool, origin);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace

void BindTraining(nb::module_& module) {
  module.def("train", &Train, nb::arg("config"), nb::arg("out"), nb::arg("start_from"),
             nb::arg("low_level"), nb::arg("threads"), nb::arg("callback").none());
}

}  // namespace skein
