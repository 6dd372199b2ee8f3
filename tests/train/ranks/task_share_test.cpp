// SPDX-License-Identifier: Apache-2.0
#include "train/ranks/task_share.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <thread>

#include "tests/error_message.h"
#include "tests/train/ranks/thread_ranks.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

constexpr int kTasks = 12;

std::vector<int> AllTasks() {
  std::vector<int> tasks(kTasks);
  std::iota(tasks.begin(), tasks.end(), 0);
  return tasks;
}

/// Who has done what; from any thread.
class Record {
 public:
  void Add(int task, int rank) {
    const std::lock_guard lock(mutex_);
    done_.emplace_back(task, rank);
  }
  std::vector<int> Tasks() const {
    std::vector<int> tasks;
    for (const auto& [task, rank] : done_) tasks.push_back(task);
    std::sort(tasks.begin(), tasks.end());
    return tasks;
  }
  std::size_t CountOf(int rank) const {
    return static_cast<std::size_t>(std::count_if(
        done_.begin(), done_.end(), [&](const auto& one) { return one.second == rank; }));
  }
  int RankOf(int task) const {
    const auto is_it = [&](const auto& one) { return one.first == task; };
    return std::find_if(done_.begin(), done_.end(), is_it)->second;
  }
  bool operator==(const Record& other) const {
    auto a = done_, b = other.done_;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return done_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::pair<int, int>> done_;
};

class TaskShareTest : public testing::TestWithParam<int> {
 protected:
  /// On every rank: shares AllTasks out, and notes on rank 0 what was said of who takes what.
  bool DoAll(Ranks& ranks, WorkerPool& pool, const std::function<void(int, TaskShare&)>& work) {
    TaskShare share(ranks, pool, ranks.rank() == 0 ? AllTasks() : std::vector<int>{},
                    [this](int task, int rank) { taken_.Add(task, rank); });
    return share.Do([&](int task) {
      done_.Add(task, ranks.rank());
      work(task, share);
    });
  }

  Record taken_, done_;
};

TEST_P(TaskShareTest, EveryTaskIsDoneOnceByTheRankThatTookIt) {
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool pool(1);
    EXPECT_TRUE(DoAll(ranks, pool, [](int, TaskShare& share) { share.GoesOn(); }));
  });
  EXPECT_EQ(done_.Tasks(), AllTasks());
  EXPECT_TRUE(done_ == taken_);
}

TEST_P(TaskShareTest, WhoHasALongTaskDoesNotHoldUpTheOthers) {
  if (GetParam() == 1) GTEST_SKIP() << "there are no others";
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool pool(1);
    EXPECT_TRUE(DoAll(ranks, pool, [&](int task, TaskShare& share) {
      // Until all others are done, by other ranks.
      while (task == 0 && done_.size() < kTasks) {
        ASSERT_TRUE(share.GoesOn());
        std::this_thread::yield();
      }
    }));
  });
  EXPECT_EQ(done_.CountOf(done_.RankOf(0)), 1u) << "its rank had no time for more";
}

TEST_P(TaskShareTest, AFailureEndsAllAndIsThrownOnAll) {
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool pool(1);
    const std::string message = MessageOf([&] {
      DoAll(ranks, pool, [&](int task, TaskShare& share) {
        if (task == 0) throw Error("disk full");
        while (share.GoesOn()) std::this_thread::yield();
      });
    });
    EXPECT_THAT(message, HasSubstr("disk full")) << ranks.rank();
    EXPECT_TRUE(pool.stopping());
  });
  EXPECT_LE(done_.size(), static_cast<std::size_t>(GetParam()));
}

TEST_P(TaskShareTest, AFailureToSayWhoTakesATaskEndsAllAndIsThrownOnAll) {
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool pool(1);
    TaskShare share(ranks, pool, ranks.rank() == 0 ? AllTasks() : std::vector<int>{},
                    [](int task, int) {
                      if (task == 3) throw Error("the output broke");
                    });
    const std::string message = MessageOf([&] { share.Do([](int) {}); });
    EXPECT_THAT(message, HasSubstr("the output broke")) << ranks.rank();
    EXPECT_TRUE(pool.stopping());
  });
}

TEST_P(TaskShareTest, AStopOfOneRankStopsAll) {
  const int last = GetParam() - 1;
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool pool(1);
    EXPECT_FALSE(DoAll(ranks, pool, [&](int, TaskShare& share) {
      if (ranks.rank() == last) pool.RequestStop();
      while (share.GoesOn()) std::this_thread::yield();
    }));
    EXPECT_TRUE(pool.stopping());
  });
  EXPECT_LE(done_.size(), static_cast<std::size_t>(GetParam()));
}

TEST_P(TaskShareTest, NothingToDoIsDoneAtOnce) {
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool pool(1);
    TaskShare share(ranks, pool, {}, [](int, int) { FAIL(); });
    EXPECT_TRUE(share.Do([](int) { FAIL(); }));
  });
}

INSTANTIATE_TEST_SUITE_P(Ranks, TaskShareTest, testing::Values(1, 2, 4, 8),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace skein
