// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/ppo_update.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tests/tolerance.h"
#include "tests/train/network/gradient_comparison.h"
#include "tests/train/small_config.h"

namespace skein {
namespace {

constexpr int kObserved = 5, kPrivileged = 3, kActions = 4;
constexpr Tolerance kSumOrder{2e-5, "float32 gradients and losses added up in another order"};
constexpr ValueScale kScale{-30, 12};

TrainConfig UpdateConfig() {
  TrainConfig config = SmallConfig();
  config.learner.precision = LearnerPrecision::kFloat32;
  config.learner.tile_samples = 20;  // five chunks: 96 are no whole number of tiles
  config.ppo.num_aircraft = 24;
  config.ppo.chunk_length = 4;
  config.ppo.epochs = config.ppo.minibatches = 1;
  config.ppo.clip_value_loss = config.ppo.privileged_critic = true;
  config.ppo.action_smoothness_coefficient = 0.3;
  config.ppo.value_coefficient = 0.7;
  return config;
}

/// Networks, and a rollout of random numbers in all that an update reads of it.
struct RandomUpdate {
  explicit RandomUpdate(const TrainConfig& training)
      : config(training),
        networks(config, kObserved, kPrivileged, kActions),
        rollout(config.ppo, kObserved, kActions, networks.actor.layout().shape().state_size(),
                kPrivileged) {
    std::mt19937 generator(3);
    const auto fill = [&](std::vector<float>& values, float mean, float spread) {
      std::normal_distribution<float> normal(mean, spread);
      for (float& value : values) value = normal(generator);
    };
    for (auto* const column : {&rollout.observation, &rollout.joined_observation, &rollout.action,
                               &rollout.actor_state, &rollout.critic_state}) {
      fill(*column, 0, 1);
    }
    fill(rollout.advantage, 4, 7);
    fill(rollout.value, -30, 12);
    fill(rollout.target, -30, 12);
    // About the log-probability of such actions, so that ratios lie on both sides of the clip.
    fill(rollout.log_prob, -1.42f * kActions, 0.2f);
    for (float& not_done : rollout.not_done) not_done = generator() % 10 == 0 ? 0.0f : 1.0f;
  }

  /// By a learning rate of zero: the networks stay as they are.
  UpdateReport Run() {
    WorkerPool pool(2);
    return PpoUpdate(config, networks, pool).Run(rollout, kScale, 0, {0, 0});
  }

