// SPDX-License-Identifier: Apache-2.0
// Every precision of the fused kernels against autograd in float64: gradients of random tiles and
// of a training's own rollout, and its log-probabilities.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <numeric>

#include "simd/target.h"
#include "tests/scoped_target.h"
#include "tests/scratch_directory.h"
#include "tests/tolerance.h"
#include "tests/train/network/gradient_comparison.h"
#include "tests/train/network/sample_tile.h"
#include "tests/train/small_config.h"
#include "train/libtorch/libtorch_network.h"
#include "train/ppo/rollout.h"
#include "train/ppo/trainer.h"
#include "train/ppo/training_state.h"

namespace skein {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

constexpr Tolerance kFloat32Gradient{1e-5, "some hundred float32 roundings of random signs"};
constexpr Tolerance kMixedGradient{1e-2, "bfloat16 rounding in the backward products"};

/// How far a gradient may be from float64's. Operands of bfloat16 have roundings of 2^-9, in the
/// backward products alone (mixed) or also in the forward pass, where they move ReLUs across zero
/// and ratios across the clip.
struct Bound {
  NetworkPrecision precision;
  const char* name;
  double relative_difference;
  double cosine;
};
std::vector<Bound> Bounds() {
  return {{ActorPrecision(LearnerPrecision::kFloat32), "fp32", kFloat32Gradient, 0.9999999},
          {ActorPrecision(LearnerPrecision::kMixed), "mixed", kMixedGradient, 0.9999},
          {ActorPrecision(LearnerPrecision::kBfloat16), "bf16", kUnbounded, 0.97},
          {ActorPrecision(LearnerPrecision::kAmx), "amx, actor", kMixedGradient, 0.9999},
          {CriticPrecision(LearnerPrecision::kAmx), "amx, critic", kUnbounded, 0.97}};
}

constexpr Tolerance kLogProb{1e-5, "float32 sums of a hundred terms, of values of about six"};

/// One sequence of a tile.
class SequenceOf {
 public:
  SequenceOf(const NetworkShape& shape, const SampleTile& tile, int index) {
    const int steps = tile.sequence.steps, batch = tile.sequence.batch;
    const auto column = [&](const float* values, int size) {
      std::vector<float> out;
      for (int step = 0; values != nullptr && step < steps; ++step) {
        const float* const row = values + (static_cast<std::int64_t>(step) * batch + index) * size;
        out.insert(out.end(), row, row + size);
      }
      return columns_.emplace_back(std::move(out)).data();
    };
    tile_.sequence = {steps, 1, column(tile.sequence.observation, shape.observation_size),
                      tile.sequence.initial_state + index * shape.state_size(),
                      column(tile.sequence.not_done, 1)};
    tile_.actor = {column(tile.actor.action, shape.output_size), column(tile.actor.old_log_prob, 1),
                   column(tile.actor.advantage, 1)};
    tile_.target = column(tile.target, 1);
    tile_.old_value = column(tile.old_value, 1);
  }

  const SampleTile& tile() const { return tile_; }

