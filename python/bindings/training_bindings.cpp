// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/string.h>

#include <cmath>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>

#include "base/worker_pool.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interpreter_lock.h"
#include "python/bindings/interruption.h"
#include "src/agents/low_level_option.h"
#include "src/agents/policy_file.h"
#include "src/config/configuration.h"
#include "src/config/program_config.h"
#include "src/run/metrics.h"
#include "src/run/recorded_run.h"
#include "src/run/run_directory.h"
#include "src/run/training_run.h"

namespace nb = nanobind;

namespace skein {
namespace {

/// A row of metrics.csv; None where its cell is empty.
nb::dict ToDict(const IterationReport& report) {
  nb::dict row;
  for (const MetricsCell& cell : MetricsCells(report)) {
    const char* const name = cell.name.c_str();
    if (cell.is_count) {
      row[name] = static_cast<std::uint64_t>(cell.value);
    } else if (std::isfinite(cell.value)) {
      row[name] = cell.value;
    } else {
      row[name] = nb::none();
    }
  }
  return row;
}

/// Does `work` without the interpreter's lock, given what shows the callback every iteration, and
/// whether the run prints. What
/// the callback throws ends the run as its false does, saved, and is thrown on; so is what Ctrl-C
/// means in Python.
template <typename Work>
void TrainUnlocked(const nb::object& callback, bool progress, WorkerPool& pool, const Work& work) {
  std::exception_ptr failure;
  RunWatch watch;
  watch.prints = progress;
  if (!callback.is_none()) {
    watch.goes_on = [&](const IterationReport& report) {
      const InterpreterLocked locked;
      try {
        return !callback(ToDict(report)).is(nb::bool_(false));
      } catch (...) {
        failure = std::current_exception();
        return false;
      }
    };
  }
  // Its own signals are those of the run; what comes before it begins stops it, too.
  const int stop_signal =
      Unlocked(pool, SaveSignal::kTaken, [&] { return work(std::move(watch)); });
  if (failure) std::rethrow_exception(failure);
  RaiseSignal(stop_signal);
}

/// Trains and evaluates in a new run directory.
void Train(const ProgramConfig& config, const std::string& out, const std::string& from,
           const std::string& low_level, int threads, bool progress, const nb::object& callback) {
  ProgramConfig trained = config;
  RunOrigin origin;
  if (!from.empty()) origin.from = NetworksFileOf(from);
  const ChosenLowLevelPolicy below = ChooseLowLevelPolicy(config.train.env, low_level, origin.from);
  trained.train.low_level = below.policy;
  origin.low_level = below.description;
  WorkerPool pool(threads);
  TrainUnlocked(callback, progress, pool, [&](RunWatch watch) {
    origin.watch = std::move(watch);
    return TrainingRun::Begin(trained, out, pool, origin);
  });
}

/// Trains on in a run directory, to the end of its budget.
void Resume(const std::string& path, int threads, bool progress, const nb::object& callback) {
  RunDirectory directory = RunDirectory::Open(path);
  const ProgramConfig config = RecordedConfig(directory);
  WorkerPool pool(threads);
  TrainUnlocked(callback, progress, pool, [&](RunWatch watch) {
    return TrainingRun::Resume(config, std::move(directory), pool, std::move(watch));
  });
}

}  // namespace

void BindTraining(nb::module_& module) {
  module.def("train", &Train, nb::arg("config"), nb::arg("out"), nb::arg("start_from"),
             nb::arg("low_level"), nb::arg("threads"), nb::arg("progress"),
             nb::arg("callback").none());
  module.def("resume", &Resume, nb::arg("path"), nb::arg("threads"), nb::arg("progress"),
             nb::arg("callback").none());
}

}  // namespace skein
