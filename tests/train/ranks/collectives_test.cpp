// SPDX-License-Identifier: Apache-2.0
#include "train/ranks/collectives.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <numeric>
#include <random>

#include "base/error.h"
#include "base/reason_of.h"
#include "tests/error_message.h"
#include "tests/train/ranks/thread_ranks.h"
#include "train/ppo/shards.h"
#include "train/ranks/timed_ranks.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

class CollectivesTest : public testing::TestWithParam<int> {};

TEST_P(CollectivesTest, SumsAreThoseOfTheTreeAndTheSameOnAllRanks) {
  std::mt19937 generator(1);
  std::normal_distribution<float> normal;
  std::vector<float> numbers(static_cast<std::size_t>(GetParam()));
  for (float& number : numbers) number = normal(generator);
  const float expected = SumByTree(numbers);
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    float sum = numbers[static_cast<std::size_t>(ranks.rank())];
    SumOverRanks(ranks, 1, &sum);
    EXPECT_EQ(sum, expected) << ranks.Describe(ranks.rank());
  });
}

TEST_P(CollectivesTest, SumsOfManyNumbersAreThoseOfTheTreeAndTheSameOnAllRanks) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{5}, 3 * kSummedByParts / 8 + 1}) {
    std::mt19937 generator(1);
    std::normal_distribution<float> normal;
    std::vector<std::vector<float>> numbers(static_cast<std::size_t>(GetParam()));
    for (std::vector<float>& of_rank : numbers) {
      for (std::size_t i = 0; i < count; ++i) of_rank.push_back(normal(generator));
    }
    std::vector<float> expected;
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<float> parts;
      for (const std::vector<float>& of_rank : numbers) parts.push_back(of_rank[i]);
      expected.push_back(SumByTree(parts));
    }
    RunOnRanks(GetParam(), [&](Ranks& ranks) {
      std::vector<float> sums = numbers[static_cast<std::size_t>(ranks.rank())];
      int more = ranks.rank();
      SumManyOverRanks(ranks, count, sums.data(), more);
      EXPECT_EQ(sums, expected) << ranks.Describe(ranks.rank());
      EXPECT_EQ(more, (ranks.count() - 1) * ranks.count() / 2);
    });
  }
}

TEST_P(CollectivesTest, NoRankSendsManyNumbersMoreThanTwice) {
  constexpr std::size_t kCount = kSummedByParts;
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    TimedRanks timed(ranks);
    std::vector<float> sums(kCount);
    int more = 0;
    SumManyOverRanks(timed, kCount, sums.data(), more);
    std::size_t expected = 2 * (kCount - kCount / static_cast<std::size_t>(ranks.count()));
    expected *= sizeof(float);
    for (int others = 1; others < ranks.count(); others *= 2) expected += sizeof more;
    EXPECT_EQ(timed.sent_bytes(), expected);
  });
}

TEST_P(CollectivesTest, ASumSaysWhetherSomeRankGivesUp) {
  const int last = GetParam() - 1;
  for (const bool gives_up : {false, true}) {
    RunOnRanks(GetParam(), [&](Ranks& ranks) {
      int sum = ranks.rank();
      const bool here = gives_up && ranks.rank() == last;
      EXPECT_EQ(SumOverRanksOrGiveUp(ranks, here, sum), gives_up);
      EXPECT_EQ(sum, last * ranks.count() / 2);
    });
  }
}

TEST_P(CollectivesTest, AStopOnOneRankIsEveryRanks) {
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool pool(1);
    EXPECT_FALSE(AgreeOnStop(ranks, pool));
    if (ranks.rank() == ranks.count() / 2) pool.RequestStop();
    EXPECT_TRUE(AgreeOnStop(ranks, pool));
    EXPECT_TRUE(pool.stopping());
  });
}

TEST_P(CollectivesTest, WhatRankZeroDoesFailsOnAll) {
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    int done = 0;
    DoOnRankZero(ranks, [&] { ++done; });
    EXPECT_EQ(done, ranks.rank() == 0 ? 1 : 0);
    EXPECT_THAT(MessageOf([&] { DoOnRankZero(ranks, [] { throw Error("no space"); }); }),
                HasSubstr("no space"));
  });
}

