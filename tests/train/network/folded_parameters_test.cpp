// SPDX-License-Identifier: Apache-2.0
#include "train/network/folded_parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/scoped_target.h"
#include "tests/tolerance.h"
#include "tests/train/network/sample_tile.h"

namespace skein {
namespace {

constexpr Tolerance kDifference{1e-5, "differences of folded values, each rounded to float32"};

/// Whole vectors of rows and columns, and remainders, on every target.
const NetworkShape kShape{7, 53, 37, 3, true, 2, 2};

std::vector<float> Normal(std::int64_t size, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> normal;
  std::vector<float> values(size);
  for (float& value : values) value = normal(generator);
  return values;
}

std::vector<float> Folded(const FoldedLayout& folded, const std::vector<float>& parameters) {
  std::vector<float> values(folded.size());
  folded.ForEachLinear(
      [&](const FoldedLinear& linear) { FoldLinear(linear, parameters.data(), values.data()); });
  folded.CopyLogStd(parameters.data(), values.data());
  return values;
}

double Dot(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
  return sum;
}

/// W' = W diag(gamma) rounded once, b' = b + W beta summed in float64 along the columns and rounded
/// once; zero in the padding.
void ExpectFolded(const FoldedLinear& linear, const std::vector<float>& parameters,
                  const std::vector<float>& folded) {
  const bool has_norm = linear.norm_weight >= 0;
  for (int row = 0; row < linear.out; ++row) {
    const int flat_row = linear.FlatRow(row);
    double bias = flat_row < 0 ? 0 : parameters[linear.flat_bias + flat_row];
    for (int j = 0; j < linear.in; ++j) {
      float weight = 0, gamma = 1;
      if (flat_row >= 0 && j < linear.flat_in) {
        weight = parameters[linear.flat_weight + flat_row * linear.flat_in + j];
        if (has_norm) gamma = parameters[linear.norm_weight + j];
        if (has_norm) bias += static_cast<double>(weight) * parameters[linear.norm_bias + j];
      }
      EXPECT_EQ(folded[linear.weight + std::int64_t{row} * linear.in + j], weight * gamma);
    }
    EXPECT_EQ(folded[linear.bias + row], static_cast<float>(bias)) << row;
  }
}

TEST(FoldedParametersTest, LayersAreFoldedAlikeOnEveryTarget) {
  const NetworkLayout layout(kShape);
  const FoldedLayout folded(layout);
  const std::vector<float> parameters = DisturbedParameters(layout);
  for (const simd::Target target : simd::SupportedTargets()) {
    SCOPED_TRACE(simd::Name(target));
    const ScopedTarget scoped(target);
    const std::vector<float> values = Folded(folded, parameters);
    int layers = 0;
    folded.ForEachLinear([&](const FoldedLinear& linear) {
      ExpectFolded(linear, parameters, values);
      ++layers;
    });
    EXPECT_EQ(layers, 2 * kShape.hidden_layers + 2 * kShape.gru_layers + 1);
  }
}

/// The chain rule: what unfolds a gradient is the transpose of the derivative of folding. Folding
/// is bilinear in weights and LayerNorms, so that a central difference is that derivative.
TEST(FoldedParametersTest, UnfoldingIsTheTransposeOfTheDerivativeOfFolding) {
  const NetworkLayout layout(kShape);
  const FoldedLayout folded(layout);
  const std::vector<float> parameters = DisturbedParameters(layout);
  std::vector<float> folded_gradient = Normal(folded.size(), 3), unfolded(layout.size());
  // The gradient of a layer that reads unpadded inputs lies transposed.
  std::vector<float> in_order = folded_gradient;
  folded.ForEachLinear([&](const FoldedLinear& linear) {
    for (int row = 0; row < linear.out; ++row) {
      for (int j = 0; j < linear.in; ++j) {
        in_order[linear.weight + std::int64_t{row} * linear.in + j] =
            folded_gradient[linear.WeightGradient(row, j)];
      }
    }
  });
  for (const simd::Target target : simd::SupportedTargets()) {
    SCOPED_TRACE(simd::Name(target));
    const ScopedTarget scoped(target);
    folded.UnfoldGradient(parameters.data(), folded_gradient.data(), unfolded.data());
    double largest = 0;
    for (const unsigned seed : {5u, 6u, 7u}) {
      const std::vector<float> direction = Normal(layout.size(), seed);
      std::vector<float> above = parameters, below = parameters;
      for (std::size_t i = 0; i < above.size(); ++i) {
        above[i] += direction[i];
        below[i] -= direction[i];
      }
      const double difference =
          (Dot(in_order, Folded(folded, above)) - Dot(in_order, Folded(folded, below))) / 2;
      // What the product of two independent vectors of these lengths comes to.
      const double size = std::sqrt(Dot(unfolded, unfolded) * Dot(direction, direction) /
                                    static_cast<double>(direction.size()));
      EXPECT_NEAR(Dot(unfolded, direction) / size, difference / size, kDifference);
      largest = std::max(largest, std::abs(difference / size));
    }
    EXPECT_GT(largest, 0.1) << "directions along which nothing changes show nothing";
  }
}

TEST(FoldedParametersTest, GradientsAreUnfoldedAlikeOnEveryTarget) {
  const NetworkLayout layout(kShape);
  const FoldedLayout folded(layout);
  const std::vector<float> parameters = DisturbedParameters(layout);
  const std::vector<float> folded_gradient = Normal(folded.size(), 3);
  std::vector<std::vector<float>> gradients;
  for (const simd::Target target : simd::SupportedTargets()) {
    const ScopedTarget scoped(target);
    gradients.emplace_back(layout.size());
    folded.UnfoldGradient(parameters.data(), folded_gradient.data(), gradients.back().data());
    EXPECT_EQ(gradients.back(), gradients.front()) << simd::Name(target);
  }
}

}  // namespace
}  // namespace skein
