// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <vector>

#include "base/worker_pool.h"

namespace skein {

/// Whether SIGUSR1 asks for a save, or stays what it was.
enum class SaveSignal { kTaken, kLeft };

/// While it lives, SIGINT, SIGTERM and SIGHUP ask a pool to stop and SIGUSR1 asks for a save
/// instead of ending the process. A second one that asks to stop does what it did before the object
/// was there: by default it ends the process at once, and in Python it interrupts what Python runs.
/// A SIGHUP that was ignored (nohup) stays so. SIGPIPE is ignored: a reader of the progress that
/// goes away is no reason to stop. What handled the signals before (an outer one of these, or
/// Python) handles them again after it. On threads beside the process's main one it does nothing:
/// the signals are that one's.
class RunSignals {
 public:
  /// Throws Error if the system refuses a handler.
  explicit RunSignals(WorkerPool& pool, SaveSignal save = SaveSignal::kTaken);
  ~RunSignals();
  RunSignals(const RunSignals&) = delete;
  RunSignals& operator=(const RunSignals&) = delete;

  /// The signal that asked for a stop, or 0.
  int StopSignal() const;
  /// Does what the signal, which another process has got, would do here; but if it comes here too,
  /// it is the first.
  void Adopt(int signal);
  /// Whether a save was asked for since the last call.
  bool TakeSaveRequest();

 private:
  struct Replaced {
    int signal;
    struct sigaction handler;
  };
  using Handler = void (*)(int);
  /// Returns what handled the signal before.
  Handler Install(int signal, Handler handler);

  WorkerPool& pool_;
  bool handles_;
  WorkerPool* outer_pool_ = nullptr;
  int outer_signal_ = 0;
  int adopted_signal_ = 0;
  std::vector<Replaced> replaced_;
};

}  // namespace skein
