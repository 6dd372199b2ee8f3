// SPDX-License-Identifier: Apache-2.0
#include "base/worker_pool.h"

#include <atomic>
#include <chrono>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "gtest/gtest.h"

namespace skein {
namespace {

constexpr int kCount = 1000;

class WorkerPoolTest : public testing::TestWithParam<int> {
 protected:
  WorkerPool pool_{GetParam()};
};

TEST_P(WorkerPoolTest, EveryIndexRunsOnce) {
  std::vector<std::atomic<int>> runs(kCount);
  pool_.ForEach(kCount, [&](int index, int) { ++runs[index]; });
  for (const auto& run : runs) EXPECT_EQ(run, 1);
}

TEST_P(WorkerPoolTest, WorkersThatStayAwakeWorkAsBefore) {
  pool_.StayAwake();
  std::atomic<int> runs{0};
  for (int round = 0; round < kCount; ++round) pool_.ForEach(GetParam(), [&](int, int) { ++runs; });
  EXPECT_EQ(runs, kCount * GetParam());
}

/// Whether as many calls run at the same time: each waits for all the others.
bool RunTogether(WorkerPool* pool, int count) {
  std::atomic<int> arrived{0};
  std::atomic<bool> met{true};
  pool->ForEach(count, [&](int, int) {
    ++arrived;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (arrived < count) {
      if (std::chrono::steady_clock::now() > deadline) {
        met = false;
        return;
      }
      std::this_thread::yield();
    }
  });
  return met;
}

TEST(WorkerPool, HasItsWorkersHoweverManyCameBeforeIt) {
  std::atomic<int> runs{0};
  for (int round = 0; round < kCount; ++round) {
    WorkerPool pool(2);
    if (round % 2 == 0) pool.StayAwake();
    pool.ForEach(2, [&](int, int) { ++runs; });
  }
  EXPECT_EQ(runs, 2 * kCount);
  WorkerPool pool(2);
  EXPECT_TRUE(RunTogether(&pool, 2));
}

TEST_P(WorkerPoolTest, CallsOfOneWorkerNeverOverlap) {
  ASSERT_EQ(pool_.threads(), GetParam());
  std::vector<std::atomic<int>> inside(pool_.threads());
  std::atomic<bool> overlap{false}, out_of_range{false};
  pool_.ForEach(kCount, [&](int, int worker) {
    if (worker < 0 || worker >= pool_.threads()) {
      out_of_range = true;
      return;
    }
    if (inside[worker]++ != 0) overlap = true;
    std::this_thread::yield();
    --inside[worker];
  });
  EXPECT_FALSE(overlap);
  EXPECT_FALSE(out_of_range);
}

TEST_P(WorkerPoolTest, ThreadsRunAtTheSameTime) { EXPECT_TRUE(RunTogether(&pool_, GetParam())); }

TEST_P(WorkerPoolTest, AnExceptionReachesTheCallerAndThePoolWorksOn) {
  const auto fail = [&] {
    pool_.ForEach(kCount, [](int index, int) {
      if (index == 7) throw Error("index 7 failed");
    });
  };
  EXPECT_THROW(fail(), Error);
  std::atomic<int> runs{0};
  pool_.ForEach(kCount, [&](int, int) { ++runs; });
  EXPECT_EQ(runs, kCount);
}

TEST_P(WorkerPoolTest, NestedUseRunsEverythingAndKeepsOuterCallsApart) {
  constexpr int kOuter = 40, kInner = 40;
  std::vector<std::atomic<int>> inside(pool_.threads());
  std::atomic<int> runs{0};
  std::atomic<bool> overlap{false};
  pool_.ForEach(kOuter, [&](int, int worker) {
    if (inside[worker]++ != 0) overlap = true;
    pool_.ForEach(kInner, [&](int, int) { ++runs; });
    --inside[worker];
  });
  EXPECT_EQ(runs, kOuter * kInner);
  EXPECT_FALSE(overlap);
}

TEST_P(WorkerPoolTest, DenormalsAreFlushedInsideOnly) {
  volatile float smallest = std::numeric_limits<float>::min();
  std::atomic<int> not_flushed{0};
  pool_.ForEach(kCount, [&](int, int) {
    if (smallest * 0.5f != 0) ++not_flushed;
  });
  EXPECT_EQ(not_flushed, 0);
  EXPECT_NE(smallest * 0.5f, 0);
}

TEST_P(WorkerPoolTest, AStopIsSeenByEveryCallAndStays) {
  EXPECT_FALSE(pool_.stopping());
  // Each call waits for the stop, which comes from outside.
  std::thread outside([&] { pool_.RequestStop(); });
  std::atomic<int> runs{0};
  pool_.ForEach(kCount, [&](int, int) {
    while (!pool_.stopping()) std::this_thread::yield();
    ++runs;
  });
  outside.join();
  EXPECT_EQ(runs, kCount) << "every index is still called";
  EXPECT_TRUE(pool_.stopping());
}

TEST_P(WorkerPoolTest, NothingToDoIsNoError) {
  pool_.ForEach(0, [](int, int) { FAIL(); });
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkerPoolTest, testing::Values(1, 2, 8),
                         [](const auto& test) { return std::to_string(test.param); });

TEST(WorkerPool, ZeroMeansEveryCpuAndNegativeIsAnError) {
  EXPECT_GE(WorkerPool(0).threads(), 1);
  EXPECT_THROW(WorkerPool(-1), Error);
}

}  // namespace
}  // namespace skein
