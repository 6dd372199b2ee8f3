// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/rollout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "envs/step_memory.h"
#include "tests/tolerance.h"
#include "tests/train/small_config.h"
#include "train/network/fused_network.h"
#include "train/network/ppo_loss.h"

namespace skein {
namespace {

constexpr Tolerance kAdvantage{1e-4, "a few float32 roundings of values of some tens"};
constexpr Tolerance kTruncated{2e-4, "float32 rewards of some hundreds, values of other tiles"};
constexpr Tolerance kLogProb{1e-4, "float32 products of other tiles, summed in another order"};

/// The definition, term by term: A_t = sum over l of (gamma lambda)^l delta_{t+l} to the episode's
/// end.
double AdvantageByDefinition(const Rollout& rollout, int step, int aircraft, double gamma,
                             double lambda) {
  double advantage = 0, factor = 1;
  for (int t = step; t < rollout.steps; ++t) {
    const std::int64_t row = rollout.row(t, aircraft);
    const double next = rollout.done[row]        ? 0
                        : t + 1 == rollout.steps ? rollout.bootstrap[aircraft]
                                                 : rollout.value[row + rollout.aircraft];
    advantage += factor * (rollout.reward[row] + gamma * next - rollout.value[row]);
    if (rollout.done[row]) break;
    factor *= gamma * lambda;
  }
  return advantage;
}

TEST(AdvantagesTest, AgreeWithTheirDefinition) {
  PpoConfig config;
  config.num_aircraft = 7;
  config.rollout_steps = 24;
  Rollout rollout(config, 2, 1, 16);
  std::mt19937 generator(1);
  std::normal_distribution<float> normal;
  for (auto* const column : {&rollout.reward, &rollout.value, &rollout.bootstrap}) {
    for (float& value : *column) value = normal(generator);
  }
  for (std::uint8_t& end : rollout.done) end = generator() % 6 == 0;
  ComputeAdvantages(0, 7, 0.97, 0.9, rollout);
  for (int step = 0; step < 24; ++step) {
    for (int aircraft = 0; aircraft < 7; ++aircraft) {
      const std::int64_t row = rollout.row(step, aircraft);
      EXPECT_NEAR(rollout.advantage[row], AdvantageByDefinition(rollout, step, aircraft, 0.97, 0.9),
                  kAdvantage);
      EXPECT_FLOAT_EQ(rollout.target[row], rollout.advantage[row] + rollout.value[row]);
    }
  }
}

TEST(AdvantagesTest, RolloutStepsMustBeWholeChunks) {
  PpoConfig config;
  config.rollout_steps = 20;
  EXPECT_THROW(Rollout(config, 22, 4, 16), Error);
}

/// A rollout of a small configuration with everything that made it.
struct Flight {
  explicit Flight(const TrainConfig& training)
      : config(training),
        pool(2),
        env(config.env, config.ppo.num_aircraft, config.seed, config.learner.rollout_tile),
        actor_layout(ActorShape(config.network, env.observation_size(), env.action_size())),
        critic_layout(
            CriticShape(config.network, env.observation_size() + PrivilegedSize(config.ppo, env))),
        actor(actor_layout),
        critic(critic_layout),
        actor_parameters(InitialParameters(actor_layout, 0.5, 0, 1, 0)),
        rollout(config.ppo, env.observation_size(), env.action_size(),
                actor_layout.shape().state_size(), PrivilegedSize(config.ppo, env)),
        state(config.ppo.num_aircraft, actor_layout.shape().state_size()) {
    actor.SetParameters(actor_parameters.data());
    critic.SetParameters(InitialParameters(critic_layout, 1, 0, 1, 1).data());
  }

  EpisodeStatistics Fly() {
    settings.seed = config.seed;
    settings.first_policy_step = policy_steps;
    policy_steps += config.ppo.rollout_steps;
    return CollectRollout(env, actor, critic, log_std, settings, pool, state, rollout);
  }

