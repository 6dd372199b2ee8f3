// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/episode_progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "tests/scoped_target.h"

namespace skein {
namespace {

/// Columns of `count` aircraft, told step by step which are within tolerances.
class Progress {
 public:
  explicit Progress(int count = 1) : count_(count) {}

  void Step(const ProgressRules& rules, const std::vector<bool>& is_within) {
    for (std::size_t i = 0; i < is_within.size(); ++i) reached_[i] = is_within[i] ? 1 : 0;
    AdvanceProgress(rules, count_, step_.data(), termination_.data(), columns(),
                    {reached_.data(), deadline_.data(), end_.data(), bonus_.data()});
    for (std::int32_t& step : step_) ++step;
  }
  /// All that is known of one.
  auto Of(std::size_t i) const {
    return std::tuple(columns_[0][i], columns_[1][i], columns_[2][i], columns_[3][i],
                      columns_[4][i], reached_[i], deadline_[i], static_cast<TargetEnd>(end_[i]),
                      bonus_[i]);
  }
  void End(std::size_t i) { termination_[i] = 1; }
  bool HasReached() const { return reached_[0] != 0; }
  int step() const { return step_[0]; }
  int deadline() const { return deadline_[0]; }
  TargetEnd end() const { return static_cast<TargetEnd>(end_[0]); }
  float bonus() const { return bonus_[0]; }
  EpisodeProgress columns() {
    return {columns_[0].data(), columns_[1].data(), columns_[2].data(), columns_[3].data(),
            columns_[4].data()};
  }

  static constexpr int kMostAircraft = 64;  ///< a multiple of all vectors' lanes

 private:
  using Column = std::array<std::int32_t, kMostAircraft>;

  int count_;
  std::array<Column, EpisodeProgress::kNumColumns> columns_{};
  Column step_{}, termination_{}, reached_{}, deadline_{}, end_{};
  std::array<float, kMostAircraft> bonus_{};
};

class ProgressTest : public testing::TestWithParam<simd::Target> {
 protected:
  ProgressTest() { rules_.time_limit_steps = 8; }

  /// Whether the episode ends as reached.
  bool Step(bool is_within) {
    flight_.Step(rules_, {is_within});
    return flight_.HasReached();
  }
  bool IsOutOfTime() const { return flight_.step() >= flight_.deadline(); }
  /// Control steps until the episode ends as reached; 0 if it does not within `pattern`.
  int StepsUntilReached(const std::vector<bool>& pattern) {
    for (const bool is_within : pattern) {
      if (Step(is_within)) return flight_.step();
    }
    return 0;
  }

