// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/tolerance.h"

namespace skein {
namespace {

const double kNaN = std::nan("");
constexpr Tolerance kExpansion{2e-3, "an expansion in the degrees of freedom, relative"};
constexpr Tolerance kTableDigits{1e-3, "three decimals of the table"};
constexpr Tolerance kDigits{5e-5, "four decimals published"};
constexpr Tolerance kRounding{1e-12, "float64 rounding"};
constexpr Tolerance kHandRounding{1e-9, "digits of the normal distribution's 1.959964"};

TEST(EstimateTest, StudentPointsAreThoseOfTheTables) {
  // Abramowitz and Stegun (1964), table 26.10, and the normal distribution for many degrees.
  const double expected[][2] = {{1, 12.706}, {2, 4.303},  {3, 3.182},   {4, 2.776},
                                {9, 2.262},  {29, 2.045}, {120, 1.980}, {1e9, 1.95996}};
  for (const auto& [degrees, point] : expected) {
    EXPECT_NEAR(StudentPoint(static_cast<int>(degrees)) / point, 1, kExpansion) << degrees;
  }
}

TEST(EstimateTest, MeanByHand) {
  // Mean 3, variance 2.5, standard error sqrt(0.5), t(4) = 2.776.
  const Estimate estimate = EstimateMean({1, 2, kNaN, 3, 4, 5});
  EXPECT_EQ(estimate.value, 3);
  EXPECT_EQ(estimate.count, 5);
  EXPECT_NEAR(estimate.low, 3 - 2.776 * std::sqrt(0.5), kTableDigits);
  EXPECT_NEAR(estimate.high, 3 + 2.776 * std::sqrt(0.5), kTableDigits);
}

TEST(EstimateTest, TooFewValuesSaySo) {
  EXPECT_TRUE(std::isnan(EstimateMean({}).value));
  EXPECT_TRUE(std::isnan(EstimateMean({kNaN}).value));
  const Estimate one = EstimateMean({7});
  EXPECT_EQ(one.value, 7);
  EXPECT_TRUE(std::isnan(one.low));
  EXPECT_TRUE(std::isnan(EstimateShare(0, 0).value));
}

TEST(EstimateTest, IntervalOfTheMeanCoversIt) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(2, 3);
  int covered = 0;
  constexpr int kSamples = 4000;
  for (int sample = 0; sample < kSamples; ++sample) {
    const Estimate estimate =
        EstimateMean({normal(random), normal(random), normal(random), normal(random)});
    covered += estimate.low <= 2 && 2 <= estimate.high;
  }
  EXPECT_NEAR(covered / static_cast<double>(kSamples), 0.95,
              kStandardErrors * std::sqrt(0.95 * 0.05 / kSamples));
}

TEST(EstimateTest, SharesAreWilsons) {
  // Newcombe, Statistics in Medicine 17 (1998) 857, table I, method 3.
  const Estimate common = EstimateShare(81, 263);
  EXPECT_NEAR(common.low, 0.2553, kDigits);
  EXPECT_NEAR(common.high, 0.3662, kDigits);
  const Estimate rare = EstimateShare(1, 29);
  EXPECT_NEAR(rare.low, 0.0061, kDigits);
  EXPECT_NEAR(rare.high, 0.1718, kDigits);
  const Estimate none = EstimateShare(0, 20), all = EstimateShare(20, 20);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 0.1611, kDigits);
  EXPECT_EQ(all.high, 1);
  EXPECT_NEAR(all.low, 1 - none.high, kRounding);
}

TEST(EstimateTest, RatesHaveGarwoodsInterval) {
  // Ulm, American Journal of Epidemiology 131 (1990) 373: exact limits of Poisson counts.
  const double expected[][3] = {{0, 0, 3.689},
                                {1, 0.0253, 5.572},
                                {5, 1.623, 11.668},
                                {10, 4.795, 18.390},
                                {100, 81.364, 121.627}};
  for (const auto& [events, low, high] : expected) {
    const Estimate rate = EstimateRate(static_cast<int>(events), 4);
    EXPECT_EQ(rate.value, events / 4);
    EXPECT_NEAR(rate.low * 4, low, kTableDigits) << events;
    EXPECT_NEAR(rate.high * 4, high, kTableDigits) << events;
    EXPECT_EQ(rate.count, events);
  }
  EXPECT_TRUE(std::isnan(EstimateRate(0, 0).value));
}

TEST(EstimateTest, PairedSharesByHand) {
  // Of 100, 5 and 15 discordant: (15.5 - 5.5) / 102 +- 1.96 sqrt(21 - 100 / 102) / 102.
  const PairedShares paired = CompareShares(5, 15, 100);
  EXPECT_DOUBLE_EQ(paired.difference.value, 0.1);
  EXPECT_NEAR(paired.difference.low, 10 / 102.0 - 1.959964 * std::sqrt(21 - 100 / 102.0) / 102,
              kHandRounding);
  EXPECT_NEAR(paired.difference.high, 10 / 102.0 + 1.959964 * std::sqrt(21 - 100 / 102.0) / 102,
              kHandRounding);
  // Twice the sum of the binomials (20 over 0 to 5), 21700, by 2^20.
  EXPECT_NEAR(paired.p_value, 2 * 21700.0 / 1048576, kHandRounding);
  const PairedShares back = CompareShares(15, 5, 100);
  EXPECT_DOUBLE_EQ(back.difference.low, -paired.difference.high);
  EXPECT_DOUBLE_EQ(back.p_value, paired.p_value);
}

TEST(EstimateTest, WithoutDiscordancePairedSharesAreEqual) {
  const PairedShares paired = CompareShares(0, 0, 50);
  EXPECT_EQ(paired.difference.value, 0);
  EXPECT_LT(paired.difference.low, 0);
  EXPECT_GT(paired.difference.high, 0);
  EXPECT_EQ(paired.p_value, 1);
  EXPECT_EQ(CompareShares(4, 4, 50).p_value, 1);
}

TEST(EstimateTest, IntervalsOfSharesHoldTheirShareWhereAllOrNoneSucceeded) {
  for (int trials = 1; trials <= 1000; ++trials) {
    const Estimate none = EstimateShare(0, trials), all = EstimateShare(trials, trials);
    EXPECT_EQ(none.low, 0) << trials;
    EXPECT_EQ(all.high, 1) << trials;
  }
}

}  // namespace
}  // namespace skein
