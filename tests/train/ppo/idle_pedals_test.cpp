// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/idle_pedals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "envs/actions.h"
#include "tests/scratch_directory.h"
#include "tests/tolerance.h"
#include "tests/train/hierarchy_config.h"
#include "tests/train/libtorch.h"
#include "tests/train/network/gradient_comparison.h"
#include "tests/train/small_config.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

constexpr int kYaw = kActionSize - 1;
constexpr Tolerance kFloat32{1e-6, "float32 of the entropy"};

class IdlePedalsTest : public testing::Test {
 protected:
  static NetworkLayout Layout() {
    NetworkConfig config;
    config.hidden_size = 12;
    config.gru_size = 8;
    return NetworkLayout(ActorShape(config, 22, kActionSize));
  }
  /// Whether the parameter at `offset` is of the yaw action alone, by the layout's names.
  bool IsOfYaw(std::int64_t offset) const {
    for (const ParameterSlice& slice : layout_.slices()) {
      const auto& shape = slice.shape;
      const std::int64_t row = shape.size() == 2 ? shape[1] : 1;
      const std::int64_t begin = slice.offset + kYaw * row;
      const bool is_head = slice.offset == layout_.layer(layout_.head()).weight ||
                           slice.offset == layout_.layer(layout_.head()).bias ||
                           slice.name == "log_std";
      if (is_head && offset >= begin && offset < begin + row) return true;
    }
    return false;
  }

  NetworkLayout layout_ = Layout();
  IdlePedals pedals_{layout_};
  std::vector<float> values_ = std::vector<float>(static_cast<std::size_t>(layout_.size()), 0.5f);
};

TEST_F(IdlePedalsTest, DropsTheGradientOfTheYawActionAloneAndOfNothingElse) {
  pedals_.DropGradient(values_.data());
  int dropped = 0;
  for (std::int64_t i = 0; i < layout_.size(); ++i) {
    EXPECT_EQ(values_[static_cast<std::size_t>(i)], IsOfYaw(i) ? 0 : 0.5f) << "parameter " << i;
    dropped += IsOfYaw(i);
  }
  EXPECT_EQ(dropped, 12 + 1 + 1) << "a row of the head, its bias, its deviation";
}

