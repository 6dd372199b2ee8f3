// SPDX-License-Identifier: Apache-2.0
// Of two processes, which mpirun starts.
#include "train/mpi/mpi_ranks.h"

#include <gtest/gtest.h>

#include <random>

namespace skein {
namespace {

constexpr double kTimeoutS = 60;
constexpr std::size_t kMostBytes = 1000;

/// A process joins a job once.
MpiRanks& Joined() {
  static MpiRanks ranks(kTimeoutS, kMostBytes);
  return ranks;
}

std::vector<std::uint32_t> NumbersOf(int rank, std::size_t count) {
  std::mt19937 generator(static_cast<std::uint32_t>(rank));
  std::vector<std::uint32_t> numbers(count);
  for (std::uint32_t& number : numbers) number = static_cast<std::uint32_t>(generator());
  return numbers;
}

TEST(MpiRanksTest, WhatIsLongerThanAMessageArrivesWhole) {
  MpiRanks& ranks = Joined();
  ASSERT_EQ(ranks.count(), 2);
  const int partner = 1 - ranks.rank();
  constexpr std::size_t kNumbers = kMostBytes / sizeof(std::uint32_t);
  for (const std::size_t count : {kNumbers - 1, kNumbers, kNumbers + 1, 10 * kNumbers + 3}) {
    // One after the other, and one way more than the other.
    std::vector<std::uint32_t> first(count), second(count * (partner + 1));
    const auto own_first = NumbersOf(ranks.rank(), first.size());
    const auto own_second = NumbersOf(ranks.rank(), count * (ranks.rank() + 1));
    const auto bytes = [](const auto& numbers) { return numbers.size() * sizeof numbers[0]; };
    ranks.ExchangeAll(partner,
                      {{own_first.data(), bytes(own_first), first.data(), bytes(first)},
                       {own_second.data(), bytes(own_second), second.data(), bytes(second)}});
    EXPECT_EQ(first, NumbersOf(partner, first.size())) << count;
    EXPECT_EQ(second, NumbersOf(partner, second.size())) << count;
  }
}

TEST(MpiRanksTest, ARankLearnsWhetherAllHaveComeToTheirEnd) {
  MpiRanks& ranks = Joined();
  ASSERT_EQ(ranks.count(), 2);
  int word = 7;
  if (ranks.rank() == 0) {
    EXPECT_FALSE(ranks.EndsWithin(0.1)) << "the other still waits";
    ranks.Exchange(1, &word, sizeof word, nullptr, 0);
  } else {
    ranks.Exchange(0, nullptr, 0, &word, sizeof word);
  }
  EXPECT_TRUE(ranks.EndsWithin(kTimeoutS));
  EXPECT_TRUE(ranks.EndsWithin(0)) << "and knows it from then on";
}

}  // namespace
}  // namespace skein
