// SPDX-License-Identifier: Apache-2.0
#include "train/measures/command_smoothness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kInterval = 0.02;  // 50 Hz
constexpr Tolerance kFloat{2e-6, "float32 rounding of the commands and of what is reported"};

using Function = std::function<double(double)>;

void ExpectSame(const CommandSmoothness& a, const CommandSmoothness& b) {
  const auto is_same = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  EXPECT_TRUE(is_same(a.variation_per_s, b.variation_per_s));
  EXPECT_TRUE(is_same(a.reversals_per_s, b.reversals_per_s));
  EXPECT_TRUE(is_same(a.power_above_split, b.power_above_split));
  EXPECT_TRUE(is_same(a.saturated, b.saturated));
}

/// The command f(t) at 0, 0.02, ... s, `steps` of them, beside constant commands and its mirror
/// image: each is measured for itself.
CommandSmoothness Measure(const Function& f, int steps) {
  ActionSeries series(kInterval);
  for (int i = 0; i < steps; ++i) {
    const auto command = static_cast<float>(f(i * kInterval));
    const float action[kActionSize] = {0, command, -command, 0.5f};
    series.Add(action);
  }
  const ActionSmoothness all = series.Report();
  ExpectSame(all[2], all[1]);
  if (steps > 1) {
    EXPECT_EQ(all[0].variation_per_s, 0);
    EXPECT_EQ(all[3].reversals_per_s, 0);
  }
  return all[1];
}

/// The same by an agent that acts every fifth control step.
CommandSmoothness MeasureAtTenHz(const Function& f, int steps) {
  return Measure([&f](double t) { return f(std::floor(t / (5 * kInterval) + 1e-9) * 0.1); }, steps);
}

Function Sine(double amplitude, double hz) {
  return [=](double t) { return amplitude * std::sin(2 * M_PI * hz * t); };
}

TEST(CommandSmoothnessTest, ASineVariesByFourAmplitudesAndReversesTwiceACycle) {
  // The peaks of 0.5 Hz and of 2.5 Hz are among the samples, as is the zero at 10 s.
  for (const double hz : {0.5, 2.5}) {
    const CommandSmoothness sine = Measure(Sine(0.3, hz), 501);
    EXPECT_NEAR(sine.variation_per_s, 4 * 0.3 * hz, kFloat) << hz;
    EXPECT_NEAR(sine.reversals_per_s, 2 * hz, kFloat) << hz;
    EXPECT_EQ(sine.saturated, 0) << hz;
  }
}

TEST(CommandSmoothnessTest, PowerOfASineLiesAtItsFrequency) {
  EXPECT_NEAR(Measure(Sine(0.3, 0.5), 500).power_above_split, 0, kFloat);
  EXPECT_NEAR(Measure(Sine(0.3, 1.0), 500).power_above_split, 0, kFloat) << "the split itself";
  EXPECT_NEAR(Measure(Sine(0.3, 1.1), 500).power_above_split, 1, kFloat);
  EXPECT_NEAR(Measure(Sine(0.3, 7), 500).power_above_split, 1, kFloat);
}

TEST(CommandSmoothnessTest, PowerOfTwoSinesIsSharedBySquaresOfAmplitudesWhateverTheMean) {
  const auto both = [](double t) { return -0.2 + Sine(0.4, 0.3)(t) + Sine(0.2, 3)(t); };
  EXPECT_NEAR(Measure(both, 500).power_above_split, 0.04 / (0.16 + 0.04), kFloat);
  // An hour, in windows: 72 of them.
  EXPECT_NEAR(Measure(both, 180000).power_above_split, 0.2, kFloat);
}

TEST(CommandSmoothnessTest, WindowsAreWeighedByTheirPower) {
  // Fast in the first window of 50 s, slow and twice as far in half a window after it.
  const auto change = [](double t) { return t < 50 ? Sine(0.2, 4)(t) : Sine(0.4, 0.4)(t); };
  const double fast = 0.04 * 50, slow = 0.16 * 25;
  EXPECT_NEAR(Measure(change, 3750).power_above_split, fast / (fast + slow), kFloat);
  // A rest of less than a second is left out.
  EXPECT_NEAR(Measure(change, 2549).power_above_split, 1, kFloat);
}

