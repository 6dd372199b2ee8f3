// SPDX-License-Identifier: Apache-2.0
#include "base/worker_pool.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/denormals.h"
#include "base/error.h"

// The thread sanitizer's runtime; null without it.
extern "C" {
[[gnu::weak]] void __tsan_acquire(void* address);
[[gnu::weak]] void __tsan_release(void* address);
}

namespace skein {
namespace {

// oneTBB's own synchronisation is invisible to the thread sanitizer, so this file is compiled
// without its checks (see CMakeLists.txt) and tells it what is ordered: what comes before a Release
// of an address is before what comes after an Acquire of it.
void Acquire(void* address) {
  if (__tsan_acquire != nullptr) __tsan_acquire(address);
}
void Release(void* address) {
  if (__tsan_release != nullptr) __tsan_release(address);
}

/// Tells the thread sanitizer what ForEach orders: the caller's work before every call, every call
/// before the caller's further work, but no call before another.
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
  char begin_ = 0, end_ = 0;
};

int ThreadCount(int threads) {
  if (threads < 0) {
    throw Error("worker pool: " + std::to_string(threads) +
                " threads; a positive number, or 0 for one per CPU");
  }
  return threads == 0 ? tbb::info::default_concurrency() : threads;
}

/// What keeps workers awake between one ForEach and the next: tasks that wait for it. They may
/// outlive the pool, and the last of them then destroys it, after the pool's use: the counts of
/// std::shared_ptr order that.
class Watch : public std::enable_shared_from_this<Watch> {
 public:
  explicit Watch(int workers) : workers_(workers) { Release(this); }
  ~Watch() { Acquire(this); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void BeginForEach() { calls_.fetch_add(1, std::memory_order_relaxed); }

  void EndForEach(tbb::task_arena* arena) {
    const std::uint64_t seen = calls_.load(std::memory_order_relaxed);
    // A process that was forked has no workers: no more tasks than these are ever left over there.
    while (watching_.load(std::memory_order_relaxed) < workers_) {
      watching_.fetch_add(1, std::memory_order_relaxed);
      arena->enqueue([self = shared_from_this(), seen] { self->WaitForNext(seen); });
    }
  }

 private:
  /// A few times what waking a worker takes.
  static constexpr std::chrono::microseconds kAwake{200};

  void WaitForNext(std::uint64_t seen) {
    const auto end = std::chrono::steady_clock::now() + kAwake;
    while (calls_.load(std::memory_order_relaxed) == seen &&
           std::chrono::steady_clock::now() < end) {
    }
    watching_.fetch_sub(1, std::memory_order_relaxed);
  }

  int workers_;
  std::atomic<std::uint64_t> calls_{0};
  std::atomic<int> watching_{0};  ///< tasks that wait or are about to
};

}  // namespace

struct WorkerPool::Arena {
  explicit Arena(int threads) : arena(threads) {}

  /// One for as many threads, of a pool that is gone or a new one. oneTBB 2021.8 gives workers to
  /// no arena any more once a process has made and destroyed some tens of them, so none is
  /// destroyed.
  static std::unique_ptr<Arena> Take(int threads);
  static void GiveBack(std::unique_ptr<Arena> arena);

  std::optional<tbb::global_control> more_threads;
  tbb::task_arena arena;
  std::shared_ptr<Watch> watch;  ///< null: workers sleep when they like

 private:
  /// Those that no pool has. Never destroyed: pools may be, late.
  struct Spare {
    std::mutex mutex;
    std::vector<std::unique_ptr<Arena>> arenas;
  };
  static Spare& AllSpare() {
    static auto* const spare = new Spare;
    return *spare;
  }
};

std::unique_ptr<WorkerPool::Arena> WorkerPool::Arena::Take(int threads) {
  Spare& spare = AllSpare();
  std::unique_ptr<Arena> taken;
  {
    const std::lock_guard<std::mutex> lock(spare.mutex);
    const auto found = std::find_if(
        spare.arenas.begin(), spare.arenas.end(),
        [&](const auto& unused) { return unused->arena.max_concurrency() == threads; });
    if (found != spare.arenas.end()) {
      taken = std::move(*found);
      spare.arenas.erase(found);
    }
  }
  if (taken == nullptr) taken = std::make_unique<Arena>(threads);
  // oneTBB makes no more threads than CPUs unless it is told to.
  if (threads > tbb::info::default_concurrency()) {
    taken->more_threads.emplace(tbb::global_control::max_allowed_parallelism,
                                static_cast<std::size_t>(threads));
  }
  return taken;
}

void WorkerPool::Arena::GiveBack(std::unique_ptr<Arena> arena) {
  arena->more_threads.reset();
  arena->watch.reset();
  Spare& spare = AllSpare();
  const std::lock_guard<std::mutex> lock(spare.mutex);
  spare.arenas.push_back(std::move(arena));
}

WorkerPool::WorkerPool(int threads)
    : threads_(ThreadCount(threads)), arena_(Arena::Take(threads_)) {}

WorkerPool::~WorkerPool() { Arena::GiveBack(std::move(arena_)); }

void WorkerPool::ForEach(int count, const std::function<void(int index, int worker)>& body) {
  if (threads_ == 1) {
    const DenormalsFlushed flushed;
    for (int index = 0; index < count; ++index) body(index, 0);
    return;
  }
  ForEachOrder order;
  if (arena_->watch) arena_->watch->BeginForEach();
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
  if (arena_->watch) arena_->watch->EndForEach(&arena_->arena);
}

void WorkerPool::StayAwake() {
  // More than CPUs would wait in each other's way.
  if (threads_ <= tbb::info::default_concurrency()) {
    arena_->watch = std::make_shared<Watch>(threads_ - 1);
  }
}

}  // namespace skein
