// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/popart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tolerance.h"
#include "tests/train/network/sample_tile.h"
#include "train/network/fused_network.h"

namespace skein {
namespace {

constexpr Tolerance kValue{1e-3, "float32 values of some hundred"};
constexpr Tolerance kRounding{1e-12, "float64 rounding"};

TargetMoments MomentsOf(const std::vector<float>& targets) {
  TargetMoments moments;
  for (const float target : targets) {
    moments.mean += target / static_cast<double>(targets.size());
    moments.mean_square += std::pow(target, 2.0) / static_cast<double>(targets.size());
  }
  return moments;
}

TEST(PopArtTest, ValuesStayAsTheyWereWhenTheMomentsMove) {
  const NetworkLayout layout({5, 32, 16, 1, false});
  std::vector<float> parameters = DisturbedParameters(layout);
  RandomTile samples(layout.shape(), 4, 6);
  FusedNetwork network(layout);
  NetworkWorkspace workspace;
  PopArt popart;
  const auto values = [&] {
    network.SetParameters(parameters.data());
    network.Forward(samples.tile().sequence, workspace);
    const ValueScale scale = popart.scale();
    std::vector<double> result;
    for (int i = 0; i < 24; ++i) result.push_back(scale.mean + scale.std * workspace.output()[i]);
    return result;
  };
  for (const float spread : {200.0f, 20.0f, 3.0f}) {
    const std::vector<double> before = values();
    std::vector<float> targets = samples.Normal(500, spread);
    for (float& target : targets) target += spread;
    UpdatePopArt(MomentsOf(targets), 0.3, layout, parameters.data(), popart);
    const std::vector<double> after = values();
    for (int i = 0; i < 24; ++i) EXPECT_NEAR(after[i], before[i], kValue);
  }
}

TEST(PopArtTest, FirstMomentsAreTakenWholeAndLaterOnesByRate) {
  const NetworkLayout layout({5, 16, 16, 1, false});
  std::vector<float> parameters(layout.size(), 0.0f);
  PopArt popart;
  UpdatePopArt(MomentsOf({1, 3}), 0.1, layout, parameters.data(), popart);
  EXPECT_DOUBLE_EQ(popart.scale().mean, 2);
  EXPECT_DOUBLE_EQ(popart.scale().std, 1);
  UpdatePopArt(MomentsOf({12, 12}), 0.1, layout, parameters.data(), popart);
  EXPECT_DOUBLE_EQ(popart.scale().mean, 3);
  EXPECT_NEAR(popart.scale().std, std::sqrt(0.9 * 5 + 0.1 * 144 - 9), kRounding);
}

TEST(PopArtTest, ConstantTargetsDoNotDivideByZero) {
  const NetworkLayout layout({5, 16, 16, 1, false});
  std::vector<float> parameters = DisturbedParameters(layout);
  PopArt popart;
  UpdatePopArt(MomentsOf({4, 4, 4}), 0.1, layout, parameters.data(), popart);
  EXPECT_EQ(popart.scale().std, PopArt::kMinStd);
  for (const float parameter : parameters) EXPECT_TRUE(std::isfinite(parameter));
}

}  // namespace
}  // namespace skein