TEST_P(CollectivesTest, SharesReachAllRanksInOrderHoweverUnequal) {
  for (const int size : {1, 5, 40}) {
    std::vector<int> expected(static_cast<std::size_t>(size));
    std::iota(expected.begin(), expected.end(), 100);
    RunOnRanks(GetParam(), [&](Ranks& ranks) {
      std::vector<int> values(expected.size(), -1);
      const auto begin = ShareBegin(size, ranks.rank(), ranks);
      const auto end = ShareBegin(size, ranks.rank() + 1, ranks);
      std::copy(expected.begin() + begin, expected.begin() + end, values.begin() + begin);
      ShareWithAllRanks(ranks, values);
      EXPECT_EQ(values, expected);
    });
  }
}

TEST_P(CollectivesTest, RankZeroGathersInOrder) {
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    std::vector<int> values{2 * ranks.rank(), 2 * ranks.rank() + 1};
    GatherAtRankZero(ranks, values);
    if (ranks.rank() != 0) return;
    std::vector<int> expected(2 * static_cast<std::size_t>(GetParam()));
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(values, expected);
  });
}

TEST_P(CollectivesTest, RankZerosValuesReachAll) {
  const std::vector<int> expected{3, 1, 4, 1, 5};
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    std::vector<int> values(expected.size(), -ranks.rank());
    if (ranks.rank() == 0) values = expected;
    ShareRankZeros(ranks, values);
    EXPECT_EQ(values, expected) << ranks.Describe(ranks.rank());
  });
}

TEST_P(CollectivesTest, WhatFailsOnOneRankFailsOnAllAndIsNamed) {
  const int last = GetParam() - 1;
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    DoTogether(ranks, [] {});
    const std::string message = MessageOf([&] {
      DoTogether(ranks, [&] {
        if (ranks.rank() == last) throw Error("no such file");
      });
    });
    EXPECT_THAT(message, HasSubstr("no such file"));
    if (ranks.rank() != last) {
      EXPECT_THAT(message, HasSubstr("rank " + std::to_string(last)));
    }
  });
}

TEST_P(CollectivesTest, WhatAllHaveBeenToldOfIsAnError) {
  const int last = GetParam() - 1;
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    const auto fail = [&] {
      if (ranks.rank() == last) throw std::bad_alloc();
    };
    if (last == 0) {
      EXPECT_THROW(DoTogether(ranks, fail), std::bad_alloc) << "rank 0 throws its own exception";
    } else {
      EXPECT_THROW(DoTogether(ranks, fail), JointError);
      EXPECT_EQ(MessageOf([&] { DoTogether(ranks, fail); }),
                "rank " + std::to_string(last) + ": " + ReasonOf(std::bad_alloc()));
    }
  });
}

TEST_P(CollectivesTest, WhatOthersWaitForFailsOnAllUnlessTheyKnow) {
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    EXPECT_EQ(DoForOthers(ranks, [] { return 7; }), 7);
    const auto fail = [&](const auto& failure) {
      return MessageOf([&] { DoForOthers(ranks, [&] { throw failure; }); });
    };
    EXPECT_EQ(fail(JointError("rank 3: no space")), "rank 3: no space");
    EXPECT_EQ(fail(Error("no space")), ranks.count() == 1 ? "no space" : "aborted: no space");
    if (ranks.count() == 1) return;  // what is no Error is its caller's
    EXPECT_EQ(fail(std::bad_alloc()), std::string("aborted: ") + ReasonOf(std::bad_alloc()));
  });
}

TEST_P(CollectivesTest, RanksThatDifferAreNamedOnAll) {
  const int last = GetParam() - 1;
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    RequireSameOnRanks(ranks, "the version", "1.0");
    const std::string message = MessageOf(
        [&] { RequireSameOnRanks(ranks, "the version", ranks.rank() == last ? "1.1" : "1.0"); });
    if (last == 0) {
      EXPECT_EQ(message, "");
    } else {
      EXPECT_EQ(message, "ranks differ in the version: rank 0 has 1.0, rank " +
                             std::to_string(last) + " 1.1");
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Ranks, CollectivesTest, testing::Values(1, 2, 4, 8, 16),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace skein
