#include "train/network.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simd/error.h"

namespace skein {
namespace {

/// Parameters are rounded to float32; a dot product of 128 of them.
constexpr double kOrthogonalityTolerance = 1e-5;

TEST(NetworkLayoutTest, SlicesFillTheVectorWithoutGaps) {
  const NetworkLayout layout(ActorShape({}, 22, 4));
  std::int64_t expected = 0;
  for (const ParameterSlice& slice : layout.slices()) {
    EXPECT_EQ(slice.offset, expected) << slice.name;
    std::int64_t count = 1;
    for (const std::int64_t extent : slice.shape) count *= extent;
    expected += count;
  }
  EXPECT_EQ(layout.size(), expected);
}

TEST(NetworkLayoutTest, PaperNetworksHaveAbout153ThousandParameters) {
  EXPECT_EQ(NetworkLayout(ActorShape({}, 22, 4)).size(), 153396);
  EXPECT_EQ(NetworkLayout(CriticShape({}, 22)).size(), 153005);
}

TEST(NetworkLayoutTest, RefusesSizesThatVectorsDoNotDivide) {
  EXPECT_THROW(NetworkLayout({22, 100, 128, 4, true}), Error);
  EXPECT_THROW(NetworkLayout({22, 128, 0, 4, true}), Error);
}

TEST(InitialParametersTest, WeightsAreOrthogonalWithTheirGain) {
  const NetworkLayout layout({22, 64, 32, 4, true});
  const std::vector<float> parameters = InitialParameters(layout, 0.01, -0.5, 3, 0);
  const auto expect_rows = [&](std::int64_t offset, int rows, int columns, double gain) {
    for (int a = 0; a < rows; ++a) {
      for (int b = 0; b <= a; ++b) {
        double dot = 0;
        for (int j = 0; j < columns; ++j) {
          dot += static_cast<double>(parameters[offset + a * columns + j]) *
                 parameters[offset + b * columns + j];
        }
        EXPECT_NEAR(dot, a == b ? gain * gain : 0.0, kOrthogonalityTolerance);
      }
    }
  };
  expect_rows(layout.layer(kSecondLayer).weight, 64, 64, std::sqrt(2.0));
  expect_rows(layout.layer(kHead).weight, 4, 64, 0.01);
  expect_rows(layout.gru_weight() + 32 * 32, 32, 32, 1);
  EXPECT_EQ(parameters[layout.log_std()], -0.5f);
}

TEST(InitialParametersTest, DependOnSeedAndStream) {
  const NetworkLayout layout({22, 32, 32, 1, false});
  const auto first = InitialParameters(layout, 1, 0, 3, 0);
  EXPECT_EQ(first, InitialParameters(layout, 1, 0, 3, 0));
  EXPECT_NE(first, InitialParameters(layout, 1, 0, 4, 0));
  EXPECT_NE(first, InitialParameters(layout, 1, 0, 3, 1));
}

}  // namespace
}  // namespace skein
