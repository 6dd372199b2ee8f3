// SPDX-License-Identifier: Apache-2.0
#include "train/network/recurrent_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "simd/target.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"
#include "tests/train/network/gradient_comparison.h"
#include "tests/train/network/sample_tile.h"
#include "train/libtorch/libtorch_network.h"
#include "train/network/folded_parameters.h"
#include "train/network/fused_network.h"

namespace skein {
namespace {

constexpr Tolerance kGradient{2e-5, "float32 sums of some hundred terms, relative"};
constexpr Tolerance kLoss{1e-5, "float32 sums of some hundred terms"};
/// The step of 1e-5 is small enough to miss the kinks of ReLU and clip.
constexpr Tolerance kDifference{1e-7,
                                "central differences: truncation 1e-10, rounding 1e-16 / 1e-5"};

const NetworkShape kActor{6, 32, 16, 3, true};
const NetworkShape kCritic{6, 32, 16, 1, false};

/// Depths, and widths that are whole vectors or not, of actors and critics.
std::vector<NetworkShape> OddShapes() {
  return {
      {6, 32, 16, 3, true, 0, 1}, {6, 20, 33, 3, true, 1, 2},    {6, 33, 20, 1, false, 3, 1},
      {5, 7, 5, 2, true, 2, 3},   {22, 100, 100, 4, true, 2, 1}, {6, 16, 17, 1, false, 0, 3},
      {6, 1, 1, 1, false, 1, 1},
  };
}

std::string NameOf(const NetworkShape& shape) {
  return std::to_string(shape.hidden_layers) + " x " + std::to_string(shape.hidden_size) + ", " +
         std::to_string(shape.gru_layers) + " x " + std::to_string(shape.gru_size) + ", " +
         Name(shape.activation);
}

/// Every slice by itself, so that no large one hides an error in a small one; below a hundredth of
/// the whole gradient a slice is held to the rounding of that.
void ExpectSlicesAgree(const NetworkLayout& layout, const std::vector<float>& gradient,
                       const std::vector<double>& reference) {
  double norm = 0;
  for (const double value : reference) norm += value * value;
  norm = std::sqrt(norm);
  for (std::size_t i = 0; i < layout.slices().size(); ++i) {
    const ParameterSlice& slice = layout.slices()[i];
    const std::int64_t end =
        i + 1 < layout.slices().size() ? layout.slices()[i + 1].offset : layout.size();
    double difference = 0, slice_norm = 0;
    for (std::int64_t at = slice.offset; at < end; ++at) {
      difference += (gradient[at] - reference[at]) * (gradient[at] - reference[at]);
      slice_norm += reference[at] * reference[at];
    }
    EXPECT_LT(std::sqrt(difference), kGradient * std::max(std::sqrt(slice_norm), 0.01 * norm))
        << slice.name;
  }
}

void ExpectForwardAgrees(Backend backend, const NetworkLayout& layout,
                         const std::vector<float>& parameters, const SequenceTile& tile,
                         const ReferenceGradient& reference, NetworkWorkspace& workspace) {
  const auto network = MakeNetwork(backend, layout);
  network->SetParameters(parameters.data());
  network->Forward(tile, workspace);
  for (std::size_t i = 0; i < reference.output.size(); ++i) {
    ASSERT_NEAR(workspace.output()[i], reference.output[i], kLoss);
  }
  for (std::size_t i = 0; i < reference.state.size(); ++i) {
    ASSERT_NEAR(workspace.final_state()[i], reference.state[i], kLoss);
  }
}

class RecurrentNetworkTest : public testing::TestWithParam<simd::Target> {
 protected:
  const ScopedTarget target_{GetParam()};
};

TEST_P(RecurrentNetworkTest, AgreesWithAutogradInDoublePrecision) {
  for (const NetworkShape& shape : {kActor, kCritic}) {
    const NetworkLayout layout(shape);
    const std::vector<float> parameters = DisturbedParameters(layout);
    const RandomTile samples(shape, 8, 12);
    for (const bool option : {false, true}) {
      LossSettings settings = FullLossSettings(96);
      settings.tanh_mean = option;
      settings.clip_value_loss = option;
      const ReferenceGradient reference =
          ComputeReferenceGradient(layout, parameters, samples.tile(), settings);
      for (const Backend backend : {Backend::kFused, Backend::kLibTorch}) {
        LossSums sums;
        const std::vector<float> gradient =
            GradientBy(backend, layout, parameters, samples.tile(), settings, &sums);
        EXPECT_LT(RelativeDifference(gradient, reference.gradient), kGradient) << Name(backend);
        EXPECT_NEAR(sums.policy_loss, reference.sums.policy_loss, kLoss);
        EXPECT_NEAR(sums.value_loss, reference.sums.value_loss, kLoss);
        EXPECT_NEAR(sums.entropy, reference.sums.entropy, kLoss);
        EXPECT_NEAR(sums.approximate_kl, reference.sums.approximate_kl, kLoss);
        EXPECT_NEAR(sums.clip_fraction, reference.sums.clip_fraction, kLoss);
        EXPECT_NEAR(sums.action_change, reference.sums.action_change, kLoss);
      }
    }
  }
}

TEST_P(RecurrentNetworkTest, EveryShapeAgreesWithDoublePrecision) {
  NetworkWorkspace workspace;  // of all shapes, one after the other
  for (const NetworkShape& shape : OddShapes()) {
    SCOPED_TRACE(NameOf(shape));
    const NetworkLayout layout(shape);
    const std::vector<float> parameters = DisturbedParameters(layout);
    const RandomTile samples(shape, 8, 12);
    const LossSettings settings = FullLossSettings(96);
    const ReferenceGradient reference =
        ComputeReferenceGradient(layout, parameters, samples.tile(), settings);
    for (const Backend backend : {Backend::kFused, Backend::kLibTorch}) {
      SCOPED_TRACE(Name(backend));
      ExpectForwardAgrees(backend, layout, parameters, samples.tile().sequence, reference,
                          workspace);
      LossSums sums;
      const std::vector<float> gradient =
          GradientBy(backend, layout, parameters, samples.tile(), settings, &sums);
      ExpectSlicesAgree(layout, gradient, reference.gradient);
      EXPECT_NEAR(sums.policy_loss, reference.sums.policy_loss, kLoss);
      EXPECT_NEAR(sums.value_loss, reference.sums.value_loss, kLoss);
    }
  }
}

/// The sequences of `whole` from `first` on, as many as `part` has.
RandomTile PartOf(const RandomTile& whole, const NetworkShape& shape, int first, int batch) {
  const SequenceTile tile = whole.tile().sequence;
  RandomTile part(shape, tile.steps, batch);
  const auto copy = [&](const std::vector<float>& from, int blocks, std::vector<float>* to) {
    const std::size_t width = from.size() / blocks / tile.batch;
    for (int block = 0; block < blocks; ++block) {
      std::copy_n(from.begin() + (block * tile.batch + first) * width, batch * width,
                  to->begin() + block * batch * width);
    }
  };
  copy(whole.observation, tile.steps, &part.observation);
  copy(whole.state, 1, &part.state);
  copy(whole.action, tile.steps, &part.action);
  copy(whole.log_prob, tile.steps, &part.log_prob);
  copy(whole.advantage, tile.steps, &part.advantage);
  copy(whole.target, tile.steps, &part.target);
  copy(whole.old_value, tile.steps, &part.old_value);
  copy(whole.not_done, tile.steps, &part.not_done);
  return part;
}

/// More rows than the kernels take at once, and more sequences, neither in whole blocks. Parts of
/// one block each have agreed with double precision; among so many rows float32 and float64 would
/// be on different sides of a kink of ReLU somewhere.
TEST_P(RecurrentNetworkTest, TheGradientOfManyRowsIsTheSumOfItsParts) {
  for (const NetworkShape& shape : {kActor, kCritic, NetworkShape{22, 100, 100, 4, true, 2, 2}}) {
    SCOPED_TRACE(NameOf(shape));
    const NetworkLayout layout(shape);
    const std::vector<float> parameters = DisturbedParameters(layout);
    for (const auto& [steps, batch] : {std::pair(8, 29), std::pair(3, 2 * 96 + 5)}) {
      const RandomTile whole(shape, steps, batch);
      const LossSettings settings = FullLossSettings(steps * batch);
      std::vector<double> sum(layout.size());
      const int most = 96 / steps;
      for (int first = 0; first < batch; first += most) {
        const RandomTile part = PartOf(whole, shape, first, std::min(most, batch - first));
        const std::vector<float> gradient =
            GradientBy(Backend::kFused, layout, parameters, part.tile(), settings);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += gradient[i];
      }
      ExpectSlicesAgree(
          layout, GradientBy(Backend::kFused, layout, parameters, whole.tile(), settings), sum);
    }
  }
}

/// What pads the widths is zero after any number of tiles, so that sums over rows do not see it.
TEST_P(RecurrentNetworkTest, PaddingStaysExactlyZero) {
  const NetworkShape shape{6, 20, 9, 3, true, 1, 2};
  const NetworkLayout layout(shape);
  const FoldedLayout folded(layout);
  FusedNetwork network(layout);
  network.SetParameters(DisturbedParameters(layout).data());
  NetworkWorkspace workspace;
  std::vector<float> accumulator(network.accumulator_size(), 0.0f);
  for (const unsigned seed : {1u, 2u}) {
    const RandomTile samples(shape, 8, 12, seed);
    network.AccumulateGradient(samples.tile(), FullLossSettings(96), workspace, accumulator.data());
  }
  std::vector<FoldedLinear> layers;
  for (int i = 0; i <= layout.head(); ++i) layers.push_back(folded.linear(i));
  for (int i = 0; i < shape.gru_layers; ++i) {
    layers.push_back(folded.gru(i).input);
    layers.push_back(folded.gru(i).hidden);
  }
  int padding = 0, others = 0;
  for (const FoldedLinear& linear : layers) {
    for (int row = 0; row < linear.out; ++row) {
      for (int j = 0; j < linear.in; ++j) {
        const bool is_padding = linear.FlatRow(row) < 0 || j >= linear.flat_in;
        const float value = accumulator[linear.WeightGradient(row, j)];
        (is_padding ? padding : others) += value != 0;
      }
      if (linear.FlatRow(row) < 0) padding += accumulator[linear.bias + row] != 0;
    }
  }
  EXPECT_EQ(padding, 0);
  EXPECT_GT(others, 0);
}

TEST_P(RecurrentNetworkTest, FinalStateContinuesTheSequence) {
  const NetworkShape shape{6, 20, 9, 3, true, 1, 3};
  const NetworkLayout layout(shape);
  for (const Backend backend : {Backend::kFused, Backend::kLibTorch}) {
    const auto network = MakeNetwork(backend, layout);
    network->SetParameters(DisturbedParameters(layout).data());
    const RandomTile samples(shape, 6, 5);
    NetworkWorkspace whole, part;
    network->Forward(samples.tile().sequence, whole);
    SequenceTile step = samples.tile().sequence;
    step.steps = 1;
    std::vector<float> state = samples.state;
    for (int i = 0; i < 6; ++i) {
      step.initial_state = state.data();
      network->Forward(step, part);
      state.assign(part.final_state(), part.final_state() + state.size());
      step.observation += 5 * shape.observation_size;
      step.not_done += 5;
    }
    // The same sums, in products of other sizes.
    for (std::size_t i = 0; i < state.size(); ++i) {
      EXPECT_NEAR(state[i], whole.final_state()[i], kLoss);
    }
    for (int i = 0; i < 5 * 3; ++i) {
      EXPECT_NEAR(part.output()[i], whole.output()[5 * 5 * 3 + i], kLoss);
    }
  }
}

TEST_P(RecurrentNetworkTest, SequencesDependNeitherOnOthersNorOnHowStepsAreCalled) {
  constexpr int kSequences = 130, kSteps = 2;  // more than one block of rows, and a rest
  const NetworkShape shape{6, 20, 33, 3, true, 1, 2};
  const NetworkLayout layout(shape);
  FusedNetwork network(layout);
  network.SetParameters(DisturbedParameters(layout).data());
  const RandomTile samples(shape, kSteps, kSequences);
  NetworkWorkspace together, alone;
  network.Forward(samples.tile().sequence, together);
  for (int i = 0; i < kSequences; ++i) {
    std::vector<float> state(samples.state.begin() + i * shape.state_size(),
                             samples.state.begin() + (i + 1) * shape.state_size());
    for (int step = 0; step < kSteps; ++step) {
      const int row = step * kSequences + i;
      network.Forward({1, 1, samples.observation.data() + row * shape.observation_size,
                       state.data(), samples.not_done.data() + row},
                      alone);
      EXPECT_TRUE(std::equal(alone.output(), alone.output() + shape.output_size,
                             together.output() + row * shape.output_size))
          << "step " << step << " of sequence " << i;
      std::copy_n(alone.final_state(), shape.state_size(), state.begin());
    }
    EXPECT_TRUE(
        std::equal(state.begin(), state.end(), together.final_state() + i * shape.state_size()))
        << "state of sequence " << i;
  }
}

TEST_P(RecurrentNetworkTest, ResetInsideAChunkEqualsTwoSequences) {
  const NetworkShape shape{6, 20, 9, 3, true, 1, 2};
  const NetworkLayout layout(shape);
  const std::vector<float> parameters = DisturbedParameters(layout);
  RandomTile samples(shape, 8, 1);
  constexpr int kReset = 3;
  for (int step = 0; step < 8; ++step) samples.not_done[step] = step == kReset ? 0.0f : 1.0f;
  const LossSettings settings = FullLossSettings(8);
  const std::vector<float> whole =
      GradientBy(Backend::kFused, layout, parameters, samples.tile(), settings);

  SampleTile first = samples.tile(), second = samples.tile();
  first.sequence.steps = kReset;
  second.sequence.steps = 8 - kReset;
  const std::vector<float> zero_state(shape.state_size(), 0.0f);
  const std::vector<float> keeps(8, 1.0f);
  second.sequence.initial_state = zero_state.data();
  second.sequence.not_done = keeps.data();
  second.sequence.observation += kReset * shape.observation_size;
  second.actor.action += kReset * shape.output_size;
  second.actor.old_log_prob += kReset;
  second.actor.advantage += kReset;
  const std::vector<float> a = GradientBy(Backend::kFused, layout, parameters, first, settings);
  const std::vector<float> b = GradientBy(Backend::kFused, layout, parameters, second, settings);
  std::vector<double> sum(a.begin(), a.end());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += b[i];
  EXPECT_LT(RelativeDifference(whole, sum), kGradient);
}

/// Quiet, and with a payload that is lost if the lower half of its bits is cut off.
std::vector<float> NotANumbers() {
  const std::uint32_t bits = 0x7f800001u;
  float low_payload;
  std::memcpy(&low_payload, &bits, sizeof bits);
  return {std::nanf(""), low_payload};
}

TEST_P(RecurrentNetworkTest, NotANumberIsNeverSwallowed) {
  for (const NetworkShape& shape : {kActor, kCritic}) {
    const NetworkLayout layout(shape);
    const std::vector<float> parameters = DisturbedParameters(layout);
    for (const LearnerPrecision precision : kRunnablePrecisions) {
      SCOPED_TRACE(Name(precision));
      const auto expect_shows = [&](const RandomTile& samples) {
        LossSums sums;
        const std::vector<float> gradient =
            GradientBy(Backend::kFused, layout, parameters, samples.tile(), FullLossSettings(12),
                       &sums, PrecisionOf(shape, precision));
        EXPECT_TRUE(std::isnan(sums.value_loss + sums.policy_loss));
        EXPECT_TRUE(std::isnan(std::accumulate(gradient.begin(), gradient.end(), 0.0)));
      };
      for (const float value : NotANumbers()) {
        for (const int at : {2, 6 * 12 - 1}) {
          RandomTile samples(shape, 4, 3);
          samples.observation[at] = value;
          expect_shows(samples);
        }
        RandomTile state(shape, 4, 3);
        state.not_done.assign(12, 1.0f);
        state.state[0] = value;
        expect_shows(state);
        RandomTile losses(shape, 4, 3);
        (shape.gaussian ? losses.advantage : losses.target)[11] = value;
        expect_shows(losses);
      }
    }
  }
}

/// Every shape without and with what a loss may have: tanh of the mean, clipped values.
std::vector<std::pair<NetworkShape, bool>> WithBothOptions(
    const std::vector<NetworkShape>& shapes) {
  std::vector<std::pair<NetworkShape, bool>> pairs;
  for (const NetworkShape& shape : shapes) {
    pairs.emplace_back(shape, false);
    pairs.emplace_back(shape, true);
  }
  return pairs;
}

/// The fused kernels' gradient against differences of their own losses: per slice along a random
/// direction, so that every parameter takes part.
TEST_P(RecurrentNetworkTest, AgreesWithFiniteDifferencesOfItsOwnLoss) {
  constexpr double kStep = 1e-3;
  constexpr Tolerance kSlope{1e-3, "float32 losses over the step, and kinks within it"};
  for (const auto& [shape, option] :
       WithBothOptions({{5, 7, 5, 2, true, 1, 2}, {5, 6, 4, 1, false, 1, 1}})) {
    SCOPED_TRACE(NameOf(shape));
    const NetworkLayout layout(shape);
    const RandomTile samples(shape, 5, 8);
    LossSettings settings = FullLossSettings(40);
    settings.tanh_mean = settings.clip_value_loss = option;
    const std::vector<float> middle = DisturbedParameters(layout);
    const auto loss = [&](const std::vector<float>& parameters) {
      LossSums sums;
      GradientBy(Backend::kFused, layout, parameters, samples.tile(), settings, &sums);
      return sums.policy_loss - settings.entropy_coefficient * sums.entropy +
             settings.action_smoothness_coefficient * sums.action_change +
             settings.value_coefficient * sums.value_loss;
    };
    const std::vector<float> gradient =
        GradientBy(Backend::kFused, layout, middle, samples.tile(), settings);
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < layout.slices().size(); ++i) {
      const ParameterSlice& slice = layout.slices()[i];
      const std::int64_t end =
          i + 1 < layout.slices().size() ? layout.slices()[i + 1].offset : layout.size();
      std::vector<double> direction(end - slice.offset);
      double squares = 0;
      for (double& value : direction) squares += std::pow(value = normal(generator), 2);
      std::vector<float> above = middle, below = middle;
      double expected = 0;
      for (std::size_t j = 0; j < direction.size(); ++j) {
        const std::size_t at = slice.offset + j;
        above[at] += static_cast<float>(kStep * direction[j] / std::sqrt(squares));
        below[at] -= static_cast<float>(kStep * direction[j] / std::sqrt(squares));
        expected += gradient[at] * (static_cast<double>(above[at]) - below[at]) / (2 * kStep);
      }
      EXPECT_NEAR((loss(above) - loss(below)) / (2 * kStep), expected, kSlope) << slice.name;
    }
  }
}

/// Of widths that are whole vectors of a target or not.
TEST_P(RecurrentNetworkTest, AnAccumulatorIsFinishedAlikeOnEveryTarget) {
  for (const NetworkShape& shape : OddShapes()) {
    const NetworkLayout layout(shape);
    const std::vector<float> parameters = DisturbedParameters(layout);
    const FusedNetwork network(layout);
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    std::vector<float> accumulator(network.accumulator_size());
    for (float& value : accumulator) value = normal(random);
    std::vector<float> here(layout.size()), scalar(layout.size());
    network.FinishGradient(parameters.data(), accumulator.data(), here.data());
    {
      const ScopedTarget target(simd::Target::kScalar);
      network.FinishGradient(parameters.data(), accumulator.data(), scalar.data());
    }
    EXPECT_EQ(here, scalar) << shape.hidden_size << " wide";
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, RecurrentNetworkTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& target) { return std::string(simd::Name(target.param)); });

/// One parameter of every slice and more of the larger ones, of the reference in float64.
TEST(ReferenceGradientTest, AgreesWithFiniteDifferences) {
  auto cases = WithBothOptions({kActor, kCritic, {5, 7, 5, 2, true, 1, 2}});
  for (const auto& [activation, name] : kActivationNames) {
    cases.push_back({{5, 6, 4, 1, false, 1, 1, activation}, false});
    cases.push_back({{5, 6, 4, 2, true, 0, 2, activation}, true});
  }
  for (const auto& [shape, option] : cases) {
    SCOPED_TRACE(NameOf(shape));
    const NetworkLayout layout(shape);
    const RandomTile samples(shape, 5, 4);
    LossSettings settings = FullLossSettings(20);
    settings.tanh_mean = settings.clip_value_loss = option;
    std::vector<float> parameters = DisturbedParameters(layout);
    const ReferenceGradient reference =
        ComputeReferenceGradient(layout, parameters, samples.tile(), settings);
    const auto loss = [&] {
      return ComputeReferenceGradient(layout, parameters, samples.tile(), settings).loss;
    };
    for (std::size_t i = 0; i < layout.slices().size(); ++i) {
      const ParameterSlice& slice = layout.slices()[i];
      const std::int64_t end =
          i + 1 < layout.slices().size() ? layout.slices()[i + 1].offset : layout.size();
      for (const std::int64_t at : {slice.offset, (slice.offset + end - 1) / 2}) {
        float& parameter = parameters[at];
        const float middle = parameter;
        const float step = 1e-5f;
        parameter = middle + step;
        const double above = parameter, high = loss();
        parameter = middle - step;
        const double below = parameter, low = loss();
        parameter = middle;
        EXPECT_NEAR((high - low) / (above - below), reference.gradient[at], kDifference)
            << slice.name;
      }
    }
  }
}

TEST(LibTorchNetworkTest, EveryActivationAgreesWithDoublePrecision) {
  NetworkWorkspace workspace;
  for (const auto& [activation, name] : kActivationNames) {
    NetworkShape shape{6, 20, 9, 3, true, 2, 2, activation};
    SCOPED_TRACE(name);
    const NetworkLayout layout(shape);
    const std::vector<float> parameters = DisturbedParameters(layout);
    const RandomTile samples(shape, 8, 12);
    const ReferenceGradient reference =
        ComputeReferenceGradient(layout, parameters, samples.tile(), FullLossSettings(96));
    ExpectForwardAgrees(Backend::kLibTorch, layout, parameters, samples.tile().sequence, reference,
                        workspace);
    EXPECT_LT(RelativeDifference(GradientBy(Backend::kLibTorch, layout, parameters, samples.tile(),
                                            FullLossSettings(96)),
                                 reference.gradient),
              kGradient);
  }
}

}  // namespace
}  // namespace skein
