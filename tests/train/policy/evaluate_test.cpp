// SPDX-License-Identifier: Apache-2.0
#include "train/policy/evaluate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/envs/step_buffers.h"
#include "tests/train/small_config.h"

namespace skein {
namespace {

RecurrentPolicy SmallPolicy() {
  return RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3);
}

TEST(EvaluateTest, CountsOneEpisodePerAircraftWhateverTheThreads) {
  const TrainConfig config = SmallConfig();
  EvaluationOptions options;
  options.episodes = 150;
  for (const Agent& agent : {Agent::MeanOf(SmallPolicy()), Agent::SamplingFrom(SmallPolicy()),
                             Agent::Random(5), Agent::Zero()}) {
    WorkerPool one(1), three(3);
    const EvaluationResult a = Evaluate(agent, config.env, options, one);
    const EvaluationResult b = Evaluate(agent, config.env, options, three);
    int total = 0;
    for (const int count : a.terminations) total += count;
    EXPECT_EQ(total, 150);
    EXPECT_EQ(a.terminations[0], 0);
    EXPECT_EQ(a.terminations, b.terminations);
    EXPECT_EQ(a.return_mean, b.return_mean);
    // No target counts before step 100, where these episodes end, and none is met there.
    EXPECT_EQ(a.success_rate, 0);
    EXPECT_TRUE(std::isnan(a.time_to_target_mean_s));
  }
}

TEST(EvaluateTest, TimeToTargetIsTheClockOfTheEpisodesThatReachIt) {
  EnvConfig env;
  env.action_repeat = 5;
  // Targets that every state within the limits has reached: success is a matter of the clock.
  env.heading.altitude_tolerance_ft = 1e6;
  env.heading.yaw_tolerance_deg = 180;
  env.heading.speed_tolerance_fps = 1e6;
  env.heading.earliest_success_step = 100;
  EvaluationOptions options;
  options.episodes = 40;
  WorkerPool pool(1);
  const EvaluationResult result = Evaluate(Agent::MeanOf(SmallPolicy()), env, options, pool);
  EXPECT_EQ(result.success_rate, 1);
  EXPECT_EQ(result.terminations[static_cast<int>(Termination::kTargetReached)], 40);
  EXPECT_DOUBLE_EQ(result.time_to_target_mean_s, 100 * env.control_interval_s);
}

TEST(EvaluateTest, AllAgentsFlyTheSameEpisodes) {
  // At other rates and with random actions, too: what an episode begins with is a function of
  // the seed and its number.
  WorkerPool pool(2);
  EvaluationOptions options;
  options.episodes = 150;
  options.seed = 8;
  const auto starts = [&](const Agent& agent) {
    return FlyEpisodes(agent, agent.EnvironmentFor(SmallConfig().env), options, pool).starts;
  };
  const std::uint64_t first = starts(Agent::MeanOf(SmallPolicy()));
  EXPECT_EQ(starts(Agent::SamplingFrom(SmallPolicy())), first);
  EXPECT_EQ(starts(Agent::Random(25)), first);
  EXPECT_EQ(starts(Agent::Zero()), first);
  options.target = {15000.0f};
  EXPECT_NE(starts(Agent::Zero()), first) << "to another altitude";
  options.target = {};
  options.seed = 9;
  EXPECT_NE(starts(Agent::Zero()), first);
}

TEST(EvaluateTest, NoiseIsThatOfTheEpisodeWhateverTheRate) {
  // Two agents that do the same, one of them deciding in every control step and one in every fifth.
  EnvConfig env = SmallConfig().env;
  EvaluationOptions options;
  options.episodes = 3;
  env.action_repeat = 1;
  VecEnv fast = MakeEvaluationEnv(Agent::Zero(), env, options);
  env.action_repeat = 5;
  VecEnv slow = MakeEvaluationEnv(Agent::Zero(), env, options);
  StepBuffers a(options.episodes), b(options.episodes);
  for (int policy_step = 0; policy_step < 4; ++policy_step) {
    fast.Observe(0, a.observation.data());
    slow.Observe(0, b.observation.data());
    EXPECT_EQ(a.observation, b.observation) << "policy step " << policy_step;
    for (int step = 0; step < 5; ++step) fast.Step(0, a.action.data(), a.output());
    slow.Step(0, b.action.data(), b.output());
  }
}

TEST(EvaluateTest, MeasuresFlightsOnlyIfAsked) {
  WorkerPool pool(2);
  EvaluationOptions options;
  options.episodes = 40;
  const auto fly = [&](int threads) {
    WorkerPool workers(threads);
    return FlyEpisodes(Agent::Random(5), SmallConfig().env, options, workers).episodes;
  };
  for (const Episode& episode : fly(1)) EXPECT_TRUE(std::isnan(episode.metrics[kMeanMach]));
  options.flight_metrics = true;
  const std::vector<Episode> one = fly(1), three = fly(3);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_GT(one[i].metrics[kMeanMach], 0.5f);
    EXPECT_EQ(one[i].metrics, three[i].metrics);
  }
}

TEST(EvaluateTest, SummaryCountsByHand) {
  Episode reached, lost;
  reached.termination = Termination::kTargetReached;
  reached.succeeded = true;
  reached.steps = reached.reached_step = 550;
  reached.entered_step = 400;  // held for 3 s
  reached.episode_return = 190;
  reached.measures.hold.within = 0.75f;
  lost.termination = Termination::kLowAltitude;
  lost.steps = 900;
  lost.episode_return = -350;
  const EvaluationResult result = Summarise({reached, lost, lost, lost}, 0.02);
  EXPECT_EQ(result.episodes, 4);
  EXPECT_EQ(result.success_rate, 0.25);
  EXPECT_EQ(result.return_mean, -215);
  EXPECT_DOUBLE_EQ(result.time_to_target_mean_s, 8);
  EXPECT_EQ(result.hold_within_mean, 0.75);  // of the one that has a hold
  EXPECT_TRUE(std::isnan(Summarise({lost}, 0.02).hold_within_mean));
  EXPECT_EQ(result.terminations[static_cast<int>(Termination::kLowAltitude)], 3);
}

TEST(EvaluateTest, RefusesAnAgentOfAnotherTask) {
  WorkerPool pool(1);
  const RecurrentPolicy policy = RecurrentPolicy::Untrained(SmallConfig().network, 20, 4, 3);
  EXPECT_THROW(Evaluate(Agent::MeanOf(policy), SmallConfig().env, {}, pool), Error);
}

}  // namespace
}  // namespace skein