TEST_F(IdlePedalsTest, IdlesWhatItDropsTheGradientOfAndFreesItAgain) {
  EXPECT_FALSE(pedals_.AreIdle(values_.data()));
  pedals_.Idle(values_.data());
  EXPECT_TRUE(pedals_.AreIdle(values_.data()));
  const auto log_std = static_cast<std::size_t>(layout_.log_std() + kYaw);
  EXPECT_LT(std::exp(values_[log_std]), 1e-4f);
  for (std::int64_t i = 0; i < layout_.size(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (index == log_std) continue;
    EXPECT_EQ(values_[index], IsOfYaw(i) ? 0 : 0.5f) << "parameter " << i;
  }
  pedals_.Free(-0.5f, values_.data());
  EXPECT_FALSE(pedals_.AreIdle(values_.data()));
  EXPECT_EQ(values_[log_std], -0.5f);
}

TEST_F(IdlePedalsTest, AddTheEntropyOfTheirDeviation) {
  EXPECT_NEAR(IdlePedals::Entropy(), -10 + 0.5 * std::log(2 * M_PI * std::exp(1)), kFloat32);
}

/// What a policy makes of one observation.
struct Answer {
  std::vector<float> action, log_std;
};
Answer AnswerOf(const RecurrentPolicy& policy) {
  const std::vector<float> observation(policy.observation_size(), 0.3f);
  std::vector<float> state(policy.state_size());
  Answer answer{std::vector<float>(kActionSize), std::vector<float>(kActionSize)};
  policy.ActionMean(1, observation.data(), state.data(), answer.action.data(),
                    answer.log_std.data());
  return answer;
}

/// That training without pedals, and with what policy it keeps.
TrainConfig Without(TrainConfig config) {
  config.ppo.pedals = false;
  config.ppo.average_iterations = 2;
  return config;
}

class PedalsInTraining : public testing::Test {
 protected:
  /// Holds the pedals of such a training idle, begun anew or from a policy that has them.
  void ExpectIdleWhateverTheyBeganAs(const TrainConfig& config) const {
    WorkerPool pool(2);
    Trainer with_pedals(config, pool);
    with_pedals.Iterate();
    with_pedals.Save(path_);
    Trainer fresh(Without(config), pool), from(Without(config), pool);
    from.StartFrom(path_);
    for (Trainer* const trainer : {&fresh, &from}) ExpectToLearnAllButPedals(*trainer);
  }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "checkpoint.skein";

 private:
  void ExpectToLearnAllButPedals(Trainer& trainer) const {
    const Answer before = AnswerOf(trainer.policy());
    trainer.Iterate();
    trainer.Save(path_);
    const Answer after = AnswerOf(RecurrentPolicy::Load(path_));
    EXPECT_EQ(before.action[kYaw], 0);
    EXPECT_EQ(after.action[kYaw], 0);
    EXPECT_LT(std::exp(after.log_std[kYaw]), 1e-4f) << "exploration leaves them alone, too";
    for (int k = 0; k < kYaw; ++k) {
      EXPECT_NE(after.action[k], before.action[k]) << "the others learn";
      EXPECT_GT(std::exp(after.log_std[k]), 0.5f);
    }
  }
};

class PedalsByPrecision : public PedalsInTraining,
                          public testing::WithParamInterface<LearnerPrecision> {};

TEST_P(PedalsByPrecision, AreIdleWhateverTheyBeganAs) {
  TrainConfig config = SmallConfig();
  config.learner.precision = GetParam();
  ExpectIdleWhateverTheyBeganAs(config);
}

TEST_F(PedalsInTraining, AreIdleByLibTorchToo) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  TrainConfig config = SmallConfig();
  config.learner.backend = Backend::kLibTorch;
  ExpectIdleWhateverTheyBeganAs(config);
}

TEST_F(PedalsInTraining, AreLearnedAgainWhereTheyWereIdle) {
  WorkerPool pool(1);
  Trainer without(Without(SmallConfig()), pool);
  without.Iterate();
  without.Save(path_);
  Trainer with_pedals(SmallConfig(), pool);
  with_pedals.StartFrom(path_);
  EXPECT_EQ(AnswerOf(with_pedals.policy()).log_std[kYaw], SmallConfig().network.initial_log_std);
  EXPECT_LT(with_pedals.Iterate().approximate_kl, 0.1) << "ratios stay near one";
  EXPECT_NE(AnswerOf(with_pedals.policy()).action[kYaw], 0);
}

TEST_F(PedalsInTraining, AreIdleAfterResumingToo) {
  WorkerPool pool(1);
  Trainer whole(Without(SmallConfig()), pool);
  whole.Iterate();
  whole.Save(path_);
  Trainer resumed(Without(SmallConfig()), pool);
  resumed.Restore(path_);
  whole.Iterate();
  resumed.Iterate();
  EXPECT_EQ(resumed.Signature(), whole.Signature());
  EXPECT_EQ(AnswerOf(resumed.policy()).action[kYaw], 0);
}

INSTANTIATE_TEST_SUITE_P(Precisions, PedalsByPrecision, testing::ValuesIn(kRunnablePrecisions),
                         [](const auto& precision) { return Name(precision.param); });

TEST(IdlePedals, AreNoneOfAHighLevelPolicy) {
  TrainConfig config = Without(SmallConfig());
  config.env.task = "tracking";
  config.env.tracking.acts_directly = false;
  EXPECT_THROW(ValidateLearning(config), Error);
  config.env.tracking.acts_directly = true;
  ValidateLearning(config);
  config.low_level = SmallLowLevelPolicy();
  EXPECT_THROW(ValidateLearning(config), Error);
}

}  // namespace
}  // namespace skein
