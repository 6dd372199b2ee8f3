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

bool AreEqual(const std::vector<Episode>& a, const std::vector<Episode>& b) {
  const auto is_same = [](const Episode& one, const Episode& other) {
    return one.termination == other.termination && one.episode_return == other.episode_return &&
           one.steps == other.steps && one.succeeded == other.succeeded &&
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
