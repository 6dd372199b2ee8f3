// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/adam.h"

#include <gtest/gtest.h>
#include <torch/optim/adam.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "simd/random.h"
#include "simd/target.h"
#include "tests/extremes.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

/// No whole number of vectors on any target but scalar.
constexpr int kSize = 1003;
constexpr int kSteps = 1000;
constexpr double kEpsilon = 1e-5;
/// Of the largest parameter. LibTorch fuses multiply and add where the processor can, as avx512 and
/// avx2 do; without that, sums end a unit in the last place away.
constexpr Tolerance kFused{1e-7, "float32 rounding, in the same order"};
constexpr Tolerance kUnfused{2.4e-7, "float32 rounding, of products on their own"};

/// As training lowers it.
double LearningRate(int step) { return 1e-3 * (1 - 0.98 * step / kSteps); }

std::vector<float> FirstParameters() {
  simd::RandomStream random({1, 0, 0, 0, simd::RandomPurpose::kNetworkInitialisation});
  std::vector<float> values(kSize);
  for (float& value : values) value = static_cast<float>(random.Uniform(-1, 1));
  return values;
}

/// Of magnitudes 1 to 1e-6, and zeros.
void FillGradient(int step, float* gradient) {
  simd::RandomStream random(
      {2, static_cast<std::uint32_t>(step), 0, 0, simd::RandomPurpose::kNetworkInitialisation});
  for (int i = 0; i < kSize; ++i) {
    const double scale = std::pow(10.0, -(i % 7));
    gradient[i] = i % 13 == 0 ? 0 : static_cast<float>(scale * random.Uniform(-1, 1.5));
  }
}

std::vector<float> ByLibTorch() {
  std::vector<float> values = FirstParameters();
  torch::Tensor parameters = torch::from_blob(values.data(), {kSize}).clone().requires_grad_(true);
  parameters.mutable_grad() = torch::zeros({kSize});
  torch::optim::Adam adam({parameters}, torch::optim::AdamOptions().eps(kEpsilon));
  for (int step = 0; step < kSteps; ++step) {
    FillGradient(step, parameters.mutable_grad().data_ptr<float>());
    static_cast<torch::optim::AdamOptions&>(adam.param_groups()[0].options())
        .lr(LearningRate(step));
    adam.step();
  }
  std::copy_n(parameters.data_ptr<float>(), kSize, values.begin());
  return values;
}

void TakeSteps(int begin, int end, AdamOptimiser& adam) {
  for (int step = begin; step < end; ++step) {
    FillGradient(step, adam.gradient());
    adam.Step(LearningRate(step));
  }
}

std::vector<float> ParametersOf(const AdamOptimiser& adam) {
  return {adam.parameters(), adam.parameters() + adam.size()};
}

class AdamTest : public testing::TestWithParam<simd::Target> {
 protected:
  const ScopedTarget target_{GetParam()};
};

TEST_P(AdamTest, AgreesWithLibTorchOverAThousandSteps) {
  const std::vector<float> reference = ByLibTorch();
  AdamOptimiser adam(FirstParameters(), kEpsilon);
  TakeSteps(0, kSteps, adam);
  double largest = 0, difference = 0;
  for (int i = 0; i < kSize; ++i) {
    largest = std::max<double>(largest, std::abs(reference[i]));
    difference = Larger<double>(difference, std::abs(adam.parameters()[i] - reference[i]));
  }
  EXPECT_LE(difference / largest, simd::FusesMultiplyAdd(GetParam()) ? kFused : kUnfused);
}

TEST_P(AdamTest, ResumesBitExactly) {
  AdamOptimiser whole(FirstParameters(), kEpsilon);
  TakeSteps(0, 20, whole);
  AdamOptimiser first(FirstParameters(), kEpsilon);
  TakeSteps(0, 10, first);
  AdamOptimiser second(ParametersOf(first), kEpsilon);
  second.Restore(first.state());
  TakeSteps(10, 20, second);
  EXPECT_EQ(ParametersOf(second), ParametersOf(whole));
}

TEST_P(AdamTest, MovesAPartSoManyTimesAsFar) {
  constexpr int kBegin = 3, kEnd = 7;
  AdamOptimiser even(FirstParameters(), kEpsilon);
  AdamOptimiser hastened(FirstParameters(), kEpsilon, {kBegin, kEnd, 16});
  TakeSteps(0, 1, even);
  TakeSteps(0, 1, hastened);
  const std::vector<float> first = FirstParameters();
  for (int i = 0; i < kSize; ++i) {
    const float way = even.parameters()[i] - first[i];
    const float times = i >= kBegin && i < kEnd ? 16 : 1;
    EXPECT_FLOAT_EQ(hastened.parameters()[i], first[i] + times * way) << i;
  }
}

TEST_P(AdamTest, RefusesMomentsOfAnotherSize) {
  AdamOptimiser adam(FirstParameters(), kEpsilon);
  AdamState state = adam.state();
  state.second_moment.pop_back();
  EXPECT_THROW(adam.Restore(state), Error);
}

INSTANTIATE_TEST_SUITE_P(Targets, AdamTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& target) { return simd::Name(target.param); });

}  // namespace
}  // namespace skein
