// SPDX-License-Identifier: Apache-2.0
#include "src/run/live_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Progress HalfWay() {
  Progress progress;
  progress.env_steps = 75000000;
  progress.total_steps = 150000000;
  progress.iteration = 61;
  progress.elapsed_s = 350;
  progress.steps_per_s = 215000;
  progress.rollout_share = 0.38;
  progress.update_share = 0.6;
  progress.return_mean = -312.04;
  progress.success_rate = 0.431;
  progress.evaluation_success_rate = 0.52;
  progress.best_evaluation = 0.55;
  progress.end_shares[static_cast<std::size_t>(Termination::kTargetReached)] = 0.43;
  progress.end_shares[static_cast<std::size_t>(Termination::kTimeLimit)] = 0.5;
  progress.end_shares[static_cast<std::size_t>(Termination::kOverload)] = 0.07;
  for (int i = 0; i < 61; ++i) progress.success_history.push_back(i / 60.0);
  return progress;
}

/// Characters that a terminal shows of a line.
std::size_t Shown(const std::string& line) {
  std::size_t columns = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\x1b') {
      i = line.find('m', i);
    } else if ((static_cast<unsigned char>(line[i]) & 0xC0) != 0x80) {
      ++columns;
    }
  }
  return columns;
}

TEST(LiveView, SaysEverything) {
  const std::vector<std::string> lines = LiveView(HalfWay(), {79, false, false});
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_THAT(lines[0], HasSubstr("training [===================="));
  EXPECT_THAT(lines[0], HasSubstr(" 50.0 %  left 5 min 49 s"));
  EXPECT_EQ(lines[1], "steps    75.0 M of 150 M  215 k/s  iteration 61  5 min 50 s so far");
  EXPECT_EQ(lines[2], "time     rollout 38 %  update 60 %  other 2 %");
  EXPECT_THAT(lines[3], HasSubstr("success  43.1 %  __"));
  EXPECT_THAT(lines[3], HasSubstr("##  evaluated 52.0 %, best 55.0 %"));
  EXPECT_EQ(lines[4], "return   -312.0");
  EXPECT_EQ(lines[5], "ends     time_limit 50 %  target_reached 43 %  overload 7 %");
}

TEST(LiveView, SaysOfHowManyEpisodesASuccessIsIfTheyAreFew) {
  Progress progress = HalfWay();
  progress.success_episodes = 3;
  EXPECT_THAT(LiveView(progress, {79, false, false})[3], HasSubstr("success  43.1 % of 3  __"));
  progress.success_episodes = 3000;
  EXPECT_THAT(LiveView(progress, {79, false, false})[3], HasSubstr("success  43.1 %  __"));
}

TEST(LiveView, OfMissionsItSaysHowManyWereFlownToTheEnd) {
  Progress progress = HalfWay();
  progress.flies_missions = true;
  EXPECT_THAT(
      LiveView(progress, {79, false, false})[3],
      AllOf(HasSubstr("to end   43.1 %  __"), HasSubstr("evaluated success 52.0 %, best 55.0 %")));
}

TEST(LiveView, FitsEveryWidthWithAndWithoutColour) {
  for (const bool is_rich : {false, true}) {
    for (std::size_t width = 1; width <= 120; ++width) {
      for (const std::string& line : LiveView(HalfWay(), {width, is_rich, is_rich})) {
        EXPECT_LE(Shown(line), width) << line;
      }
    }
  }
  const std::vector<std::string> narrow = LiveView(HalfWay(), {39, false, false});
  EXPECT_THAT(narrow[0], HasSubstr("50.0 %"));
  EXPECT_THAT(narrow[3], HasSubstr("43.1 %"));
  EXPECT_THAT(narrow[5], HasSubstr("time_limit 50 %"));
}

TEST(LiveView, HasColourOnlyWhereItIsWanted) {
  for (const std::string& line : LiveView(HalfWay(), {79, false, true})) {
    EXPECT_THAT(line, Not(HasSubstr("\x1b")));
  }
  EXPECT_THAT(LiveView(HalfWay(), {79, true, true})[0], HasSubstr("\x1b[32m===="));
}

TEST(LiveView, KnowsNothingAtFirst) {
  Progress progress;
  progress.total_steps = 1000000;
  progress.return_mean = progress.success_rate = std::nan("");
  const std::vector<std::string> lines = LiveView(progress, {79, false, false});
  EXPECT_THAT(lines[0], HasSubstr("  0.0 %  left -"));
  EXPECT_EQ(lines[1], "steps    0 of 1.00 M  -/s  iteration 0  0 s so far");
  EXPECT_EQ(lines[2], "time     -");
  EXPECT_EQ(lines[3], "success  -");
  EXPECT_EQ(lines[4], "return   -");
}

TEST(Sparkline, ShowsMeansOverEqualParts) {
  const double none = std::nan("");
  EXPECT_EQ(Sparkline({0, 1}, 2, true), "▁█");
  EXPECT_EQ(Sparkline({0, 0, 1, 1}, 2, false), "_#");
  EXPECT_EQ(Sparkline({0, none, none, none, 1, 1}, 3, false), "_ #");
  EXPECT_EQ(Sparkline({0.5}, 10, false), "=");
  EXPECT_EQ(Sparkline({}, 10, false), "");
}

}  // namespace
}  // namespace skein
