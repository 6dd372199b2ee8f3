// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/episode_progress.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace skein {
namespace {

/// One aircraft, told step by step whether it is within tolerances.
class ProgressTest : public testing::Test {
 protected:
  ProgressTest() { rules_.time_limit_steps = 8; }

  /// Whether the episode ends as reached.
  bool Step(bool is_within) {
    std::int32_t reached = is_within ? 1 : 0;
    AdvanceProgress(rules_, 1, &step_, &termination_, progress_, &reached, &deadline_, &end_);
    ++step_;
    return reached != 0;
  }
  bool IsOutOfTime() const { return step_ >= deadline_; }
  /// Control steps until the episode ends as reached; 0 if it does not within `pattern`.
  int StepsUntilReached(const std::vector<bool>& pattern) {
    for (const bool is_within : pattern) {
      if (Step(is_within)) return step_;
    }
    return 0;
  }

  std::array<std::array<std::int32_t, 1>, EpisodeProgress::kNumColumns> columns_{};
  EpisodeProgress progress_{columns_[0].data(), columns_[1].data(), columns_[2].data(),
                            columns_[3].data(), columns_[4].data()};
  ProgressRules rules_;
  std::int32_t step_ = 0, termination_ = 0, deadline_ = 0;
  TargetEnd end_ = TargetEnd::kNone;
};

TEST_F(ProgressTest, AnInterruptedDwellBeginsAnew) {
  rules_.dwell_steps = 3;
  EXPECT_EQ(StepsUntilReached({true, true, false, true, true, true, true}), 6);
  EXPECT_EQ(*progress_.reached_step, 6);
  EXPECT_EQ(*progress_.steps_within, 3);
}

TEST_F(ProgressTest, TimeEndsWhatIsOutsideOfItsTolerancesOnly) {
  rules_.dwell_steps = 4;
  for (int i = 0; i < 7; ++i) Step(false);
  EXPECT_FALSE(IsOutOfTime());
  Step(true);
  EXPECT_FALSE(IsOutOfTime());
  Step(true);
  EXPECT_FALSE(IsOutOfTime());
  Step(false);
  EXPECT_TRUE(IsOutOfTime());
}

TEST_F(ProgressTest, AHoldLastsItsTimeWhetherWithinTolerancesOrNot) {
  rules_.hold_steps = 5;
  EXPECT_EQ(StepsUntilReached({false, true, false, false, true, false, true, true}), 7);
  EXPECT_EQ(*progress_.reached_step, 2);
}

TEST_F(ProgressTest, AHoldFollowsTheDwell) {
  rules_.dwell_steps = 2;
  rules_.hold_steps = 3;
  EXPECT_EQ(StepsUntilReached({true, false, true, true, false, false, false, false}), 7);
  EXPECT_EQ(*progress_.reached_step, 4);
}

TEST_F(ProgressTest, AMissionCountsTargetsHeldAndMissed) {
  rules_.dwell_steps = 2;
  rules_.mission_steps = 100;
  std::vector<TargetEnd> ends;
  const auto fly = [&](const std::vector<bool>& pattern) {
    for (const bool is_within : pattern) {
      EXPECT_FALSE(Step(is_within));
      EXPECT_EQ(deadline_, 100);
      if (end_ != TargetEnd::kNone) ends.push_back(end_);
    }
  };
  fly({false, true, true});
  EXPECT_EQ(ends, std::vector<TargetEnd>{TargetEnd::kReached});
  EXPECT_EQ(*progress_.target_step, 3);
  // Within tolerances at the time limit, and then not any more.
  fly({false, false, false, false, false, false, false, true, false});
  EXPECT_EQ(ends, (std::vector<TargetEnd>{TargetEnd::kReached, TargetEnd::kMissed}));
  fly({true, true});
  EXPECT_EQ(*progress_.targets_reached, 2);
  EXPECT_EQ(*progress_.targets_missed, 1);
}

TEST_F(ProgressTest, AnAircraftWhoseEpisodeHasEndedIsLeftAlone) {
  rules_.mission_steps = 100;
  termination_ = 1;
  Step(true);
  EXPECT_EQ(*progress_.targets_reached, 0);
  EXPECT_EQ(*progress_.steps_within, 0);
  EXPECT_EQ(end_, TargetEnd::kNone);
}

}  // namespace
}  // namespace skein