 private:
  std::deque<std::vector<float>> columns_;
  SampleTile tile_;
};

/// The relative difference without the sequences that lie on a kink: where a ReLU's argument (or a
/// ratio beside the clip) is zero to the last bit, float32 may take the other side than float64,
/// and either is right. Such a sequence is far off by itself, and there are few: errors of kernels
/// are in all.
double DifferenceOffKinks(const NetworkLayout& layout, const std::vector<float>& parameters,
                          const SampleTile& tile, const LossSettings& settings,
                          std::vector<float> gradient, std::vector<double> reference) {
  constexpr double kOnKink = 1e-4;
  const int batch = tile.sequence.batch;
  int kinks = 0;
  for (int i = 0; i < batch; ++i) {
    const SequenceOf sequence(layout.shape(), tile, i);
    const std::vector<float> part =
        GradientBy(Backend::kFused, layout, parameters, sequence.tile(), settings);
    const std::vector<double> part_reference =
        ComputeReferenceGradient(layout, parameters, sequence.tile(), settings).gradient;
    if (RelativeDifference(part, part_reference) < kOnKink) continue;
    ++kinks;
    for (std::size_t j = 0; j < part.size(); ++j) {
      gradient[j] -= part[j];
      reference[j] -= part_reference[j];
    }
  }
  EXPECT_LE(kinks, 1 + batch / 20);
  return RelativeDifference(gradient, reference);
}

void ExpectGradientsAgree(const NetworkLayout& layout, const std::vector<float>& parameters,
                          const SampleTile& tile, const LossSettings& settings) {
  const ReferenceGradient reference = ComputeReferenceGradient(layout, parameters, tile, settings);
  for (const Bound& bound : Bounds()) {
    SCOPED_TRACE(bound.name);
    const std::vector<float> gradient =
        GradientBy(Backend::kFused, layout, parameters, tile, settings, nullptr, bound.precision);
    double relative = RelativeDifference(gradient, reference.gradient);
    const double cosine = Cosine(gradient, reference.gradient);
    if (relative > bound.relative_difference) {
      ASSERT_EQ(bound.precision.backward, simd::Precision::kFloat32);
      relative =
          DifferenceOffKinks(layout, parameters, tile, settings, gradient, reference.gradient);
    }
    EXPECT_LE(relative, bound.relative_difference);
    EXPECT_GE(cosine, bound.cosine);
    // A precision that took no effect would agree too well.
    EXPECT_EQ(relative > 1e-4, bound.precision.backward != simd::Precision::kFloat32);
  }
}

class PrecisionTest : public testing::TestWithParam<simd::Target> {
 protected:
  const ScopedTarget target_{GetParam()};
};

TEST_P(PrecisionTest, GradientsOfRandomTilesAgreeWithDoublePrecision) {
  for (const NetworkShape& shape :
       {NetworkShape{22, 128, 128, 4, true}, NetworkShape{22, 128, 128, 1, false},
        NetworkShape{6, 20, 33, 3, true, 1, 2}, NetworkShape{6, 33, 20, 1, false, 3, 1}}) {
    const NetworkLayout layout(shape);
    const std::vector<float> parameters = DisturbedParameters(layout);
    const RandomTile samples(shape, 8, 13);
    for (const bool option : {false, true}) {
      LossSettings settings = FullLossSettings(8 * 13);
      settings.tanh_mean = option;
      settings.clip_value_loss = option;
      ExpectGradientsAgree(layout, parameters, samples.tile(), settings);
    }
  }
}

/// The rollout of a training's next iteration, and the state before and after its update.
class TrainedRollout {
 public:
  explicit TrainedRollout(const TrainConfig& config)
      : config_(config),
        trainer_(config, pool_),
        env_(config.env, config.ppo.num_aircraft, config.seed, config.learner.rollout_tile),
        actor_layout_(ActorShape(config.network, env_.observation_size(), env_.action_size())),
        critic_layout_(CriticShape(config.network, env_.observation_size())),
        rollout_(config.ppo, env_.observation_size(), env_.action_size(),
                 actor_layout_.shape().state_size()) {
    constexpr int kIterationsBefore = 3;
    for (int i = 0; i < kIterationsBefore; ++i) trainer_.Iterate();
    before_ = State();
    trainer_.Iterate();
    after_ = State();
    Fly();
    NormaliseAdvantages();
  }

  const NetworkLayout& actor_layout() const { return actor_layout_; }
  const NetworkLayout& critic_layout() const { return critic_layout_; }
  const Rollout& rollout() const { return rollout_; }
  const TrainingState& before() const { return before_; }
  const TrainingState& after() const { return after_; }

  /// Chunk `chunk` of all aircraft, with the actor's states or the critic's. Critics' samples are
  /// in the scale of `state`; they stand until the next call.
  SampleTile Tile(int chunk, bool actor, const TrainingState& state) {
    const int length = rollout_.chunk_length, aircraft = rollout_.aircraft;
    const std::int64_t row = rollout_.row(chunk * length, 0);
    const ValueScale scale = state.popart.scale();
    const auto scaled = [&](const std::vector<float>& values, std::vector<float>* out) {
      out->resize(static_cast<std::size_t>(length) * aircraft);
      for (std::size_t i = 0; i < out->size(); ++i) {
        (*out)[i] = static_cast<float>((values[row + i] - scale.mean) / scale.std);
      }
    };
    scaled(rollout_.target, &target_);
    scaled(rollout_.value, &old_value_);
    const std::vector<float>& states = actor ? rollout_.actor_state : rollout_.critic_state;
    SampleTile tile;
    tile.sequence = {length, aircraft,
                     rollout_.observation.data() + row * rollout_.observation_size,
                     states.data() + rollout_.row(chunk, 0) * rollout_.state_size,
                     rollout_.not_done.data() + row};
    tile.actor = {rollout_.action.data() + row * rollout_.action_size,
                  rollout_.log_prob.data() + row, rollout_.advantage.data() + row};
    tile.target = target_.data();
    tile.old_value = old_value_.data();
    return tile;
  }

 private:
  TrainingState State() const {
    const ScratchDirectory scratch;
    const std::string path = scratch / "checkpoint.skein";
    trainer_.Save(path);
    return LoadCheckpoint(TensorFile::Read(path), path, trainer_.config(), actor_layout_,
                          critic_layout_);
  }

