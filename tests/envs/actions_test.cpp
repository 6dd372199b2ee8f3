// SPDX-License-Identifier: Apache-2.0
#include "envs/actions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"

namespace skein {
namespace {

/// Commands that show that they were left alone.
constexpr float kUntouched = 77;
constexpr int kMostLanes = 16;

/// One tile's throttle and stick commands, kActionSize columns.
class ActionsTest : public ::testing::TestWithParam<simd::Target> {
 protected:
  ActionsTest() : scoped_(GetParam()) {}

  void Take(const std::vector<float>& action, TestTile* tile) {
    stride_ = tile->stride();
    commands_.assign(stride_ * kActionSize, kUntouched);
    TakeActions(action.data(), tile->tile(), commands_.data(), stride_);
  }
  float CommandOf(int k, int i) const {
    return commands_[static_cast<std::size_t>(k) * stride_ + static_cast<std::size_t>(i)];
  }

 private:
  ScopedTarget scoped_;
  std::size_t stride_ = 0;
  std::vector<float> commands_;
};

/// A different number for every command of every aircraft, some beyond [-1, 1].
float ActionOf(int i, int command) {
  return std::sin(1.0f + 0.37f * static_cast<float>(kActionSize * i + command)) * 1.5f;
}

std::vector<float> Actions(int count) {
  std::vector<float> action;
  for (int i = 0; i < count; ++i) {
    for (int command = 0; command < kActionSize; ++command) action.push_back(ActionOf(i, command));
  }
  return action;
}

TEST_P(ActionsTest, EveryAircraftGetsItsOwnCommandsClipped) {
  // Whole vectors, a part of one, and both.
  for (const int count : {1, 3, 15, 16, 17, 32, 37}) {
    TestTile tile(count);
    Take(Actions(count), &tile);
    for (int i = 0; i < count; ++i) {
      for (int command = 0; command < kActionSize; ++command) {
        const float clipped = std::fmin(1.0f, std::fmax(-1.0f, ActionOf(i, command)));
        const float expected = command == 0 ? (clipped + 1) / 2 : clipped;
        ASSERT_FLOAT_EQ(CommandOf(command, i), expected)
            << "command " << command << " of aircraft " << i << " among " << count;
      }
    }
  }
}

TEST_P(ActionsTest, ThrottleRunsFromIdleToFull) {
  TestTile tile(3);
  Take({-1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, &tile);
  EXPECT_EQ(CommandOf(0, 0), 0);
  EXPECT_EQ(CommandOf(0, 1), 0.5f);
  EXPECT_EQ(CommandOf(0, 2), 1);
}

TEST_P(ActionsTest, LanesBeyondTheLastAircraftAreCentred) {
  constexpr int kCount = 5;
  TestTile tile(kCount);
  Take(Actions(kCount), &tile);
  for (int i = kCount; i < kMostLanes; ++i) {
    for (int command = 0; command < kActionSize; ++command) {
      // A target with fewer lanes does not get so far.
      if (CommandOf(command, i) == kUntouched) continue;
      EXPECT_EQ(CommandOf(command, i), command == 0 ? 0.5f : 0.0f) << "lane " << i;
    }
  }
}

TEST_P(ActionsTest, FiniteActionsLeaveTheStateAlone) {
  constexpr int kCount = 21;
  TestTile tile(kCount), before(kCount);
  for (int i = 0; i < kCount; ++i) tile.at(kU, i) = before.at(kU, i) = 1000.0f + i;
  std::vector<float> action = Actions(kCount);
  action[7] = std::numeric_limits<float>::max();
  Take(action, &tile);
  EXPECT_TRUE(tile == before);
}

TEST_P(ActionsTest, AnActionThatIsNotFiniteShowsInItsOwnAircraftAlone) {
  constexpr int kCount = 21;
  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
        -std::numeric_limits<float>::infinity()}) {
    for (int command = 0; command < kActionSize; ++command) {
      for (const int sick : {0, 9, kCount - 1}) {
        TestTile tile(kCount);
        tile.Fill(kU, 1000);
        std::vector<float> action = Actions(kCount);
        action[static_cast<std::size_t>(kActionSize * sick + command)] = value;
        Take(action, &tile);
        for (int i = 0; i < kCount; ++i) {
          EXPECT_EQ(std::isnan(tile.at(kU, i)), i == sick) << "aircraft " << i;
          for (int column = kV; column < kNumColumns; ++column) {
            ASSERT_EQ(tile.at(column, i), 0) << "column " << column;
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, ActionsTest, ::testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& target) { return simd::Name(target.param); });

}  // namespace
}  // namespace skein
