// SPDX-License-Identifier: Apache-2.0
#include "src/run/run_signals.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <iterator>

#include "base/error.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

// Handlers run on whichever thread the system chooses.
std::atomic<WorkerPool*> stopped_pool{nullptr};
std::atomic<int> stop_signal{0};
std::atomic<bool> save_requested{false};
using Handler = void (*)(int);
/// What handled each of kStopSignals before.
std::atomic<Handler> outer_handlers[3];
constexpr int kStopSignals[] = {SIGINT, SIGTERM, SIGHUP};
static_assert(std::atomic<WorkerPool*>::is_always_lock_free &&
              std::atomic<Handler>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
              std::atomic<bool>::is_always_lock_free);

void OnStop(int signal) {
  int none = 0;
  if (!stop_signal.compare_exchange_strong(none, signal)) {
    // Once handled is enough: the next one acts as if this handler were not there.
    const auto* const known = std::find(std::begin(kStopSignals), std::end(kStopSignals), signal);
    std::signal(signal, outer_handlers[known - std::begin(kStopSignals)]);
    std::raise(signal);
    return;
  }
  // None if the object has gone since the system chose this handler.
  if (WorkerPool* const pool = stopped_pool.load()) pool->RequestStop();
}

void OnSave(int) { save_requested = true; }

/// Whether whoever started the process asked it to outlive its terminal, as nohup does.
bool IgnoresHangUp() {
  struct sigaction action {};
  return sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Signals are a process's, and its main thread's to handle.
bool IsMainThread() { return gettid() == getpid(); }

}  // namespace

RunSignals::RunSignals(WorkerPool& pool, SaveSignal save) : pool_(pool), handles_(IsMainThread()) {
  if (!handles_) return;
  outer_pool_ = stopped_pool.exchange(&pool);
  outer_signal_ = stop_signal.exchange(0);
  save_requested = false;
  for (std::size_t i = 0; i < std::size(kStopSignals); ++i) {
    const int signal = kStopSignals[i];
    if (signal == SIGHUP && IgnoresHangUp()) continue;
    const Handler outer = Install(signal, OnStop);
    // Of several objects the outermost one's.
    if (outer != OnStop) outer_handlers[i] = outer;
  }
  if (save == SaveSignal::kTaken) Install(SIGUSR1, OnSave);
  Install(SIGPIPE, SIG_IGN);
}

RunSignals::~RunSignals() {
  if (!handles_) return;
  for (const Replaced& replaced : replaced_) {
    sigaction(replaced.signal, &replaced.handler, nullptr);
  }
  stopped_pool = outer_pool_;
  stop_signal = outer_signal_;
}

RunSignals::Handler RunSignals::Install(int signal, Handler handler) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  struct sigaction before {};
  if (sigaction(signal, &action, &before) != 0) {
    throw Error("cannot handle signals: " + SystemReason());
  }
  replaced_.push_back({signal, before});
  return before.sa_handler;
}

int RunSignals::StopSignal() const {
  const int own = handles_ ? stop_signal.load() : 0;
  return own != 0 ? own : adopted_signal_;
}

void RunSignals::Adopt(int signal) {
  if (signal == SIGUSR1) {
    save_requested = true;
    return;
  }
  if (adopted_signal_ == 0) adopted_signal_ = signal;
  pool_.RequestStop();
}

bool RunSignals::TakeSaveRequest() { return handles_ && save_requested.exchange(false); }

}  // namespace skein