  TrainConfig config;
  WorkerPool pool;
  VecEnv env;
  NetworkLayout actor_layout, critic_layout;
  FusedNetwork actor, critic;
  std::vector<float> actor_parameters;
  Rollout rollout;
  RecurrentState state;
  std::vector<float> log_std = std::vector<float>(4, 0.0f);
  std::uint64_t policy_steps = 0;
  RolloutSettings settings;
};

/// The means of a chunk's actions, computed anew: [step][aircraft][action].
std::vector<float> MeansOf(const Flight& flight, int chunk) {
  const Rollout& rollout = flight.rollout;
  const int length = rollout.chunk_length;
  const std::int64_t row = rollout.row(chunk * length, 0);
  NetworkWorkspace workspace;
  flight.actor.Forward(
      {length, rollout.aircraft, rollout.observation.data() + row * rollout.observation_size,
       rollout.actor_state.data() + rollout.row(chunk, 0) * rollout.state_size,
       rollout.not_done.data() + row},
      workspace);
  std::vector<float> mean(static_cast<std::size_t>(length) * rollout.aircraft * 4);
  GaussianMean(static_cast<std::int64_t>(mean.size()), true, workspace.output(), mean.data());
  return mean;
}

TEST(RolloutTest, LogProbabilitiesRecomputedFromChunksAreTheRolloutsOwn) {
  Flight flight(SmallConfig());
  flight.Fly();
  flight.Fly();  // the second begins in the middle of episodes
  const Rollout& rollout = flight.rollout;
  ASSERT_GT(std::count(rollout.done.begin(), rollout.done.end(), 1), 0);
  const int samples = rollout.chunk_length * rollout.aircraft;
  std::vector<float> log_prob(samples);
  for (int chunk = 0; chunk < rollout.chunks(); ++chunk) {
    const std::int64_t row = rollout.row(chunk * rollout.chunk_length, 0);
    LogProbability(samples, 4, MeansOf(flight, chunk).data(), flight.log_std.data(),
                   rollout.action.data() + row * 4, log_prob.data());
    for (int i = 0; i < samples; ++i) {
      ASSERT_NEAR(log_prob[i], rollout.log_prob[row + i], kLogProb);
    }
  }
}

/// What has been added to the means of a rollout's actions, in standard deviations:
/// [step][aircraft][action].
std::vector<double> Deviations(const Flight& flight) {
  const std::vector<float>& action = flight.rollout.action;
  std::vector<double> deviations;
  for (int chunk = 0; chunk < flight.rollout.chunks(); ++chunk) {
    for (const float mean : MeansOf(flight, chunk)) {
      const std::size_t i = deviations.size();
      deviations.push_back((action[i] - mean) / std::exp(flight.log_std[i % 4]));
    }
  }
  return deviations;
}

TEST(RolloutTest, ActionsScatterByTheirDeviationsAnewInEveryStepOfEveryAircraft) {
  Flight flight(SmallConfig());
  flight.log_std = {-1, -0.5, 0, 0.25};
  std::vector<double> deviations;  // of two rollouts, one after the other
  for (int rollout = 0; rollout < 2; ++rollout) {
    flight.Fly();
    const std::vector<double> own = Deviations(flight);
    deviations.insert(deviations.end(), own.begin(), own.end());
  }
  const std::size_t step = flight.rollout.aircraft * 4;
  const std::size_t tile = flight.config.learner.rollout_tile * 4;
  ASSERT_EQ(deviations.size(), 2 * flight.rollout.steps * step);
  const double count = static_cast<double>(deviations.size()) / 4;
  for (std::size_t k = 0; k < 4; ++k) {
    double sum = 0, squares = 0;
    for (std::size_t i = k; i < deviations.size(); i += 4) {
      sum += deviations[i];
      squares += deviations[i] * deviations[i];
    }
    EXPECT_NEAR(sum / count, 0, kStandardErrors / std::sqrt(count)) << k;
    EXPECT_NEAR(squares / count, 1, kStandardErrors * std::sqrt(2 / count)) << k;
  }
  for (const std::size_t apart : {std::size_t{4}, tile, step, flight.rollout.steps * step}) {
    double sum = 0;
    for (std::size_t i = apart; i < deviations.size(); ++i) {
      sum += deviations[i] * deviations[i - apart];
    }
    const double products = static_cast<double>(deviations.size() - apart);
    EXPECT_NEAR(sum / products, 0, kStandardErrors / std::sqrt(products)) << apart;
  }
}

TEST(RolloutTest, FlightsThatAreNotFiniteAreAllCounted) {
  Flight flight(SmallConfig());  // whose first episodes are no others' statistics
  flight.log_std.assign(4, std::numeric_limits<float>::infinity());
  const EpisodeStatistics statistics = flight.Fly();
  EXPECT_EQ(statistics.non_finite, statistics.policy_steps);
}

TEST(RolloutTest, EpisodesBeginWhereOthersEnded) {
  Flight flight(SmallConfig());
  flight.Fly();
  const Rollout& rollout = flight.rollout;
  for (int step = 0; step + 1 < rollout.steps; ++step) {
    for (int i = 0; i < rollout.aircraft; ++i) {
      EXPECT_EQ(rollout.not_done[rollout.row(step + 1, i)],
                rollout.done[rollout.row(step, i)] ? 0 : 1);
    }
  }
  for (int i = 0; i < rollout.aircraft; ++i) EXPECT_EQ(rollout.not_done[i], 0);
}

/// What a flight by discounts and a value scale of its own gets from its environment and critic.
class ValuedRolloutTest : public testing::TestWithParam<bool> {
 protected:
  ValuedRolloutTest() : flight_(Config()) {
    flight_.settings.gamma = 0.9;
    flight_.settings.gae_lambda = 0.7;
    flight_.settings.value_scale = {-40, 8};
  }
  static TrainConfig Config() {
    TrainConfig config = SmallConfig();
    config.ppo.privileged_critic = config.env.truncate_at_time_limit = GetParam();
    return config;
  }

