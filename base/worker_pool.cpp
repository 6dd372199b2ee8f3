// SPDX-License-Identifier: Apache-2.0
#include "base/worker_pool.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>
#include <optional>
#include <string>

#include "base/denormals.h"
#include "base/error.h"

// The thread sanitizer's runtime; null without it.
extern "C" {
[[gnu::weak]] void __tsan_acquire(void* address);
[[gnu::weak]] void __tsan_release(void* address);
}

namespace skein {
namespace {

/// Tells the thread sanitizer what ForEach orders: the caller's work before every call, every call
/// before the caller's further work, but no call before another. oneTBB's own synchronisation is
/// invisible to it, so this file is compiled without its checks (see CMakeLists.txt).
class ForEachOrder {
 public:
  ForEachOrder() { Release(&begin_); }
  ~ForEachOrder() { Acquire(&end_); }
  ForEachOrder(const ForEachOrder&) = delete;
  ForEachOrder& operator=(const ForEachOrder&) = delete;

  /// One worker's share of the calls.
  class Calls {
   public:
    explicit Calls(ForEachOrder* order) : order_(order) { Acquire(&order_->begin_); }
    ~Calls() { Release(&order_->end_); }
    Calls(const Calls&) = delete;
    Calls& operator=(const Calls&) = delete;

   private:
    ForEachOrder* order_;
  };

 private:
  static void Acquire(char* address) {
    if (__tsan_acquire != nullptr) __tsan_acquire(address);
  }
  static void Release(char* address) {
    if (__tsan_release != nullptr) __tsan_release(address);
  }

  char begin_ = 0, end_ = 0;
};

int ThreadCount(int threads) {
  if (threads < 0) {
    throw Error("worker pool: " + std::to_string(threads) +
                " threads; a positive number, or 0 for one per CPU");
  }
  return threads == 0 ? tbb::info::default_concurrency() : threads;
}

}  // namespace

struct WorkerPool::Arena {
  explicit Arena(int threads) : arena(threads) {
    // oneTBB makes no more threads than CPUs unless it is told to.
    if (threads > tbb::info::default_concurrency()) {
      more_threads.emplace(tbb::global_control::max_allowed_parallelism,
                           static_cast<std::size_t>(threads));
    }
  }

  std::optional<tbb::global_control> more_threads;
  tbb::task_arena arena;
};

WorkerPool::WorkerPool(int threads)
    : threads_(ThreadCount(threads)), arena_(std::make_unique<Arena>(threads_)) {}

WorkerPool::~WorkerPool() = default;

void WorkerPool::ForEach(int count, const std::function<void(int index, int worker)>& body) {
  if (threads_ == 1) {
    const DenormalsFlushed flushed;
    for (int index = 0; index < count; ++index) body(index, 0);
    return;
  }
  ForEachOrder order;
  arena_->arena.execute([&] {
    // Isolated, so that a worker that waits for a nested ForEach does not begin another index of
    // the outer one.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(
          tbb::blocked_range<int>(0, count, 1),
          [&](const tbb::blocked_range<int>& range) {
            const DenormalsFlushed flushed;
            const ForEachOrder::Calls calls(&order);
            const int worker = tbb::this_task_arena::current_thread_index();
            for (int index = range.begin(); index != range.end(); ++index) body(index, worker);
          },
          tbb::simple_partitioner());
    });
  });
}

}  // namespace skein
