// SPDX-License-Identifier: Apache-2.0
// What ranks share an evaluation out by: a part of its episodes are those of the whole.
#include <gtest/gtest.h>

#include "tests/train/hierarchy_config.h"
#include "train/policy/evaluate.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

void ExpectPartsAreTheWhole(const Agent& agent, const EnvConfig& env) {
  WorkerPool pool(1);
  EvaluationOptions options;
  options.episodes = 150;
  options.seed = 4;
  const std::vector<Episode> whole = FlyEpisodes(agent, env, options, pool).episodes;
  for (const int first : {0, 1, 140}) {
    options.first_episode = first;
    options.episodes = 10;
    const std::vector<Episode> part = FlyEpisodes(agent, env, options, pool).episodes;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Episode& expected = whole[static_cast<std::size_t>(first) + i];
      EXPECT_EQ(part[i].episode_return, expected.episode_return) << first << " + " << i;
      EXPECT_EQ(part[i].steps, expected.steps);
      EXPECT_EQ(part[i].termination, expected.termination);
    }
  }
}

TEST(EpisodeSharesTest, APartOfAnEvaluationFliesTheSameEpisodes) {
  TrainConfig config = SmallConfig();
  config.env.observation_noise = 0.1;
  config.env.wind.speed_fps = {0, 80};
  config.env.wind.turbulence_fps = {0, 5};
  const RecurrentPolicy policy = RecurrentPolicy::Untrained(config.network, 22, 4, 3, 5);
  ExpectPartsAreTheWhole(Agent::SamplingFrom(policy), config.env);
  ExpectPartsAreTheWhole(Agent::MeanOf(policy), config.env);
}

TEST(EpisodeSharesTest, SoDoesAHighLevelPolicy) {
  const TrainConfig config = SmallHighLevelConfig();
  WorkerPool pool(1);
  const RecurrentPolicy policy = Trainer(config, pool).policy();
  ExpectPartsAreTheWhole(Agent::SamplingFrom(policy), config.env);
}

}  // namespace
}  // namespace skein
