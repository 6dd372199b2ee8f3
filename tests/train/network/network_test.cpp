// SPDX-License-Identifier: Apache-2.0
#include "train/network/network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kFloat32Product{1e-5, "a product of 128 parameters rounded to float32"};

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

TEST(NetworkLayoutTest, DefaultShapeKeepsTheOrderOfPolicyFiles) {
  const char* const names[] = {"layer1", "layer2", "gru_input", "layer3", "layer4", "head"};
  std::vector<std::string> expected;
  for (const std::string name : names) {
    for (const char* part : {".norm.weight", ".norm.bias", ".weight", ".bias"}) {
      expected.push_back(name + part);
    }
    if (name != "gru_input") continue;
    expected.insert(expected.end(), {"gru_hidden.weight", "gru_hidden.bias"});
  }
  expected.push_back("log_std");
  const NetworkLayout layout(ActorShape({}, 22, 4));
  ASSERT_EQ(layout.slices().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(layout.slices()[i].name, expected[i]);
}

TEST(NetworkLayoutTest, DepthsNameTheirLayers) {
  NetworkConfig config;
  config.hidden_layers = 1;
  config.gru_layers = 3;
  const NetworkLayout layout(CriticShape(config, 22));
  std::vector<std::string> names;
  for (const ParameterSlice& slice : layout.slices()) names.push_back(slice.name);
  for (const char* name : {"layer1.weight", "gru_input.weight", "gru_hidden.weight",
                           "gru2_input.weight", "gru3_hidden.bias", "layer2.bias", "head.bias"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  }
  EXPECT_EQ(layout.shape().state_size(), 3 * 128);
}

TEST(NetworkLayoutTest, RefusesShapesBeyondItsLimits) {
  const auto refused = [](const auto& change) {
    NetworkShape shape = ActorShape({}, 22, 4);
    change(shape);
    EXPECT_THROW(NetworkLayout{shape}, Error);
  };
  refused([](NetworkShape& shape) { shape.hidden_size = 0; });
  refused([](NetworkShape& shape) { shape.hidden_size = kMaxWidth + 1; });
  refused([](NetworkShape& shape) { shape.gru_size = -1; });
  refused([](NetworkShape& shape) { shape.hidden_layers = kMaxHiddenLayers + 1; });
  refused([](NetworkShape& shape) { shape.hidden_layers = -1; });
  refused([](NetworkShape& shape) { shape.gru_layers = 0; });
  refused([](NetworkShape& shape) { shape.output_size = 0; });
}

TEST(NetworkLayoutTest, FlopsAreThoseOfTheProducts) {
  // Layers before the GRU, its input and hidden products, layers behind it, head.
  const double products = 22 * 128 + 128 * 128 + 2 * 128 * 384 + 2 * 128 * 128 + 128 * 4;
  EXPECT_EQ(ForwardFlops(NetworkLayout(ActorShape({}, 22, 4))), 2 * products);
  NetworkShape shape = CriticShape({}, 22);
  shape.hidden_layers = 0;
  shape.gru_layers = 3;
  EXPECT_EQ(ForwardFlops(NetworkLayout(shape)), 2 * (22 * 384 + 5 * 128 * 384 + 128));
}

TEST(NetworkLayoutTest, BackwardFlopsLeaveOutWhatNothingNeeds) {
  NetworkShape shape;
  shape.observation_size = 3;
  shape.hidden_size = 4;
  shape.gru_size = 5;
  shape.output_size = 2;
  shape.hidden_layers = 1;
  shape.gru_layers = 2;
  const NetworkLayout layout(shape);
  // Layer 1, both GRU layers' input and state, layer 2, head.
  const double to_weights = 3 * 4 + 4 * 15 + 3 * 5 * 15 + 5 * 4 + 4 * 2;
  const double to_inputs = 4 * 15 + 5 * 15 + 5 * 4 + 4 * 2;  // not layer 1's
  const double to_states = 2 * 5 * 15;                       // not before the first step
  EXPECT_EQ(BackwardFlops(layout, 4), 2 * (to_weights + to_inputs + to_states * 3 / 4));
  EXPECT_EQ(BackwardFlops(layout, 1), 2 * (to_weights + to_inputs));
}

TEST(NetworkLayoutTest, BackwardFlopsWithoutHiddenLayersLeaveOutTheGrusInput) {
  NetworkShape shape;
  shape.observation_size = 3;
  shape.gru_size = 5;
  shape.hidden_size = shape.output_size = 2;
  shape.hidden_layers = 0;
  const double to_weights = 3 * 15 + 5 * 15 + 5 * 2, to_inputs = 5 * 2, to_states = 5 * 15;
  EXPECT_EQ(BackwardFlops(NetworkLayout(shape), 2), 2 * (to_weights + to_inputs + to_states / 2));
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
        EXPECT_NEAR(dot, a == b ? gain * gain : 0.0, kFloat32Product);
      }
    }
  };
  expect_rows(layout.layer(1).weight, 64, 64, std::sqrt(2.0));
  expect_rows(layout.layer(layout.head()).weight, 4, 64, 0.01);
  expect_rows(layout.gru_layers()[0].hidden_weight + 32 * 32, 32, 32, 1);
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
