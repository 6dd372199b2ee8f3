// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Python.h>
#include <cxxabi.h>
#include <unistd.h>

namespace skein {

/// Takes the interpreter's lock by `take`, and returns what that returns. Before 3.14, Python ends
/// a thread that asks for the lock while the interpreter goes away (a daemon thread, at the end of
/// the program) by unwinding it, and no thread with destructors below survives that: the process
/// would abort. Such a thread waits here for the end of the process, as it does in Python 3.14.
template <typename Take>
auto TakeInterpreterLock(const Take& take) {
  try {
    return take();
  } catch (const abi::__forced_unwind&) {
    for (;;) pause();
  }
}

/// While it lives, the thread does not have the interpreter's lock.
class InterpreterUnlocked {
 public:
  InterpreterUnlocked() : thread_(PyEval_SaveThread()) {}
  ~InterpreterUnlocked() {
    TakeInterpreterLock([this] { PyEval_RestoreThread(thread_); });
  }
  InterpreterUnlocked(const InterpreterUnlocked&) = delete;
  InterpreterUnlocked& operator=(const InterpreterUnlocked&) = delete;

 private:
  PyThreadState* thread_;
};

/// While it lives, the thread, which may be any, has the interpreter's lock.
class InterpreterLocked {
 public:
  InterpreterLocked() : before_(TakeInterpreterLock([] { return PyGILState_Ensure(); })) {}
  ~InterpreterLocked() { PyGILState_Release(before_); }
  InterpreterLocked(const InterpreterLocked&) = delete;
  InterpreterLocked& operator=(const InterpreterLocked&) = delete;

 private:
  PyGILState_STATE before_;
};

}  // namespace skein
