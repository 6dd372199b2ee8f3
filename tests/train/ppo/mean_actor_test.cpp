// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/mean_actor.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/tolerance.h"

namespace skein {
namespace {

TEST(MoveAverageTest, IsThePlainMeanUntilThereAreEnough) {
  std::vector<float> mean{7, 7};
  const float parameters[][2] = {{1, 2}, {3, 4}, {8, 0}};
  for (int i = 0; i < 3; ++i) {
    MoveAverage(parameters[i], static_cast<std::uint64_t>(i) + 1, 4, &mean);
  }
  constexpr Tolerance kSingle{1e-6, "float32 rounding of means of about 4"};
  EXPECT_NEAR(mean[0], 4, kSingle);
  EXPECT_NEAR(mean[1], 2, kSingle);
}

TEST(MoveAverageTest, ForgetsBySharesThatAreAlwaysTheSame) {
  std::vector<float> mean{0};
  const float one = 1;
  for (std::uint64_t iteration = 100; iteration < 102; ++iteration) {
    MoveAverage(&one, iteration, 4, &mean);
  }
  EXPECT_EQ(mean[0], 0.4375F);
}

}  // namespace
}  // namespace skein
