// SPDX-License-Identifier: Apache-2.0
// A training on several ranks is the training of one, bit for bit. Ranks are threads here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "base/reason_of.h"
#include "tests/error_message.h"
#include "tests/file_bytes.h"
#include "tests/scratch_directory.h"
#include "tests/train/hierarchy_config.h"
#include "tests/train/ranks/thread_ranks.h"
#include "tests/train/small_config.h"
#include "train/files/tensor_access.h"
#include "train/ppo/ppo_update.h"
#include "train/ppo/trainer.h"
#include "train/ppo/training_state.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

constexpr int kShards = 16;

TrainConfig Sharded(TrainConfig config) {
  config.learner.shards = kShards;
  return config;
}

/// What a training leaves behind.
struct Outcome {
  std::uint64_t signature = 0;
  std::vector<std::string> metrics;
  std::string checkpoint;
};

/// The report's numbers, but for seconds, to the last bit.
std::string TextOf(const IterationReport& report) {
  std::string text = std::to_string(report.env_steps) + " " + std::to_string(report.episodes);
  for (const int ended : report.terminations) text += " " + std::to_string(ended);
  for (const double number :
       {report.return_mean, report.success_rate, report.policy_loss, report.value_loss,
        report.entropy, report.approximate_kl, report.clip_fraction, report.action_change,
        report.actor_gradient_norm, report.critic_gradient_norm, report.explained_variance,
        report.learning_rate, report.log_std_mean, report.evaluation_success_rate}) {
    text += " " + ExactText(number);
  }
  return text + (report.best ? " best" : "");
}

class TrainerRanksTest : public testing::Test {
 protected:
  /// Trains on so many ranks to the end, or for `iterations`, from the checkpoint `from` if there
  /// is one, and leaves a checkpoint in `to`. Rank 0 has `threads`, others one.
  static Outcome Train(const TrainConfig& config, int count, const std::string& from,
                       const std::string& to, int iterations = std::numeric_limits<int>::max(),
                       int threads = 1) {
    Outcome outcome;
    RunOnRanks(count, [&](Ranks& ranks) {
      WorkerPool pool(ranks.rank() == 0 ? threads : 1);
      Trainer trainer(config, pool, ranks);
      if (!from.empty()) trainer.Restore(from);
      std::vector<std::string> metrics;
      for (int i = 0; i < iterations && !trainer.finished(); ++i) {
        metrics.push_back(TextOf(trainer.Iterate()));
      }
      trainer.Save(to);
      const std::uint64_t signature = trainer.Signature();
      if (ranks.rank() == 0) outcome = {signature, metrics, BytesOf(to)};
    });
    return outcome;
  }

  void ExpectSameForAnyRanks(const TrainConfig& config, const std::vector<int>& counts) {
    const Outcome expected = Train(config, 1, "", scratch_ / "one");
    EXPECT_FALSE(expected.checkpoint.empty());
    for (const int count : counts) {
      const Outcome outcome = Train(config, count, "", scratch_ / "several");
      EXPECT_EQ(outcome.signature, expected.signature) << count << " ranks";
      EXPECT_EQ(outcome.metrics, expected.metrics) << count << " ranks";
      EXPECT_TRUE(outcome.checkpoint == expected.checkpoint) << count << " ranks";
    }
  }

  const ScratchDirectory scratch_;
};

class TrainerRanksPrecisionTest : public TrainerRanksTest,
                                  public testing::WithParamInterface<LearnerPrecision> {};

TEST_P(TrainerRanksPrecisionTest, EveryBitIsTheSameForAnyNumberOfRanks) {
  TrainConfig config = Sharded(SmallConfig());
  config.learner.precision = GetParam();
  config.env.observation_noise = 0.05;
  ExpectSameForAnyRanks(config, {2, 4, 8, 16});
}

TEST_P(TrainerRanksPrecisionTest, SoIsThatOfAHighLevelPolicy) {
  TrainConfig config = Sharded(SmallHighLevelConfig());
  config.learner.precision = GetParam();
  ExpectSameForAnyRanks(config, {2, 4, 8, 16});
}

INSTANTIATE_TEST_SUITE_P(Precisions, TrainerRanksPrecisionTest,
                         testing::Values(LearnerPrecision::kFloat32, LearnerPrecision::kMixed,
                                         LearnerPrecision::kBfloat16, LearnerPrecision::kFast,
                                         LearnerPrecision::kAmx),
                         [](const testing::TestParamInfo<LearnerPrecision>& param) {
                           return Name(param.param);
                         });

