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
#include <cstring>
#endif

namespace skein::bench {
#if defined(__linux__) && defined(__x86_64__)
namespace {

/// A process that stops around its work.
class TracedChild {
 public:
  explicit TracedChild(const std::function<void()>& work) : process_(fork()) {
    if (process_ < 0) Fail("fork");
    if (process_ > 0) return;
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    raise(SIGSTOP);
    try {
      work();
    } catch (...) {
      _exit(1);
    }
    raise(SIGSTOP);
    _exit(0);
  }
  ~TracedChild() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  TracedChild(const TracedChild&) = delete;
  TracedChild& operator=(const TracedChild&) = delete;

  /// Waits until it stops, and returns the signal that stopped it.
  int WaitForStop() const {
    int status = 0;
    if (waitpid(process_, &status, 0) < 0) Fail("waitpid");
    if (!WIFSTOPPED(status)) throw Error("tracing: the process has ended by itself");
    return WSTOPSIG(status);
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
};

}  // namespace

InstructionCounts TraceInstructions(const std::function<void()>& work) {
  const TracedChild child(work);
  child.WaitForStop();
  InstructionCounts counts;
  do {
    ++counts[child.Address()];
    child.Step();
  } while (child.WaitForStop() == SIGTRAP);
  return counts;
}
#else
InstructionCounts TraceInstructions(const std::function<void()>&) {
  throw Error("instructions are traced one by one on x86-64 Linux alone");
}
#endif

}  // namespace skein::bench