  TrainConfig config;
  ActorCritic networks;
  Rollout rollout;
};

/// The advantages as the loss is to see them.
std::vector<float> ExpectedAdvantages(const RandomUpdate& update) {
  std::vector<float> advantages = update.rollout.advantage;
  if (!update.config.ppo.normalise_advantages) return advantages;
  const auto count = static_cast<double>(advantages.size());
  const double mean = std::accumulate(advantages.begin(), advantages.end(), 0.0) / count;
  double variance = 0;
  for (const float advantage : advantages) variance += std::pow(advantage - mean, 2) / count;
  for (float& advantage : advantages) {
    advantage = static_cast<float>((advantage - mean) / std::sqrt(variance));
  }
  return advantages;
}

std::vector<float> InScale(std::vector<float> values) {
  for (float& value : values) value = static_cast<float>((value - kScale.mean) / kScale.std);
  return values;
}

/// Losses of all samples, and the norm of their gradient.
struct Whole {
  LossSums losses;
  double gradient_norm = 0;
};

/// Computed where the rollout has the samples: all aircraft's chunks that begin with the same step
/// lie there as one tile.
Whole ComputeWhole(RandomUpdate& update, TrainedNetwork& trained) {
  const Rollout& rollout = update.rollout;
  const PpoConfig& ppo = update.config.ppo;
  const bool is_actor = trained.layout().shape().gaussian;
  const std::vector<float> advantage = ExpectedAdvantages(update);
  const std::vector<float> target = InScale(rollout.target), value = InScale(rollout.value);
  const std::vector<float>& seen = is_actor ? rollout.observation : rollout.critic_observation();
  const int seen_size = is_actor ? kObserved : kObserved + kPrivileged;
  LossSettings settings;
  settings.clip = ppo.clip;
  settings.entropy_coefficient = ppo.entropy_coefficient;
  settings.value_coefficient = ppo.value_coefficient;
  settings.clip_value_loss = ppo.clip_value_loss;
  settings.action_smoothness_coefficient = ppo.action_smoothness_coefficient;
  settings.sample_weight = 1.0 / static_cast<double>(rollout.samples());
  settings.pair_weight = 1.0 / (rollout.aircraft * rollout.chunks() * (rollout.chunk_length - 1.0));
  trained.TakeParameters();
  Whole whole;
  std::vector<double> gradient(static_cast<std::size_t>(trained.layout().size()), 0.0);
  for (int chunk = 0; chunk < rollout.chunks(); ++chunk) {
    const std::int64_t row = rollout.row(chunk * rollout.chunk_length, 0);
    const std::vector<float>& states = is_actor ? rollout.actor_state : rollout.critic_state;
    SampleTile tile;
    tile.sequence = {rollout.chunk_length, rollout.aircraft, seen.data() + row * seen_size,
                     states.data() + rollout.row(chunk, 0) * rollout.state_size,
                     rollout.not_done.data() + row};
    tile.actor = {rollout.action.data() + row * kActions, rollout.log_prob.data() + row,
                  advantage.data() + row};
    tile.target = target.data() + row;
    tile.old_value = value.data() + row;
    LossSums losses;
    const std::vector<float> part =
        GradientBy(*trained.network, trained.optimiser.parameters(), tile, settings, &losses);
    for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] += part[i];
    whole.losses += losses;
  }
  whole.gradient_norm =
      std::sqrt(std::inner_product(gradient.begin(), gradient.end(), gradient.begin(), 0.0));
  return whole;
}

class PpoUpdateTest : public testing::TestWithParam<bool> {
 protected:
  static TrainConfig Config() {
    TrainConfig config = UpdateConfig();
    config.ppo.normalise_advantages = GetParam();
    return config;
  }
};

TEST_P(PpoUpdateTest, AMinibatchOfAllChunksHasTheLossesAndGradientsOfTheRollout) {
  RandomUpdate update(Config());
  const Whole actor = ComputeWhole(update, update.networks.actor);
  const Whole critic = ComputeWhole(update, update.networks.critic);
  const UpdateReport report = update.Run();
  EXPECT_NEAR(report.actor_gradient_norm / actor.gradient_norm, 1, kSumOrder);
  EXPECT_NEAR(report.critic_gradient_norm / critic.gradient_norm, 1, kSumOrder);
  EXPECT_NEAR(report.losses.policy_loss / actor.losses.policy_loss, 1, kSumOrder);
  EXPECT_NEAR(report.losses.value_loss / critic.losses.value_loss, 1, kSumOrder);
  EXPECT_NEAR(report.losses.entropy / actor.losses.entropy, 1, kSumOrder);
  EXPECT_NEAR(report.losses.approximate_kl / actor.losses.approximate_kl, 1, kSumOrder);
  EXPECT_NEAR(report.losses.clip_fraction, actor.losses.clip_fraction, kSumOrder);
  EXPECT_NEAR(report.losses.action_change / actor.losses.action_change, 1, kSumOrder);
  EXPECT_GT(report.losses.clip_fraction, 0);
  EXPECT_LT(report.losses.clip_fraction, 1);
}

TEST_P(PpoUpdateTest, MinibatchesOfAnEpochTogetherHaveTheLossesOfTheRollout) {
  TrainConfig config = Config();
  const UpdateReport whole = RandomUpdate(config).Run();
  config.ppo.epochs = 2;
  config.ppo.minibatches = 6;
  const UpdateReport report = RandomUpdate(config).Run();
  EXPECT_NEAR(report.losses.policy_loss / whole.losses.policy_loss, 1, kSumOrder);
  EXPECT_NEAR(report.losses.value_loss / whole.losses.value_loss, 1, kSumOrder);
  EXPECT_NEAR(report.losses.approximate_kl / whole.losses.approximate_kl, 1, kSumOrder);
  EXPECT_NEAR(report.losses.action_change / whole.losses.action_change, 1, kSumOrder);
  // Fewer samples scatter more about the same mean.
  EXPECT_GT(report.actor_gradient_norm, whole.actor_gradient_norm);
  EXPECT_GT(report.critic_gradient_norm, whole.critic_gradient_norm);
}

INSTANTIATE_TEST_SUITE_P(Advantages, PpoUpdateTest, testing::Bool(), [](const auto& normalised) {
  return normalised.param ? "Normalised" : "AsTheyAre";
});

TEST(PpoUpdateStepTest, EachNetworkStepsByItsOwnRate) {
  const RandomUpdate before(UpdateConfig());
  for (const bool is_actor : {true, false}) {
    RandomUpdate update(UpdateConfig());
    WorkerPool pool(1);
    PpoUpdate(update.config, update.networks, pool)
        .Run(update.rollout, kScale, 0, {is_actor ? 1e-3 : 0, is_actor ? 0 : 1e-3});
    const auto moved = [&](TrainedNetwork ActorCritic::*network) {
      return (update.networks.*network).optimiser.ParameterVector() !=
             (before.networks.*network).optimiser.ParameterVector();
    };
    EXPECT_EQ(moved(&ActorCritic::actor), is_actor);
    EXPECT_EQ(moved(&ActorCritic::critic), !is_actor);
  }
}

}  // namespace
}  // namespace skein
