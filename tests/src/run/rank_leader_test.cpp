// SPDX-License-Identifier: Apache-2.0
#include "src/run/rank_leader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include "tests/train/ranks/thread_ranks.h"

namespace skein {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

cpu_set_t OwnProcessors() {
  cpu_set_t own{};
  EXPECT_EQ(sched_getaffinity(0, sizeof own, &own), 0);
  return own;
}

/// Leaves the calling thread `count` of the processors that it may use, from the one numbered
/// `first` among them on.
void KeepProcessors(int first, int count) {
  const cpu_set_t own = OwnProcessors();
  cpu_set_t kept{};
  int number = 0;
  for (std::size_t processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (!CPU_ISSET(processor, &own)) continue;
    if (number >= first && number < first + count) CPU_SET(processor, &kept);
    ++number;
  }
  EXPECT_EQ(sched_setaffinity(0, sizeof kept, &kept), 0);
}

class DescribeRanksTest : public ::testing::Test {
 protected:
  DescribeRanksTest() { config_.learner.shards = 2; }

  TrainConfig config_;
  const cpu_set_t own_ = OwnProcessors();
  const int processors_ = CPU_COUNT(&own_);
};

TEST_F(DescribeRanksTest, RanksThatShareProcessorsAreWarnedOfTheirThreadsTogether) {
  RunOnRanks(2, [&](Ranks& ranks) {
    KeepProcessors(0, 1);
    const WorkerPool pool(1);
    EXPECT_THAT(DescribeRanks(config_, pool, ranks),
                HasSubstr(" lets its ranks use 1 processor for 2 threads"));
  });
}

TEST_F(DescribeRanksTest, RanksWithProcessorsOfTheirOwnAreNot) {
  if (processors_ < 2) GTEST_SKIP() << "needs two processors";
  RunOnRanks(2, [&](Ranks& ranks) {
    KeepProcessors(ranks.rank(), 1);
    const WorkerPool pool(1);
    EXPECT_THAT(DescribeRanks(config_, pool, ranks), Not(HasSubstr("warning")));
  });
}

TEST_F(DescribeRanksTest, ARankThatHasTooFewIsWhereOthersHaveEnough) {
  if (processors_ < 3) GTEST_SKIP() << "needs three processors";
  RunOnRanks(2, [&](Ranks& ranks) {
    KeepProcessors(ranks.rank(), 1 + ranks.rank());
    const WorkerPool pool(2 - ranks.rank());
    EXPECT_THAT(DescribeRanks(config_, pool, ranks),
                HasSubstr(" lets a rank use 1 processor for 2 threads"));
  });
}

}  // namespace
}  // namespace skein
