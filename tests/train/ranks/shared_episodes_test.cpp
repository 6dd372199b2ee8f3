// SPDX-License-Identifier: Apache-2.0
// An evaluation on several ranks is the evaluation on one, to the last bit of every episode.
#include "train/ranks/shared_episodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/error_message.h"
#include "tests/train/ranks/thread_ranks.h"
#include "tests/train/small_config.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

class SharedEpisodesTest : public testing::TestWithParam<int> {
 protected:
  static EnvConfig NoisyEnv() {
    EnvConfig env = SmallConfig().env;
    env.observation_noise = 0.1;
    env.wind.speed_fps = {0, 80};
    env.wind.turbulence_fps = {0, 5};
    return env;
  }
};

bool AreSame(const FlightMeasures& a, const FlightMeasures& b) {
  // All of them are 32 bits wide, so there is no padding; NaN equals NaN.
  static_assert(sizeof(FlightMeasures) % sizeof(float) == 0);
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool AreEqual(const std::vector<Episode>& a, const std::vector<Episode>& b) {
  const auto is_same = [](const Episode& one, const Episode& other) {
    return one.termination == other.termination && one.episode_return == other.episode_return &&
           one.steps == other.steps && one.succeeded == other.succeeded &&
           one.reached_step == other.reached_step && one.entered_step == other.entered_step &&
           AreSame(one.measures, other.measures) &&
           std::memcmp(&one.metrics, &other.metrics, sizeof one.metrics) == 0;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), is_same);
}

TEST_P(SharedEpisodesTest, AreThoseOfOneProcessOnEveryRank) {
  EvaluationOptions options;
  options.seed = 4;
  options.flight_metrics = true;
  for (const int episodes : {3, 150}) {  // fewer than ranks, too
    options.episodes = episodes;
    WorkerPool pool(1);
    for (const Agent& agent : {Agent::Random(5), Agent::Zero()}) {
      const FlownEpisodes whole = FlyEpisodes(agent, NoisyEnv(), options, pool);
      RunOnRanks(GetParam(), [&](Ranks& ranks) {
        WorkerPool own(1);
        const FlownEpisodes shared = FlyEpisodesOnRanks(agent, NoisyEnv(), options, own, ranks);
        EXPECT_TRUE(AreEqual(shared.episodes, whole.episodes)) << ranks.Describe(ranks.rank());
        EXPECT_EQ(shared.starts, whole.starts);
        EXPECT_FALSE(shared.stopped);
      });
    }
  }
}

TEST_P(SharedEpisodesTest, SoAreThoseThatReachAndHoldTheirTargets) {
  EnvConfig env = NoisyEnv();
  env.hold_s = 1;
  env.heading.dwell_s = 0.2;
  env.heading.earliest_success_step = 10;
  env.heading.altitude_tolerance_ft = 3000;
  env.heading.yaw_tolerance_deg = 120;
  env.heading.speed_tolerance_fps = 300;
  EvaluationOptions options;
  options.seed = 4;
  options.episodes = 150;
  options.flight_metrics = true;
  WorkerPool pool(1);
  const FlownEpisodes whole = FlyEpisodes(Agent::Zero(), env, options, pool);
  const auto reached =
      std::count_if(whole.episodes.begin(), whole.episodes.end(), [](const Episode& episode) {
        return episode.reached_step > 0 && episode.entered_step > 0 &&
               episode.measures.hold.within > 0 && episode.measures.reached_step > 0;
      });
  EXPECT_GT(reached, options.episodes / 4);
  EXPECT_LT(reached, options.episodes);
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool own(1);
    const FlownEpisodes shared = FlyEpisodesOnRanks(Agent::Zero(), env, options, own, ranks);
    EXPECT_TRUE(AreEqual(shared.episodes, whole.episodes)) << ranks.Describe(ranks.rank());
  });
}

TEST_P(SharedEpisodesTest, AStopOnOneRankStopsAll) {
  EvaluationOptions options;
  options.episodes = 40;
  RunOnRanks(GetParam(), [&](Ranks& ranks) {
    WorkerPool own(1);
    if (ranks.rank() == ranks.count() - 1) own.RequestStop();
    EXPECT_TRUE(FlyEpisodesOnRanks(Agent::Zero(), NoisyEnv(), options, own, ranks).stopped);
    EXPECT_TRUE(own.stopping());
  });
}

INSTANTIATE_TEST_SUITE_P(Ranks, SharedEpisodesTest, testing::Values(1, 2, 4, 8),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace skein