TEST_F(TrainerRanksTest, SoDoWindsPlantsAndACriticThatSeesMore) {
  TrainConfig config = Sharded(SmallConfig());
  config.env.wind.speed_fps = {0, 60};
  config.env.wind.turbulence_fps = {0, 5};
  config.env.truncate_at_time_limit = config.ppo.privileged_critic = true;
  config.ppo.target_kl = 0.01;
  config.ppo.held_noise_share = 0.5;
  config.ppo.log_std_rate_factor = 2;
  ExpectSameForAnyRanks(config, {2, 8});
}

TEST_F(TrainerRanksTest, SoDoNetworksWhoseGradientsAreSummedByParts) {
  TrainConfig config = Sharded(SmallConfig());
  config.network.hidden_size = config.network.gru_size = 64;
  for (const NetworkShape& shape :
       {ActorShape(config.network, 22, 4), CriticShape(config.network, 22)}) {
    ASSERT_GE(NetworkLayout(shape).size() * sizeof(float), kSummedByParts);
  }
  config.total_steps /= 2;
  ExpectSameForAnyRanks(config, {4, 8});
}

TEST_F(TrainerRanksTest, SoDoPoliciesThatLeaveThePedalsAlone) {
  TrainConfig config = Sharded(SmallConfig());
  config.ppo.pedals = false;
  config.ppo.average_iterations = 2;
  ExpectSameForAnyRanks(config, {2, 8});
}

/// A rank with more threads than tasks of a network: all compute both networks at once.
TEST_F(TrainerRanksTest, ItIsTheSameWhereNetworksAreNotComputedOneByOne) {
  const TrainConfig config = Sharded(SmallConfig());
  const Outcome expected = Train(config, 1, "", scratch_ / "one");
  for (const int count : {2, 8}) {
    const Outcome outcome =
        Train(config, count, "", scratch_ / "several", std::numeric_limits<int>::max(), 64);
    EXPECT_EQ(outcome.signature, expected.signature) << count << " ranks";
    EXPECT_EQ(outcome.metrics, expected.metrics) << count << " ranks";
  }
}

TEST_F(TrainerRanksTest, ResumesBitExactlyOnAnotherNumberOfRanks) {
  const TrainConfig config = Sharded(SmallConfig());
  const Outcome expected = Train(config, 1, "", scratch_ / "whole");
  Outcome outcome = Train(config, 8, "", scratch_ / "a", 1);
  outcome = Train(config, 2, scratch_ / "a", scratch_ / "b", 1);
  outcome = Train(config, 1, scratch_ / "b", scratch_ / "c");
  EXPECT_EQ(outcome.signature, expected.signature);
  EXPECT_TRUE(outcome.checkpoint == expected.checkpoint);
  outcome = Train(config, 1, "", scratch_ / "a", 2);
  outcome = Train(config, 4, scratch_ / "a", scratch_ / "b");
  EXPECT_TRUE(outcome.checkpoint == expected.checkpoint);
}

TEST_F(TrainerRanksTest, AStopOfOneRankDropsTheIterationOfAll) {
  RunOnRanks(4, [&](Ranks& ranks) {
    WorkerPool pool(1);
    Trainer trainer(Sharded(SmallConfig()), pool, ranks);
    trainer.Iterate();
    const std::uint64_t before = trainer.Signature();
    if (ranks.rank() == 2) pool.RequestStop();
    EXPECT_TRUE(trainer.Iterate().dropped) << ranks.Describe(ranks.rank());
    EXPECT_EQ(trainer.Signature(), before) << ranks.Describe(ranks.rank());
    EXPECT_EQ(trainer.iteration(), 1u);
  });
}

/// A rank that has no memory left to exchange anything, once it is told.
class StarvingRank final : public Ranks {
 public:
  explicit StarvingRank(Ranks& ranks) : ranks_(ranks) {}
  void Starve() { starves_ = true; }

  int rank() const override { return ranks_.rank(); }
  int count() const override { return ranks_.count(); }
  std::string Describe(int rank) const override { return ranks_.Describe(rank); }
  void ExchangeAll(int partner, const std::vector<Transfer>& transfers) override {
    if (starves_) throw std::bad_alloc();
    ranks_.ExchangeAll(partner, transfers);
  }
  void Notify(int rank, std::int64_t word) override { ranks_.Notify(rank, word); }
  std::optional<Notice> TakeNotice() override { return ranks_.TakeNotice(); }
  bool EndsWithin(double seconds) override { return ranks_.EndsWithin(seconds); }
  [[noreturn]] void Abort(const char* reason) override {
    throw Error(std::string("aborted: ") + reason);
  }

 private:
  Ranks& ranks_;
  bool starves_ = false;
};

