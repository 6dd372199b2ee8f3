#include "train/network_gradient.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simd/error.h"
#include "simd/target.h"
#include "tests/train/sample_tile.h"
#include "train/autograd_gradient.h"

namespace skein {
namespace {

/// Float32 sums of some hundred terms against float64: a few hundred roundings of 6e-8.
constexpr double kGradientTolerance = 2e-5;
constexpr double kLossTolerance = 1e-5;
/// Central differences in float64 with a step of 1e-5: small enough to miss the kinks of ReLU and
/// clip, truncation of order 1e-10, rounding 1e-16 / 1e-5.
constexpr double kDifferenceTolerance = 1e-7;

const NetworkShape kActor{6, 32, 16, 3, true};
const NetworkShape kCritic{6, 32, 16, 1, false};

LossSettings Settings(int samples) {
  LossSettings settings;
  settings.sample_weight = 1.0 / samples;
  settings.entropy_coefficient = 0.01;
  settings.value_coefficient = 0.7;
  return settings;
}

double RelativeDifference(const std::vector<float>& a, const std::vector<double>& b) {
  double difference = 0, norm = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += (a[i] - b[i]) * (a[i] - b[i]);
    norm += b[i] * b[i];
  }
  return std::sqrt(difference / norm);
}

std::vector<float> GradientBy(const std::string& backend, const NetworkLayout& layout,
                              const std::vector<float>& parameters, const SampleTile& tile,
                              const LossSettings& settings, LossSums* sums = nullptr) {
  const auto gradient = MakeNetworkGradient(backend, layout, 1);
  gradient->SetParameters(parameters.data());
  std::vector<float> accumulator(gradient->accumulator_size(), 0.0f), flat(layout.size());
  const LossSums done = gradient->Accumulate(tile, settings, 0, accumulator.data());
  if (sums != nullptr) *sums = done;
  gradient->Finish(accumulator.data(), flat.data());
  return flat;
}

class NetworkGradientTest : public testing::TestWithParam<simd::Target> {
 protected:
  void SetUp() override { simd::ForceTarget(GetParam()); }
  void TearDown() override { simd::ForceTarget(simd::SupportedTargets().front()); }
};

TEST_P(NetworkGradientTest, AgreesWithAutogradInDoublePrecision) {
  for (const NetworkShape& shape : {kActor, kCritic}) {
    const NetworkLayout layout(shape);
    const std::vector<float> parameters = DisturbedParameters(layout);
    const RandomTile samples(shape, 8, 12);
    for (const bool option : {false, true}) {
      LossSettings settings = Settings(96);
      settings.tanh_mean = option;
      settings.clip_value_loss = option;
      const ReferenceGradient reference =
          ComputeReferenceGradient(layout, parameters, samples.tile(), settings);
      for (const char* const backend : {"tiled", "autograd"}) {
        LossSums sums;
        const std::vector<float> gradient =
            GradientBy(backend, layout, parameters, samples.tile(), settings, &sums);
        EXPECT_LT(RelativeDifference(gradient, reference.gradient), kGradientTolerance) << backend;
        EXPECT_NEAR(sums.policy_loss, reference.sums.policy_loss, kLossTolerance);
        EXPECT_NEAR(sums.value_loss, reference.sums.value_loss, kLossTolerance);
        EXPECT_NEAR(sums.entropy, reference.sums.entropy, kLossTolerance);
        EXPECT_NEAR(sums.approximate_kl, reference.sums.approximate_kl, kLossTolerance);
        EXPECT_NEAR(sums.clip_fraction, reference.sums.clip_fraction, kLossTolerance);
      }
    }
  }
}

TEST_P(NetworkGradientTest, ForwardAgreesWithDoublePrecision) {
  const NetworkLayout layout(kActor);
  const std::vector<float> parameters = DisturbedParameters(layout);
  const RandomTile samples(kActor, 8, 5);
  const ReferenceGradient reference =
      ComputeReferenceGradient(layout, parameters, samples.tile(), Settings(40));
  TiledNetwork network(layout);
  network.SetParameters(parameters.data());
  NetworkWorkspace workspace;
  network.Forward(samples.tile().sequence, workspace);
  for (std::size_t i = 0; i < reference.output.size(); ++i) {
    EXPECT_NEAR(workspace.output()[i], reference.output[i], kLossTolerance);
  }
  const float* const last = workspace.state() + 7 * 5 * kActor.gru_size;
  for (std::size_t i = 0; i < reference.state.size(); ++i) {
    EXPECT_NEAR(last[i], reference.state[i], kLossTolerance);
  }
}

TEST_P(NetworkGradientTest, ResetInsideAChunkEqualsTwoSequences) {
  const NetworkLayout layout(kActor);
  const std::vector<float> parameters = DisturbedParameters(layout);
  RandomTile samples(kActor, 8, 1);
  constexpr int kReset = 3;
  for (int step = 0; step < 8; ++step) samples.keep[step] = step == kReset ? 0.0f : 1.0f;
  const LossSettings settings = Settings(8);
  const std::vector<float> whole =
      GradientBy("tiled", layout, parameters, samples.tile(), settings);

  SampleTile first = samples.tile(), second = samples.tile();
  first.sequence.steps = kReset;
  second.sequence.steps = 8 - kReset;
  const std::vector<float> zero_state(kActor.gru_size, 0.0f);
  const std::vector<float> keeps(8, 1.0f);
  second.sequence.initial_state = zero_state.data();
  second.sequence.keep = keeps.data();
  second.sequence.observation += kReset * kActor.observation_size;
  second.actor.action += kReset * kActor.output_size;
  second.actor.old_log_prob += kReset;
  second.actor.advantage += kReset;
  const std::vector<float> a = GradientBy("tiled", layout, parameters, first, settings);
  const std::vector<float> b = GradientBy("tiled", layout, parameters, second, settings);
  std::vector<double> sum(a.begin(), a.end());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += b[i];
  EXPECT_LT(RelativeDifference(whole, sum), kGradientTolerance);
}

TEST_P(NetworkGradientTest, NotANumberIsNeverSwallowed) {
  const NetworkLayout layout(kCritic);
  const std::vector<float> parameters = DisturbedParameters(layout);
  RandomTile samples(kCritic, 4, 3);
  samples.observation[2] = std::nanf("");
  LossSums sums;
  GradientBy("tiled", layout, parameters, samples.tile(), Settings(12), &sums);
  EXPECT_TRUE(std::isnan(sums.value_loss));
  RandomTile others(kCritic, 4, 3);
  others.keep.assign(12, 1.0f);
  others.state[0] = std::nanf("");
  GradientBy("tiled", layout, parameters, others.tile(), Settings(12), &sums);
  EXPECT_TRUE(std::isnan(sums.value_loss));
}

INSTANTIATE_TEST_SUITE_P(Targets, NetworkGradientTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& target) { return std::string(simd::Name(target.param)); });

