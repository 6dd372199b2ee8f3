// SPDX-License-Identifier: Apache-2.0
#include "simd/work_rates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace skein::simd {
namespace {

using ::testing::ElementsAre;

TEST(WorkRates, OfTheSlowestAreOfTheWorkOfAllThreads) {
  // Two repetitions of two threads.
  const WorkRates rates = RatesOf({3, 5, 4, 4}, {2, 1, 4, 8}, 2);
  EXPECT_THAT(rates.of_slowest, ElementsAre((4 + 4) / 8.0, (3 + 5) / 2.0));
  EXPECT_THAT(rates.summed, ElementsAre(4 / 4.0 + 4 / 8.0, 3 / 2.0 + 5 / 1.0));
}

TEST(WorkRates, OfOneThreadAreItsOwn) {
  const WorkRates rates = RatesOf({6, 6, 6}, {1, 3, 2}, 1);
  EXPECT_THAT(rates.of_slowest, ElementsAre(2, 3, 6));
  EXPECT_EQ(rates.summed, rates.of_slowest);
}

std::atomic<int> sleeps{0};
constexpr double kWorkPerSecond = 3000;

/// A round takes a millisecond or more.
double Sleep(std::int64_t rounds, float* sink) {
  ++sleeps;
  std::this_thread::sleep_for(std::chrono::milliseconds(rounds));
  *sink = 0;
  return kWorkPerSecond * 1e-3 * static_cast<double>(rounds);
}

TEST(WorkRates, MeasuredAreOfEveryThreadsWork) {
  constexpr int kRepetitions = 5, kThreads = 3;
  constexpr std::int64_t kRounds = 2;
  sleeps = 0;
  const WorkRates rates = MeasureRates(&Sleep, kRounds, kRepetitions, kThreads);
  EXPECT_EQ(sleeps, kRepetitions * kThreads);
  ASSERT_EQ(rates.of_slowest.size(), std::size_t{kRepetitions});
  ASSERT_EQ(rates.summed.size(), std::size_t{kRepetitions});
  EXPECT_TRUE(std::is_sorted(rates.of_slowest.begin(), rates.of_slowest.end()));
  // Nobody is faster than the sleep; how much slower depends on the machine.
  EXPECT_GT(rates.of_slowest.front(), 0);
  EXPECT_LE(rates.of_slowest.back(), kThreads * kWorkPerSecond);
  EXPECT_LE(rates.summed.back(), kThreads * kWorkPerSecond);
}

}  // namespace
}  // namespace skein::simd