  void Fly() {
    const auto actor = MakeNetwork(Backend::kFused, actor_layout_);
    const auto critic = MakeNetwork(Backend::kFused, critic_layout_);
    actor->SetParameters(before_.actor.data());
    critic->SetParameters(before_.critic.data());
    const float* const log_std = before_.actor.data() + actor_layout_.log_std();
    RolloutSettings settings;
    settings.seed = config_.seed;
    settings.first_policy_step = before_.policy_steps;
    settings.tanh_mean = config_.network.tanh_mean;
    settings.value_scale = before_.popart.scale();
    env_.Restore(before_.env);
    RecurrentState state = before_.recurrent;
    CollectRollout(env_, *actor, *critic, {log_std, log_std + env_.action_size()}, settings, pool_,
                   state, rollout_);
    EXPECT_EQ(env_.Snapshot(), after_.env) << "it is the training's own";
  }

  void NormaliseAdvantages() {
    std::vector<float>& values = rollout_.advantage;
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0;
    for (const float value : values) squares += (value - mean) * (value - mean);
    const double inverse_std = 1 / std::sqrt(squares / count);
    for (float& value : values) value = static_cast<float>((value - mean) * inverse_std);
  }

  TrainConfig config_;
  WorkerPool pool_{2};
  Trainer trainer_;
  VecEnv env_;
  NetworkLayout actor_layout_, critic_layout_;
  Rollout rollout_;
  TrainingState before_, after_;
  std::vector<float> target_, old_value_;
};

/// The paper's networks, in float32, on few aircraft.
TrainConfig RealConfig() {
  TrainConfig config = SmallConfig();
  config.network.hidden_size = 128;
  config.network.gru_size = 128;
  config.ppo.num_aircraft = 48;
  config.learner.precision = LearnerPrecision::kFloat32;
  config.evaluation.interval_iterations = 0;
  return config;
}

int ResetsInsideChunks(const Rollout& rollout) {
  int resets = 0;
  for (int step = 0; step < rollout.steps; ++step) {
    if (step % rollout.chunk_length == 0) continue;
    for (int i = 0; i < rollout.aircraft; ++i)
      resets += rollout.not_done[rollout.row(step, i)] == 0;
  }
  return resets;
}

/// Real networks take too long on the others, which random tiles have been through.
class RealRolloutTest : public PrecisionTest {};

TEST_P(RealRolloutTest, GradientsAgreeWithDoublePrecision) {
  TrainedRollout flown(RealConfig());
  const Rollout& rollout = flown.rollout();
  ASSERT_GT(ResetsInsideChunks(rollout), 0);
  for (int chunk = 0; chunk < rollout.chunks(); ++chunk) {
    // Before the update all ratios are one; after it they lie on both sides of the clip.
    for (const TrainingState* const state : {&flown.before(), &flown.after()}) {
      LossSettings settings = FullLossSettings(rollout.chunk_length * rollout.aircraft);
      ExpectGradientsAgree(flown.actor_layout(), state->actor, flown.Tile(chunk, true, *state),
                           settings);
      for (const bool option : {false, true}) {
        settings.clip_value_loss = option;
        ExpectGradientsAgree(flown.critic_layout(), state->critic, flown.Tile(chunk, false, *state),
                             settings);
      }
    }
  }
}

TEST_P(RealRolloutTest, LogProbabilitiesAgreeWithDoublePrecision) {
  TrainedRollout flown(RealConfig());
  const Rollout& rollout = flown.rollout();
  const int size = rollout.action_size;
  const float* const log_std = flown.before().actor.data() + flown.actor_layout().log_std();
  const double half_log_two_pi = 0.5 * std::log(2 * M_PI);
  for (int chunk = 0; chunk < rollout.chunks(); ++chunk) {
    const SampleTile tile = flown.Tile(chunk, true, flown.before());
    const std::vector<double> output =
        ComputeReferenceGradient(flown.actor_layout(), flown.before().actor, tile,
                                 FullLossSettings(static_cast<int>(tile.sequence.rows())))
            .output;
    for (std::int64_t i = 0; i < tile.sequence.rows(); ++i) {
      double expected = 0;
      for (int j = 0; j < size; ++j) {
        const double deviation =
            (tile.actor.action[i * size + j] - std::tanh(output[i * size + j])) *
            std::exp(-static_cast<double>(log_std[j]));
        expected -= 0.5 * deviation * deviation + log_std[j] + half_log_two_pi;
      }
      EXPECT_NEAR(tile.actor.old_log_prob[i], expected, kLogProb);
    }
  }
}

std::vector<simd::Target> FastTargets() {
  std::vector<simd::Target> targets;
  for (const simd::Target target : simd::SupportedTargets()) {
    if (simd::FusesMultiplyAdd(target)) targets.push_back(target);
  }
  return targets.empty() ? simd::SupportedTargets() : targets;
}

INSTANTIATE_TEST_SUITE_P(Targets, RealRolloutTest, testing::ValuesIn(FastTargets()),
                         [](const auto& target) { return std::string(simd::Name(target.param)); });
INSTANTIATE_TEST_SUITE_P(Targets, PrecisionTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& target) { return std::string(simd::Name(target.param)); });

}  // namespace
}  // namespace skein
