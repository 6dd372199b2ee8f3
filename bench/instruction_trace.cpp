// SPDX-License-Identifier: Apache-2.0
#include "bench/instruction_trace.h"

#include <csignal>
#include <string>

#include "base/error.h"

#if defined(__linux__) && defined(__x86_64__)
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#endif

namespace skein::bench {
#if defined(__linux__) && defined(__x86_64__)
namespace {

constexpr int kRefused = 3, kFailed = 4;  // exit codes of the child

/// A process that stops around its work.
class TracedChild {
 public:
  explicit TracedChild(const std::function<void()>& work) : process_(fork()) {
    if (process_ < 0) Fail("fork");
    if (process_ > 0) return;
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(kRefused);
    raise(SIGSTOP);
    try {
      work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(kFailed);
    }
    raise(SIGSTOP);
    _exit(0);
  }
  ~TracedChild() {
    if (has_ended_) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  TracedChild(const TracedChild&) = delete;
  TracedChild& operator=(const TracedChild&) = delete;

  /// Waits until it stops, and returns the signal that stopped it.
  int WaitForStop() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0) {
      if (errno != EINTR) Fail("waitpid");
    }
    if (WIFSTOPPED(status)) return WSTOPSIG(status);
    has_ended_ = true;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    throw Error(code == kRefused  ? "tracing: this system does not let processes be traced"
                : code == kFailed ? "tracing: what is traced has failed"
                                  : "tracing: the traced process has ended by itself");
  }

  void Step() const {
    if (ptrace(PTRACE_SINGLESTEP, process_, nullptr, nullptr) != 0) Fail("ptrace");
  }

  /// Of the instruction that is next.
  std::uintptr_t Address() const {
    errno = 0;
    const long address =
        ptrace(PTRACE_PEEKUSER, process_, offsetof(user_regs_struct, rip), nullptr);
    if (errno != 0) Fail("ptrace");
    return static_cast<std::uintptr_t>(address);
  }

 private:
  [[noreturn]] static void Fail(const char* call) {
    throw Error(std::string("tracing: ") + call + ": " + std::strerror(errno));
  }

  pid_t process_;
  bool has_ended_ = false;
};

/// Signals that a process ignores stop it nonetheless while it is traced.
bool IsIgnored(int signal) { return signal == SIGWINCH || signal == SIGCHLD || signal == SIGCONT; }

}  // namespace

InstructionCounts TraceInstructions(const std::function<void()>& work) {
  TracedChild child(work);
  child.WaitForStop();
  InstructionCounts counts;
  std::uintptr_t last = 0;
  while (true) {
    // A string instruction stops behind each of its repetitions.
    if (const std::uintptr_t address = child.Address(); address != last) {
      ++counts[address];
      last = address;
    }
    child.Step();
    int signal = child.WaitForStop();
    while (IsIgnored(signal)) {
      child.Step();
      signal = child.WaitForStop();
    }
    if (signal == SIGSTOP) return counts;
    if (signal == SIGTRAP) continue;
    throw Error(std::string("tracing: the traced process got a signal: ") + strsignal(signal));
  }
}
#else
InstructionCounts TraceInstructions(const std::function<void()>&) {
  throw Error("instructions are traced one by one on x86-64 Linux alone");
}
#endif

}  // namespace skein::bench
