#include "src/run_signals.h"

#include <csignal>

#include "simd/error.h"
#include "train/file_descriptor.h"

namespace skein {
namespace {

volatile std::sig_atomic_t stop_signal = 0;
volatile std::sig_atomic_t save_requested = 0;

void OnStop(int signal) {
  if (stop_signal != 0) {
    // Once handled is enough: the next one acts as if no handler were there.
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  stop_signal = signal;
}

void OnSave(int) { save_requested = 1; }

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

RunSignals::RunSignals() {
  stop_signal = 0;
  save_requested = 0;
  Install(SIGINT, OnStop);
  Install(SIGTERM, OnStop);
  Install(SIGUSR1, OnSave);
  Install(SIGPIPE, SIG_IGN);
}

RunSignals::~RunSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGPIPE}) std::signal(signal, SIG_DFL);
}

int RunSignals::StopSignal() const { return stop_signal; }

bool RunSignals::TakeSaveRequest() {
  if (save_requested == 0) return false;
  save_requested = 0;
  return true;
}

}  // namespace skein
