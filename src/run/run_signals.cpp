// SPDX-License-Identifier: Apache-2.0
#include "src/run/run_signals.h"

#include <atomic>
#include <csignal>

#include "base/error.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

// Handlers run on whichever thread the system chooses.
std::atomic<WorkerPool*> stopped_pool{nullptr};
std::atomic<int> stop_signal{0};
std::atomic<bool> save_requested{false};
static_assert(std::atomic<WorkerPool*>::is_always_lock_free &&
              std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

void OnStop(int signal) {
  int none = 0;
  if (!stop_signal.compare_exchange_strong(none, signal)) {
    // Once handled is enough: the next one acts as if no handler were there.
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  stopped_pool.load()->RequestStop();
}

void OnSave(int) { save_requested = true; }

void Install(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  if (sigaction(signal, &action, nullptr) != 0) {
    throw Error("cannot handle signals: " + SystemReason());
  }
}

}  // namespace

RunSignals::RunSignals(WorkerPool& pool) {
  stopped_pool = &pool;
  stop_signal = 0;
  save_requested = false;
  Install(SIGINT, OnStop);
  Install(SIGTERM, OnStop);
  Install(SIGUSR1, OnSave);
  Install(SIGPIPE, SIG_IGN);
}

RunSignals::~RunSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGPIPE}) std::signal(signal, SIG_DFL);
}

int RunSignals::StopSignal() const { return stop_signal; }

bool RunSignals::TakeSaveRequest() { return save_requested.exchange(false); }

}  // namespace skein
