// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/ppo_config.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "base/field_list.h"
#include "tests/train/small_config.h"
#include "train/policy/policy_parameters.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

/// Another value of every setting.
const std::map<std::string, std::string> kOthers{
    {"num_aircraft", "80"},
    {"rollout_steps", "8"},
    {"chunk_length", "4"},
    {"epochs", "3"},
    {"minibatches", "4"},
    {"learning_rate", "2e-3"},
    {"final_learning_rate_fraction", "0.5"},
    {"learning_rate_decay", "exponential"},
    {"target_kl", "1e-9"},
    {"critic_learning_rate", "2e-3"},
    {"adam_epsilon", "1e-3"},
    {"log_std_rate_factor", "2"},
    {"average_iterations", "2"},
    {"gamma", "0.9"},
    {"gae_lambda", "0.8"},
    {"clip", "0.01"},
    {"max_gradient_norm", "0.01"},
    {"entropy_coefficient", "0.1"},
    {"action_smoothness_coefficient", "1"},
    {"handling_ramp", "0.7"},
    {"condition_ramp", "0.7"},
    {"time_limit_ramp", "0.7"},
    {"held_noise_share", "0.2"},
    {"held_noise_steps", "3"},
    {"held_noise_actions", "2"},
    {"pedals", "false"},
    {"value_coefficient", "3"},
    {"clip_value_loss", "true"},
    {"privileged_critic", "true"},
    {"normalise_advantages", "false"},
    {"popart", "false"},
    {"popart_rate", "0.5"},
};

/// A training in which every setting has something to act on.
TrainConfig Training() {
  TrainConfig config = SmallConfig();
  config.env.reward.roll_rate = 1;
  config.env.mission.training_length_s = 4;
  config.env.mission.training_time_limit_s = 0.4;
  config.ppo.held_noise_share = 0.5;
  config.ppo.clip = 0.05;  // so that values leave it, too
  config.evaluation.interval_iterations = 0;
  return config;
}

/// The actor after three iterations: what changes the critic alone shows in its third.
std::vector<float> ActorOf(const TrainConfig& config) {
  WorkerPool pool(2);
  Trainer trainer(config, pool);
  for (int i = 0; i < 3; ++i) trainer.Iterate();
  return trainer.policy().parameters()->values;
}

TEST(PpoConfigTest, TheTrainerHeedsEverySetting) {
  TrainConfig config = Training();
  const std::vector<float> expected = ActorOf(config);
  EXPECT_EQ(ActorOf(config), expected);
  for (const Field& field : FieldsOf(config.ppo)) {
    const auto other = kOthers.find(field.key);
    ASSERT_NE(other, kOthers.end()) << "another value of ppo." << field.key << " is missing here";
    const PpoConfig before = config.ppo;
    field.SetText(other->second);
    EXPECT_FALSE(ActorOf(config) == expected) << "ppo." << field.key << " = " << other->second;
    config.ppo = before;
  }
  EXPECT_EQ(FieldsOf(config.ppo).size(), kOthers.size());
}

}  // namespace
}  // namespace skein
