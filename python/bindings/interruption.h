// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nanobind/nanobind.h>

#include <csignal>

#include "base/error.h"
#include "base/worker_pool.h"
#include "python/bindings/interpreter_lock.h"
#include "src/run/run_signals.h"

namespace skein {

/// Lets Python handle the signals that it has caught: of SIGINT it makes KeyboardInterrupt.
inline void HandleSignals() {
  if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
}

/// Hands a signal that was caught without the interpreter to whoever would have had it. Nothing if
/// it is 0.
inline void RaiseSignal(int signal) {
  if (signal == 0) return;
  std::raise(signal);
  HandleSignals();
}

/// Does long work on the pool without the interpreter's lock, and returns what it does. Ctrl-C
/// stops the pool, and then ends the work as it ends Python's own. `save` is whether SIGUSR1 is the
/// work's, or left to Python.
template <typename Work>
auto Unlocked(WorkerPool& pool, SaveSignal save, const Work& work) {
  int stop_signal = 0;
  auto result = [&] {
    const RunSignals signals(pool, save);
    HandleSignals();  // that came before
    const InterpreterUnlocked unlocked;
    auto done = work();
    stop_signal = signals.StopSignal();
    return done;
  }();
  RaiseSignal(stop_signal);
  return result;
}

/// The same of work that is nothing unless it is whole: throws Error if it was stopped by a signal
/// of which Python's handler raised nothing.
template <typename Work>
auto UnlockedAsWhole(WorkerPool& pool, const Work& work) {
  auto result = Unlocked(pool, SaveSignal::kLeft, work);
  if (pool.stopping()) {
    throw Error("stopped by a signal, whose handler raised nothing: there is no result");
  }
  return result;
}

}  // namespace skein
