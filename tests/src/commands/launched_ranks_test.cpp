// SPDX-License-Identifier: Apache-2.0
#include "src/commands/launched_ranks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/reason_of.h"
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
    EXPECT_EQ(fail(std::bad_alloc()), std::string("aborted: ") + ReasonOf(std::bad_alloc()));
  });
}

/// Rank 0 of two, of which the other comes to its end, or waits.
class Leader final : public Ranks {
 public:
  explicit Leader(bool all_end) : all_end_(all_end) {}
  int rank() const override { return 0; }
  int count() const override { return 2; }
  std::string Describe(int rank) const override { return "rank " + std::to_string(rank); }
  void ExchangeAll(int, const std::vector<Transfer>&) override {}
  void Notify(int, std::int64_t) override {}
  std::optional<Notice> TakeNotice() override { return std::nullopt; }
  bool EndsWithin(double) override { return all_end_; }
  [[noreturn]] void Abort(const char* reason) override {
    throw Error(std::string("aborted: ") + reason);
  }

 private:
  bool all_end_;
};

TEST(WorkAsRankTest, WhatBefallsRankZeroEndsAllIfTheOthersWaitForIt) {
  const auto fail = [](Leader leader) {
    return MessageOf([&] { WorkAsRank(leader, [](Ranks&) { throw UsageError("no such task"); }); });
  };
  EXPECT_EQ(fail(Leader(true)), "no such task");
  EXPECT_EQ(fail(Leader(false)), "aborted: no such task");
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
