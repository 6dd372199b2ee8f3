// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/string.h>

#include <cstddef>
#include <string>
#include <utility>

#include "base/worker_pool.h"
#include "envs/tasks/termination.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interruption.h"
#include "src/agents/low_level_option.h"
#include "src/agents/policy_file.h"
#include "src/config/configuration.h"
#include "src/config/program_config.h"
#include "src/run/run_directory.h"
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

/// Does `work` without the interpreter's lock, given what shows the callback every iteration. What
/// the callback throws ends the run as its false does, saved, and is thrown on; so is what Ctrl-C
/// means in Python.
template <typename Work>
void TrainUnlocked(const nb::object& callback, WorkerPool& pool, const Work& work) {
  std::exception_ptr failure;
  GoesOn goes_on;
  if (!callback.is_none()) {
    goes_on = [&](const IterationReport& report) {
      const nb::gil_scoped_acquire acquired;
      try {
        return !callback(ToDict(report)).is(nb::bool_(false));
      } catch (...) {
        failure = std::current_exception();
        return false;
      }
    };
  }
  // Its own signals are those of the run; what comes before it begins stops it, too.
  const int stop_signal = Unlocked(pool, [&] { return work(std::move(goes_on)); });
  if (failure) std::rethrow_exception(failure);
  RaiseSignal(stop_signal);
}

/// Trains and evaluates in a new run directory.
void Train(const ProgramConfig& config, const std::string& out, const std::string& from,
           const std::string& low_level, int threads, const nb::object& callback) {
  ProgramConfig trained = config;
  RunOrigin origin;
  if (!from.empty()) origin.from = NetworksFileOf(from);
  const ChosenLowLevelPolicy below = ChooseLowLevelPolicy(config.train.env, low_level);
  trained.train.low_level = below.policy;
  origin.low_level = below.description;
  WorkerPool pool(threads);
  TrainUnlocked(callback, pool, [&](GoesOn goes_on) {
    origin.goes_on = std::move(goes_on);
    return TrainingRun::Begin(trained, out, pool, origin);
  });
}

/// Trains on in a run directory, to the end of its budget.
void Resume(const std::string& path, int threads, const nb::object& callback) {
  RunDirectory directory = RunDirectory::Open(path);
  ProgramConfig config = ReadRecord(directory.config());
  config.train.low_level = LowLevelPolicyOfRun(directory, config.train.env);
  WorkerPool pool(threads);
  TrainUnlocked(callback, pool, [&](GoesOn goes_on) {
    return TrainingRun::Resume(config, std::move(directory), pool, std::move(goes_on));
  });
}

}  // namespace

void BindTraining(nb::module_& module) {
  module.def("train", &Train, nb::arg("config"), nb::arg("out"), nb::arg("start_from"),
             nb::arg("low_level"), nb::arg("threads"), nb::arg("callback").none());
  module.def("resume", &Resume, nb::arg("path"), nb::arg("threads"), nb::arg("callback").none());
}

}  // namespace skein
