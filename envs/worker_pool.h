#pragma once

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

  int threads() const { return threads_; }

  /// Calls body(index, worker) once for every index in [0, count), each on some worker in [0,
  /// threads()); returns when all have run. The first exception is rethrown. Calls of one worker
  /// never overlap.
  void ForEach(int count, const std::function<void(int index, int worker)>& body);

 private:
  struct Arena;
  int threads_ = 1;
  std::unique_ptr<Arena> arena_;
};

}  // namespace skein