  const ScopedTarget target_{GetParam()};
  Progress flight_;
  EpisodeProgress progress_ = flight_.columns();
  ProgressRules rules_;
};

TEST_P(ProgressTest, AnInterruptedDwellBeginsAnew) {
  rules_.dwell_steps = 3;
  EXPECT_EQ(StepsUntilReached({true, true, false, true, true, true, true}), 6);
  EXPECT_EQ(*progress_.reached_step, 6);
  EXPECT_EQ(*progress_.steps_within, 3);
}

TEST_P(ProgressTest, TimeEndsWhatIsOutsideOfItsTolerancesOnly) {
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

TEST_P(ProgressTest, AHoldLastsItsTimeWhetherWithinTolerancesOrNot) {
  rules_.hold_steps = 5;
  EXPECT_EQ(StepsUntilReached({false, true, false, false, true, false, true, true}), 7);
  EXPECT_EQ(*progress_.reached_step, 2);
}

TEST_P(ProgressTest, AHoldFollowsTheDwell) {
  rules_.dwell_steps = 2;
  rules_.hold_steps = 3;
  EXPECT_EQ(StepsUntilReached({true, false, true, true, false, false, false, false}), 7);
  EXPECT_EQ(*progress_.reached_step, 4);
}

TEST_P(ProgressTest, AMissionCountsTargetsHeldAndMissed) {
  rules_.dwell_steps = 2;
  rules_.mission_steps = 100;
  rules_.reached_reward = 5;
  rules_.missed_reward = -7;
  std::vector<TargetEnd> ends;
  const auto fly = [&](const std::vector<bool>& pattern) {
    for (const bool is_within : pattern) {
      EXPECT_FALSE(Step(is_within));
      EXPECT_EQ(flight_.deadline(), 100);
      EXPECT_EQ(flight_.bonus(), flight_.end() == TargetEnd::kReached  ? 5
                                 : flight_.end() == TargetEnd::kMissed ? -7
                                                                       : 0);
      if (flight_.end() != TargetEnd::kNone) ends.push_back(flight_.end());
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

TEST_P(ProgressTest, AnAircraftWhoseEpisodeHasEndedIsLeftAlone) {
  rules_.mission_steps = 100;
  flight_.End(0);
  Step(true);
  EXPECT_EQ(*progress_.targets_reached, 0);
  EXPECT_EQ(*progress_.steps_within, 0);
  EXPECT_EQ(flight_.end(), TargetEnd::kNone);
}

TEST_P(ProgressTest, AHeldTargetPaysOnceWhenItIsReached) {
  rules_.dwell_steps = 2;
  rules_.hold_steps = 4;
  rules_.reached_reward = 5;
  float paid = 0;
  for (const bool is_within : {false, true, true, true, false, true, true}) {
    Step(is_within);
    EXPECT_EQ(flight_.bonus() != 0, flight_.step() == 3);
    paid += flight_.bonus();
  }
  EXPECT_EQ(paid, 5);
}

/// One aircraft by the words of ProgressRules, one case after another.
class PlainProgress {
 public:
  void Step(const ProgressRules& rules, bool is_within) {
    ++step_;
    if (has_ended_) return;
    steps_within_ = is_within ? steps_within_ + 1 : 0;
    const bool is_held = steps_within_ >= std::max(1, rules.dwell_steps);
    end_ = TargetEnd::kNone;
    bonus_ = 0;
    if (rules.mission_steps > 0) {
      FlyMission(rules, is_held);
    } else {
      Hold(rules, is_held);
    }
  }
  auto All() const {
    return std::tuple(steps_within_, reached_step_, target_step_, targets_reached_, targets_missed_,
                      is_over_ ? 1 : 0, deadline_, end_, bonus_);
  }
  void End() { has_ended_ = true; }
  bool has_ended() const { return has_ended_; }

 private:
  void FlyMission(const ProgressRules& rules, bool is_held) {
    const bool is_late = steps_within_ == 0 && step_ - target_step_ >= rules.time_limit_steps;
    if (is_held) {
      ++targets_reached_;
      end_ = TargetEnd::kReached;
      bonus_ = rules.reached_reward;
    } else if (is_late) {
      ++targets_missed_;
      end_ = TargetEnd::kMissed;
      bonus_ = rules.missed_reward;
    }
    if (is_held || is_late) {
      steps_within_ = 0;
      target_step_ = step_;
    }
    is_over_ = false;
    deadline_ = rules.mission_steps;
  }
  void Hold(const ProgressRules& rules, bool is_held) {
    if (is_held && reached_step_ == 0) {
      reached_step_ = step_;
      if (rules.hold_steps > 0) {
        end_ = TargetEnd::kReached;
        bonus_ = rules.reached_reward;
      }
    }
    const bool is_in_time = reached_step_ > 0 || steps_within_ > 0;
    deadline_ = is_in_time ? std::numeric_limits<int>::max() : rules.time_limit_steps;
    is_over_ = reached_step_ > 0 && step_ - reached_step_ >= rules.hold_steps;
  }

  int step_ = 0, steps_within_ = 0, reached_step_ = 0, target_step_ = 0;
  int targets_reached_ = 0, targets_missed_ = 0, deadline_ = 0;
  bool is_over_ = false, has_ended_ = false;
  TargetEnd end_ = TargetEnd::kNone;
  float bonus_ = 0;
};

TEST_P(ProgressTest, EachAircraftOfABlockComesAsFarAsItWouldByItself) {
  rules_.dwell_steps = 3;
  rules_.reached_reward = 5;
  rules_.missed_reward = -7;
  for (const int mission_steps : {0, 100}) {
    rules_.mission_steps = mission_steps;
    rules_.hold_steps = mission_steps == 0 ? 6 : 0;
    constexpr std::size_t kCount = 37;
    Progress together(kCount);
    std::vector<PlainProgress> alone(kCount);
    std::minstd_rand random(1);
    for (int step = 0; step < 60; ++step) {
      std::vector<bool> is_within;
      for (std::size_t i = 0; i < kCount; ++i) is_within.push_back(random() % 8 < i % 8);
      together.Step(rules_, is_within);
      for (std::size_t i = 0; i < kCount; ++i) {
        alone[i].Step(rules_, is_within[i]);
        if (alone[i].has_ended()) continue;
        ASSERT_EQ(together.Of(i), alone[i].All()) << i << " in step " << step;
        if (random() % 200 != 0) continue;
        together.End(i);
        alone[i].End();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, ProgressTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
