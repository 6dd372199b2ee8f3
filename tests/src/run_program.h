// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/scratch_directory.h"

namespace skein {

/// How a run of the program `skein` ended.
struct ProgramResult {
  int exit_code = -1;  ///< -1 if a signal ended it
  int signal = 0;
  std::string output;  ///< standard output
  std::string error;   ///< standard error
};

/// Words that name a program of their own, such as mpirun.
struct ProgramWords {
  std::vector<std::string> words;
};

/// The program `skein`, or another one, as a child process.
class RunningProgram {
 public:
  explicit RunningProgram(const ProgramWords& program, const std::function<void()>& before = {});
  /// Starts it with the given arguments. `before` runs in the child ahead of the program (limits
  /// and the like).
  explicit RunningProgram(const std::vector<std::string>& arguments,
                          const std::function<void()>& before = {});
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void Signal(int signal) const;
  /// Whether `condition` came true while the program was running.
  bool WaitUntil(const std::function<bool()>& condition);
  ProgramResult Wait();
  /// What it has written to its standard output so far.
  std::string output() const;

 private:
  bool Reap(bool block);

  pid_t process_ = -1;
  int status_ = 0;
  bool ended_ = false;
  ScratchDirectory scratch_;
};

ProgramResult RunSkein(const std::vector<std::string>& arguments,
                       const std::function<void()>& before = {});

ProgramResult RunWords(const std::vector<std::string>& words);

/// The same without a process of its own, for what ends by itself: LibTorch is not loaded again.
ProgramResult CallSkein(const std::vector<std::string>& arguments);

}  // namespace skein
