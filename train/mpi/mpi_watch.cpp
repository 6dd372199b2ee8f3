// SPDX-License-Identifier: Apache-2.0
#include "train/mpi/mpi_watch.h"

#include <unistd.h>

#include <cstdio>

namespace skein {
namespace {

constexpr std::chrono::milliseconds kInterval{100};

}  // namespace

MpiWatch::MpiWatch(const char* doing, std::chrono::duration<double> timeout)
    : doing_(doing), timeout_(timeout), launcher_(getppid()), thread_([this] { Watch(); }) {}

MpiWatch::~MpiWatch() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void MpiWatch::Watch() {
  auto start = std::chrono::steady_clock::now(), looked = start;
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, kInterval, [this] { return is_over_; })) {
    // The processes of one that has ended are another's.
    if (getppid() != launcher_) End("the launcher has ended");
    const auto now = std::chrono::steady_clock::now();
    if (now - looked > kStandstill) start = now;
    looked = now;
    if (now - start > timeout_) {
      char reason[80];
      std::snprintf(reason, sizeof reason, "MPI has not answered for %g s (--rank-timeout)",
                    timeout_.count());
      End(reason);
    }
  }
}

void MpiWatch::End(const char* reason) const {
  std::fprintf(stderr, "skein: error: %s while ranks %s\n", reason, doing_);
  std::fflush(stderr);
  // Not std::exit: destructors would wait for MPI.
  _exit(1);
}

}  // namespace skein
