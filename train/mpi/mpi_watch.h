// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace skein {

/// Who waits looks at the clock many times a second. A process that has not for so long stood still
/// itself, with its job or its machine (scontrol suspend, a virtual machine that was paused): that
/// was no waiting.
inline constexpr std::chrono::seconds kStandstill{10};

/// Ends this process, with one line on standard error and exit code 1, if MPI, while this is there,
/// takes longer than `timeout`, or if the launcher ends: what MPI does at its start and at its end
/// cannot be interrupted, and waits for a launcher that is no more.
class MpiWatch {
 public:
  /// `doing` says what ranks do in the meantime, such as "start".
  MpiWatch(const char* doing, std::chrono::duration<double> timeout);
  ~MpiWatch();

 private:
  void Watch();
  [[noreturn]] void End(const char* reason) const;

  const char* doing_;
  std::chrono::duration<double> timeout_;
  pid_t launcher_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace skein