TEST_F(TrainerRanksTest, ARankWithoutMemoryForWhatAllSaveEndsAll) {
  RunOnRanks(2, [&](Ranks& ranks) {
    WorkerPool pool(1);
    StarvingRank own(ranks);
    const Trainer trainer(Sharded(SmallConfig()), pool, own);
    if (ranks.rank() == 0) own.Starve();  // the other gives it what it has, and goes on
    EXPECT_EQ(MessageOf([&] { trainer.Save(scratch_ / "none"); }),
              ranks.rank() == 0 ? std::string("aborted: ") + ReasonOf(std::bad_alloc()) : "");
  });
}

TEST_F(TrainerRanksTest, SoManyRanksAsThereAreNoShardsForAreRefused) {
  TrainConfig config = SmallConfig();
  config.learner.shards = 4;
  RunOnRanks(8, [&](Ranks& ranks) {
    WorkerPool pool(1);
    const std::string message = MessageOf([&] { const Trainer trainer(config, pool, ranks); });
    EXPECT_THAT(message, HasSubstr("8 ranks"));
    EXPECT_THAT(message, HasSubstr("--set learner.shards=8"));
  });
}

/// The update of a rollout of zeros, of which one rank's has a NaN in what a loss takes.
class ALossThatIsNotFinite
    : public testing::TestWithParam<std::pair<const char*, std::vector<float> Rollout::*>> {};

TEST_P(ALossThatIsNotFinite, StopsAllRanksAndNamesTheShard) {
  const auto& [network, column] = GetParam();
  TrainConfig config = SmallConfig();
  config.learner.shards = 8;
  RunOnRanks(4, [&, network = network, column = column](Ranks& ranks) {
    WorkerPool pool(1);
    ActorCritic networks(config, 22, 0, 4);
    PpoConfig own = config.ppo;
    own.num_aircraft /= ranks.count();
    Rollout rollout(own, 22, 4, networks.actor.layout().shape().state_size(), 0,
                    {8, 2 * ranks.rank(), 2});
    std::fill(rollout.not_done.begin(), rollout.not_done.end(), 1.0f);
    if (ranks.rank() == 2) (rollout.*column)[13] = std::numeric_limits<float>::quiet_NaN();
    PpoUpdate update(config, networks, pool, ranks);
    const std::string message = MessageOf([&] { update.Run(rollout, {}, 0, {1e-3, 1e-3}); });
    EXPECT_THAT(message, HasSubstr(std::string(network) + "'s training exploded"));
    EXPECT_THAT(message, HasSubstr("shard 5 on rank 2"));
    EXPECT_TRUE(update.exploded());
  });
}

INSTANTIATE_TEST_SUITE_P(Columns, ALossThatIsNotFinite,
                         testing::Values(std::pair{"actor", &Rollout::log_prob},
                                         std::pair{"critic", &Rollout::target}),
                         [](const auto& param) { return std::string(param.param.first) + "s"; });

TEST_F(TrainerRanksTest, WhatOneRankAloneMeetsStopsAllAndLeavesTheStateOfBefore) {
  constexpr int kAircraft = 50;  // of 96: rank 2 of 4 flies it, in its first shard, the ninth of 16
  TrainConfig config = Sharded(SmallConfig());
  config.evaluation.interval_iterations = 0;
  config.env.truncate_at_time_limit = true;  // rewards then hold values
  const std::string whole = scratch_ / "whole", forged_path = scratch_ / "forged";
  WorkerPool pool(1);
  Trainer trained(config, pool);
  trained.Iterate();
  trained.Save(whole);
  const NetworkLayout actor(ActorShape(config.network, 22, 4)),
      critic(CriticShape(config.network, 22));
  for (const auto& [network, states] :
       {std::pair{"actor", &RecurrentState::actor}, {"critic", &RecurrentState::critic}}) {
    // Forged: a state that is no number spoils what its aircraft alone adds.
    TrainingState forged =
        LoadCheckpoint(TensorFile::Read(whole), whole, trained.config(), actor, critic);
    (forged.recurrent.*states)[kAircraft * config.network.gru_size + 3] = std::nanf("");
    StoreCheckpoint(trained.config(), actor, forged).Write(forged_path);
    RunOnRanks(4, [&, network = network](Ranks& ranks) {
      WorkerPool own(1);
      Trainer trainer(config, own, ranks);
      trainer.Restore(forged_path);
      const std::uint64_t before = trainer.Signature();
      const std::string message = MessageOf([&] { trainer.Iterate(); });
      EXPECT_THAT(message, HasSubstr(std::string("the ") + network + "'s training exploded"));
      EXPECT_THAT(message, HasSubstr("first in shard 8 on rank 2"));
      EXPECT_EQ(trainer.Signature(), before) << ranks.Describe(ranks.rank());
    });
  }
}

}  // namespace
}  // namespace skein
