// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "tests/scratch_directory.h"
#include "tests/train/small_config.h"
#include "train/files/tensor_access.h"
#include "train/files/tensor_file.h"
#include "train/policy/policy_parameters.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

class CriticLeadTest : public testing::Test {
 protected:
  CriticLeadTest() {
    config_.ppo.critic_lead = 0.75;
    config_.ppo.popart = false;  // what rescales the critic's head without a step
  }

  static std::vector<float> Actor(const Trainer& trainer) {
    return trainer.policy().parameters()->values;
  }
  std::vector<float> Critic(const Trainer& trainer) const {
    trainer.Save(path_);
    return LoadTensor<float>(TensorFile::Read(path_), path_, "critic/parameters");
  }

  TrainConfig config_ = SmallConfig();  // of four iterations
  WorkerPool pool_{2};
  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "checkpoint.skein";
};

TEST_F(CriticLeadTest, TheCriticLearnsAloneOverItsShareOfTheBudget) {
  Trainer trainer(config_, pool_);
  std::vector<float> actor = Actor(trainer), critic = Critic(trainer);
  for (const bool leads : {true, true, false, false}) {
    trainer.Iterate();
    const std::vector<float> next_actor = Actor(trainer), next_critic = Critic(trainer);
    EXPECT_EQ(next_actor == actor, leads) << trainer.env_steps();
    EXPECT_NE(next_critic, critic) << trainer.env_steps();
    actor = next_actor;
    critic = next_critic;
  }
}

TEST_F(CriticLeadTest, ResumesBitExactly) {
  Trainer whole(config_, pool_);
  whole.Iterate();
  whole.Save(path_);
  Trainer resumed(config_, pool_);
  resumed.Restore(path_);
  while (!whole.finished()) {
    whole.Iterate();
    resumed.Iterate();
    EXPECT_EQ(resumed.Signature(), whole.Signature());
  }
}

}  // namespace
}  // namespace skein
