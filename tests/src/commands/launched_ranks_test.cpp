// SPDX-License-Identifier: Apache-2.0
#include "src/commands/launched_ranks.h"

#include <gtest/gtest.h>

#include <new>

#include "base/error.h"
#include "src/config/usage_error.h"
#include "tests/error_message.h"
#include "tests/train/ranks/thread_ranks.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

TEST(WorkAsRankTest, WhatAllHaveBeenToldOfIsSaidByRankZeroAlone) {
  RunOnRanks(4, [](Ranks& ranks) {
    const std::string message = MessageOf([&] {
      WorkAsRank(ranks, [](Ranks& all) {
        DoTogether(all, [&] {
          if (all.rank() == 2) throw Error("no such file");
        });
      });
    });
    EXPECT_EQ(message, ranks.rank() == 0 ? "rank 2: no such file" : "");
  });
}

TEST(WorkAsRankTest, WhatBefallsARankAloneEndsAllAndIsSaid) {
  RunOnRanks(2, [](Ranks& ranks) {
    const auto fail = [&](const auto& failure) {
      return MessageOf([&] { WorkAsRank(ranks, [&](Ranks&) { throw failure; }); });
    };
    const std::string aborted = ranks.rank() == 0 ? "" : "aborted: ";
    EXPECT_EQ(fail(Error("no such file")), aborted + "no such file");
    if (ranks.rank() == 0) return;  // what is no Error is its caller's
    EXPECT_EQ(fail(std::bad_alloc()), "aborted: std::bad_alloc");
  });
}

TEST(WorkAsRankTest, OnlyPowersOfTwoWork) {
  RunOnRanks(3, [](Ranks& ranks) {
    const auto work = [&] { WorkAsRank(ranks, [](Ranks&) { ADD_FAILURE() << "has begun"; }); };
    if (ranks.rank() == 0) {
      EXPECT_THROW(work(), UsageError);
    } else {
      EXPECT_NO_THROW(work());
    }
  });
}

}  // namespace
}  // namespace skein