TEST(ReferenceGradientTest, AgreesWithFiniteDifferences) {
  for (const NetworkShape& shape : {kActor, kCritic}) {
    const NetworkLayout layout(shape);
    const RandomTile samples(shape, 5, 4);
    const LossSettings settings = Settings(20);
    std::vector<float> parameters = DisturbedParameters(layout);
    const ReferenceGradient reference =
        ComputeReferenceGradient(layout, parameters, samples.tile(), settings);
    // One parameter of every slice.
    for (const ParameterSlice& slice : layout.slices()) {
      float& parameter = parameters[slice.offset];
      const float middle = parameter;
      const float step = 1e-5f;
      parameter = middle + step;
      const double above = parameter;
      const double high =
          ComputeReferenceGradient(layout, parameters, samples.tile(), settings).loss;
      parameter = middle - step;
      const double below = parameter;
      const double low =
          ComputeReferenceGradient(layout, parameters, samples.tile(), settings).loss;
      parameter = middle;
      EXPECT_NEAR((high - low) / (above - below), reference.gradient[slice.offset],
                  kDifferenceTolerance)
          << slice.name;
    }
  }
}

TEST(NetworkGradientFactoryTest, NamesTheBackendsItKnows) {
  const NetworkLayout layout(kCritic);
  EXPECT_THROW(MakeNetworkGradient("magic", layout, 1), Error);
}

}  // namespace
}  // namespace skein
