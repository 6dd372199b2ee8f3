// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/worker_pool.h"

namespace skein {

/// While it lives, SIGINT and SIGTERM ask a pool to stop and SIGUSR1 asks for a save instead of
/// ending the process. A second SIGINT or SIGTERM ends it at once, as by default. SIGPIPE is
/// ignored: a reader of the progress that goes away is no reason to stop. One at a time.
class RunSignals {
 public:
  /// Throws Error if the system refuses a handler.
  explicit RunSignals(WorkerPool& pool);
  ~RunSignals();
  RunSignals(const RunSignals&) = delete;
  RunSignals& operator=(const RunSignals&) = delete;

  /// The signal that asked for a stop, or 0.
  int StopSignal() const;
  /// Whether a save was asked for since the last call.
  bool TakeSaveRequest();
};

}  // namespace skein