TEST(CommandSmoothnessTest, PowerAddsUpToTheVariance) {
  const std::vector<float> values = {0.5f, -0.25f, 0.125f, 1, -1, 0, 0.75f};
  double mean = 0, squares = 0;
  for (const float value : values) mean += value / 7;
  for (const float value : values) squares += (value - mean) * (value - mean);
  std::vector<float> rows;
  for (const float value : values) rows.insert(rows.end(), {value, -value, value / 2, 1});
  const ActionRows all{rows.data(), values.size()};
  const auto below = PowerOf(all, 1), above = PowerOf(all, 0.1);  // every frequency is
  const double scale[kActionSize] = {1, 1, 0.25, 0};
  for (int k = 0; k < kActionSize; ++k) {
    EXPECT_NEAR(below[k].whole, scale[k] * squares, kFloat);
    EXPECT_NEAR(below[k].above_split, 0, kFloat);
    EXPECT_NEAR(above[k].above_split, scale[k] * squares, kFloat);
  }
}

TEST(CommandSmoothnessTest, AHeldCommandIsMeasuredAsTheOneThatMoves) {
  // Slow enough that ten values a second have its peaks: variation and reversals do not see the
  // rate, and the steps that holding makes hold little power.
  const CommandSmoothness moving = Measure(Sine(0.4, 0.25), 1001);
  const CommandSmoothness held = MeasureAtTenHz(Sine(0.4, 0.25), 1001);
  EXPECT_NEAR(held.variation_per_s, moving.variation_per_s, kFloat);
  EXPECT_EQ(held.reversals_per_s, moving.reversals_per_s);
  EXPECT_LT(held.power_above_split, 0.01);
  EXPECT_GT(held.power_above_split, 0);
}

TEST(CommandSmoothnessTest, ChatterReversesAtEveryChangeUnlessItIsWithinTheDeadBand) {
  const auto chatter = [](double step) {
    return [step](double t) { return std::lround(t / kInterval) % 2 == 0 ? 0 : step; };
  };
  const CommandSmoothness loud = Measure(chatter(0.1), 501), soft = Measure(chatter(0.01), 501);
  EXPECT_NEAR(loud.variation_per_s, 0.1 * 50, kFloat);
  EXPECT_NEAR(loud.reversals_per_s, 499 / 10.0, 50 * kFloat) << "the first change reverses nothing";
  EXPECT_NEAR(Measure(chatter(0.1), 500).power_above_split, 1, kFloat);
  EXPECT_NEAR(soft.variation_per_s, 0.01 * 50, kFloat);
  EXPECT_EQ(soft.reversals_per_s, 0);
}

TEST(CommandSmoothnessTest, SlowMotionReversesHoweverSmallItsSteps) {
  // Steps of 0.0004, far below the dead band, that add up to turns of 0.2.
  EXPECT_NEAR(Measure(Sine(0.1, 0.03125), 3201).reversals_per_s, 2 * 0.03125, kFloat);
  EXPECT_EQ(Measure(Sine(0.009, 0.5), 501).reversals_per_s, 0) << "less than the dead band";
}

TEST(CommandSmoothnessTest, ConstantAndSaturatedCommands) {
  const CommandSmoothness still = Measure([](double) { return 0.3; }, 500);
  EXPECT_EQ(still.variation_per_s, 0);
  EXPECT_EQ(still.reversals_per_s, 0);
  EXPECT_EQ(still.power_above_split, 0);
  EXPECT_EQ(still.saturated, 0);
  const CommandSmoothness bang =
      Measure([](double t) { return t < 2.499   ? 1
                                    : t < 4.999 ? -1
                                                : 0.5; }, 500);
  EXPECT_FLOAT_EQ(bang.saturated, 0.5f);
  EXPECT_NEAR(bang.variation_per_s, 3.5 / (499 * kInterval), kFloat);
}

TEST(CommandSmoothnessTest, ShortSeriesSayWhatTheyCan) {
  EXPECT_TRUE(std::isnan(Measure(Sine(1, 1), 0).saturated));
  const CommandSmoothness one = Measure([](double) { return 1; }, 1);
  EXPECT_EQ(one.saturated, 1);
  EXPECT_TRUE(std::isnan(one.variation_per_s));
  const CommandSmoothness second = Measure(Sine(1, 1), 49);
  EXPECT_GT(second.variation_per_s, 0);
  EXPECT_TRUE(std::isnan(second.power_above_split)) << "no frequency up to 1 Hz in 0.98 s";
  EXPECT_FALSE(std::isnan(Measure(Sine(1, 1), 50).power_above_split));
}

}  // namespace
}  // namespace skein