  Flight flight_;
};

TEST_P(ValuedRolloutTest, ItsAdvantagesAreThoseOfItsRewardsAndValues) {
  flight_.Fly();
  flight_.Fly();
  const Rollout& rollout = flight_.rollout;
  const RolloutSettings& settings = flight_.settings;
  for (int step = 0; step < rollout.steps; ++step) {
    for (int i = 0; i < rollout.aircraft; ++i) {
      const double expected =
          AdvantageByDefinition(rollout, step, i, settings.gamma, settings.gae_lambda);
      EXPECT_NEAR(rollout.advantage[rollout.row(step, i)], expected,
                  kAdvantage * std::max(1.0, std::abs(expected)));
    }
  }
}

TEST_P(ValuedRolloutTest, BootstrapsByTheValuesThatTheNextOneBeginsWith) {
  flight_.Fly();
  const std::vector<float> bootstrap = flight_.rollout.bootstrap;
  flight_.Fly();
  const Rollout& next = flight_.rollout;
  EXPECT_GT(std::count(next.not_done.begin(), next.not_done.begin() + next.aircraft, 1.0f), 0);
  EXPECT_TRUE(std::equal(bootstrap.begin(), bootstrap.end(), next.value.begin()));
}

TEST_P(ValuedRolloutTest, ValuesAreInTheScaleOfRewards) {
  Flight plain(Config());
  plain.Fly();
  flight_.Fly();
  EXPECT_EQ(flight_.rollout.action, plain.rollout.action);
  const auto scaled = [](float value) { return static_cast<float>(-40 + 8.0 * value); };
  for (const auto column : {&Rollout::value, &Rollout::bootstrap}) {
    const std::vector<float>& values = flight_.rollout.*column;
    EXPECT_TRUE(std::equal(values.begin(), values.end(), (plain.rollout.*column).begin(),
                           [&](float value, float raw) { return value == scaled(raw); }));
  }
}

INSTANTIATE_TEST_SUITE_P(Critics, ValuedRolloutTest, testing::Bool(), [](const auto& privileged) {
  return privileged.param ? "PrivilegedAndTruncated" : "LikeTheActor";
});

TrainConfig PrivilegedConfig() {
  TrainConfig config = SmallConfig();
  config.ppo.privileged_critic = true;
  config.env.observation_noise = 0.1;
  return config;
}

TEST(RolloutTest, APrivilegedCriticSeesMoreAndTheActorFliesTheSame) {
  TrainConfig plain_config = PrivilegedConfig();
  plain_config.ppo.privileged_critic = false;
  Flight plain(plain_config), privileged(PrivilegedConfig());
  const VecEnv fresh(plain.config.env, plain.config.ppo.num_aircraft, plain.config.seed);
  std::vector<float> first(
      static_cast<std::size_t>(fresh.num_aircraft() * fresh.privileged_size()));
  fresh.ObservePrivileged(0, first.data());
  plain.Fly();
  privileged.Fly();
  EXPECT_EQ(plain.rollout.observation, privileged.rollout.observation);
  EXPECT_EQ(plain.rollout.action, privileged.rollout.action);
  EXPECT_NE(plain.rollout.value, privileged.rollout.value);
  EXPECT_EQ(&plain.rollout.critic_observation(), &plain.rollout.observation);
  const Rollout& rollout = privileged.rollout;
  ASSERT_EQ(rollout.critic_observation_size(), 22 + fresh.privileged_size());
  const auto joined = rollout.critic_observation().begin();
  for (std::int64_t row = 0; row < rollout.samples(); ++row) {
    EXPECT_TRUE(std::equal(joined + row * rollout.critic_observation_size(),
                           joined + row * rollout.critic_observation_size() + 22,
                           rollout.observation.begin() + row * 22));
  }
  for (int i = 0; i < rollout.aircraft; ++i) {
    EXPECT_TRUE(std::equal(first.begin() + i * rollout.privileged_size,
                           first.begin() + (i + 1) * rollout.privileged_size,
                           joined + i * rollout.critic_observation_size() + 22));
  }
}

TEST(RolloutTest, APrivilegedCriticValuesWhatItSees) {
  Flight flight(PrivilegedConfig());
  flight.Fly();
  flight.Fly();
  const Rollout& rollout = flight.rollout;
  NetworkWorkspace workspace;
  for (int chunk = 0; chunk < rollout.chunks(); ++chunk) {
    const std::int64_t row = rollout.row(chunk * rollout.chunk_length, 0);
    flight.critic.Forward(
        {rollout.chunk_length, rollout.aircraft,
         rollout.critic_observation().data() + row * rollout.critic_observation_size(),
         rollout.critic_state.data() + rollout.row(chunk, 0) * rollout.state_size,
         rollout.not_done.data() + row},
        workspace);
    for (int i = 0; i < rollout.chunk_length * rollout.aircraft; ++i) {
      ASSERT_NEAR(workspace.output()[i], rollout.value[row + i], kLogProb);
    }
  }
}

TEST(RolloutTest, TheEndOfAMissionIsNoFailureWhateverThatOfTheTimeLimitIs) {
  TrainConfig terminal = SmallConfig();
  terminal.env.mission.length_s = 2;
  terminal.env.time_limit_steps = 1000;  // no target is missed, which would be a failure
  TrainConfig truncated = terminal;
  truncated.env.truncate_at_time_limit = true;
  Flight one(terminal), other(truncated);
  one.Fly();
  other.Fly();
  EXPECT_GT(std::count(one.rollout.done.begin(), one.rollout.done.end(), 1), 0);
  EXPECT_EQ(one.rollout.reward, other.rollout.reward);
}

/// What the critic would have been shown at the end of every policy step that ended an episode,
/// [step][aircraft][critic_observation_size]: the first rollout's actions flown once more.
std::vector<float> LastObservations(const Flight& flight) {
  const Rollout& rollout = flight.rollout;
  VecEnv env(flight.config.env, flight.config.ppo.num_aircraft, flight.config.seed,
             flight.config.learner.rollout_tile);
  const int own = rollout.observation_size, privileged = rollout.privileged_size;
  const std::int64_t size = rollout.critic_observation_size();
  std::vector<float> last(rollout.steps * rollout.aircraft * size);
  for (int step = 0; step < rollout.steps; ++step) {
    for (int tile = 0; tile < env.num_tiles(); ++tile) {
      const int count = env.tile_count(tile);
      const std::int64_t row = rollout.row(step, env.tile_begin(tile));
      StepMemory memory(count, {own, privileged});
      env.Step(tile, rollout.action.data() + row * rollout.action_size, memory.output());
      for (int i = 0; i < count; ++i) {
        float* const place = last.data() + (row + i) * size;
        std::copy_n(memory.final_observation.begin() + i * own, own, place);
        std::copy_n(memory.final_privileged.begin() + i * privileged, privileged, place + own);
      }
    }
  }
  return last;
}

/// The critic's values of `last` after each policy step, [step][aircraft]: of the episode that the
/// rollout's rows before it are of, as if it had gone on.
std::vector<float> ValuesAfter(const Flight& flight, const std::vector<float>& last) {
  const Rollout& rollout = flight.rollout;
  const std::int64_t size = rollout.critic_observation_size(), aircraft = rollout.aircraft;
  NetworkWorkspace workspace;
  std::vector<float> values;
  for (int step = 0; step < rollout.steps; ++step) {
    const int chunk = step / rollout.chunk_length, steps = step % rollout.chunk_length + 1;
    const std::int64_t first = rollout.row(chunk * rollout.chunk_length, 0);
    const auto begin = rollout.critic_observation().begin() + first * size;
    std::vector<float> observation(begin, begin + steps * aircraft * size);
    observation.insert(observation.end(), last.begin() + step * aircraft * size,
                       last.begin() + (step + 1) * aircraft * size);
    const auto resets = rollout.not_done.begin() + first;
    std::vector<float> not_done(resets, resets + steps * aircraft);
    not_done.resize((steps + 1) * aircraft, 1.0f);
    flight.critic.Forward(
        {steps + 1, rollout.aircraft, observation.data(),
         rollout.critic_state.data() + rollout.row(chunk, 0) * rollout.state_size, not_done.data()},
        workspace);
    values.insert(values.end(), workspace.output() + steps * aircraft,
                  workspace.output() + (steps + 1) * aircraft);
  }
  return values;
}

class TruncationTest : public testing::TestWithParam<bool> {};

TEST_P(TruncationTest, AddsTheValueOfWhatWasSeenLast) {
  TrainConfig terminal = SmallConfig();
  terminal.ppo.privileged_critic = GetParam();
  TrainConfig truncated = terminal;
  truncated.env.truncate_at_time_limit = true;
  Flight one(terminal), other(truncated);
  one.Fly();
  other.Fly();
  const std::vector<float> values = ValuesAfter(other, LastObservations(other));
  const double failure = terminal.env.termination.failure_reward;
  int cut = 0, alike = 0;
  for (std::int64_t row = 0; row < one.rollout.steps * one.rollout.aircraft; ++row) {
    const float reward = one.rollout.reward[row];
    if (!one.rollout.done[row]) {
      EXPECT_EQ(reward, other.rollout.reward[row]);
      ++alike;
      continue;
    }
    EXPECT_TRUE(other.rollout.done[row]);
    EXPECT_NEAR(other.rollout.reward[row], reward - failure + other.settings.gamma * values[row],
                kTruncated);
    ++cut;
  }
  EXPECT_GT(cut, 0);
  EXPECT_GT(alike, 0);
}

INSTANTIATE_TEST_SUITE_P(Critics, TruncationTest, testing::Bool(), [](const auto& privileged) {
  return privileged.param ? "Privileged" : "LikeTheActor";
});

}  // namespace
}  // namespace skein
