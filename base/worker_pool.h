// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>

namespace skein {

/// A fixed number of worker threads (a oneTBB arena). Denormals are flushed to zero on every worker
/// while it runs tasks.
class WorkerPool {
 public:
  /// `threads` 0 means one per CPU that this process may use.
  explicit WorkerPool(int threads = 0);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int threads() const { return threads_; }  ///< of the pool, at least 1

  /// Calls body(index, worker) once for every index in [0, count), each on some worker in [0,
  /// threads()); returns when all have run. Calls of one worker never overlap if one thread
  /// at a time calls ForEach on a pool; a body that does so calls within its own. The first
  /// exception is rethrown, and which of the others have run by then is open.
  void ForEach(int count, const std::function<void(int index, int worker)>& body);

  /// From now on, workers that have nothing to do sleep only after 0.2 ms, so that a ForEach that
  /// begins before has them at once: waking them takes about as long as they take to step a small
  /// batch. They use their CPUs meanwhile; where there are more of them than CPUs, nothing changes.
  void StayAwake();

  /// Asks whoever works on the pool to give up, for good: long bodies ask stopping() now and
  /// then and return early. What they leave is incomplete, and their caller throws it away when it
  /// sees stopping(). From any thread, or a signal handler.
  void RequestStop() { stopping_.store(true, std::memory_order_release); }
  /// Whether it was asked.
  bool stopping() const { return stopping_.load(std::memory_order_acquire); }

 private:
  struct Arena;
  static_assert(std::atomic<bool>::is_always_lock_free, "set in signal handlers");
  std::atomic<bool> stopping_{false};
  int threads_ = 1;
  std::unique_ptr<Arena> arena_;
};

}  // namespace skein
