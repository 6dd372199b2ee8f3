// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/shards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "base/error.h"
#include "simd/target.h"
#include "tests/error_message.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"
#include "tests/train/small_config.h"
#include "train/ppo/gradient_sums.h"
#include "train/ppo/rank_shards.h"
#include "train/ppo/trainer.h"
#include "train/ppo/training_state.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

constexpr Tolerance kSumOrder{1e-5, "float32 gradients and losses added up in another order"};

TEST(ShardTreeTest, BitsDoNotDependOnHowShardsAreGrouped) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 1e3);
  std::vector<Sums<2>> parts(1024);
  for (Sums<2>& part : parts) part = {normal(generator), normal(generator)};
  const Sums<2> whole = SumByTree(parts);
  for (std::size_t width = 1; width <= parts.size(); width *= 2) {
    std::vector<Sums<2>> groups;
    for (auto begin = parts.begin(); begin != parts.end(); begin += width) {
      groups.push_back(SumByTree(std::vector<Sums<2>>(begin, begin + width)));
    }
    EXPECT_EQ(SumByTree(groups), whole) << "groups of " << width;
  }
  const double in_order =
      std::accumulate(parts.begin(), parts.end(), 0.0,
                      [](double sum, const Sums<2>& part) { return sum + part[0]; });
  EXPECT_NE(in_order, whole[0]) << "numbers whose sum shows its order";
}

/// One of so many ranks, which exchanges nothing.
class OneOf final : public Ranks {
 public:
  OneOf(int rank, int count) : rank_(rank), count_(count) {}
  int rank() const override { return rank_; }
  int count() const override { return count_; }
  std::string Describe(int rank) const override { return std::to_string(rank); }
  void ExchangeAll(int, const std::vector<Transfer>&) override {}
  void Notify(int, std::int64_t) override {}
  std::optional<Notice> TakeNotice() override { return std::nullopt; }
  bool EndsWithin(double) override { return true; }
  [[noreturn]] void Abort(const char* reason) override { throw Error(reason); }

 private:
  int rank_, count_;
};

TEST(ShardsOfRankTest, EveryShardIsSomeRanksOnce) {
  TrainConfig config = SmallConfig();
  config.learner.shards = 16;
  for (const int count : {1, 2, 4, 8, 16}) {
    int next = 0;
    for (int rank = 0; rank < count; ++rank) {
      const ShardRange own = ShardsOfRank(config, OneOf(rank, count));
      EXPECT_EQ(own.first, next);
      EXPECT_EQ(own.total, 16);
      next += own.count;
    }
    EXPECT_EQ(next, 16);
  }
}

TEST(ShardsOfRankTest, ARefusalNamesANumberThatWorks) {
  TrainConfig config = SmallConfig();  // of 96 aircraft: 32 shards at most
  for (const int count : {2, 8, 32, 64, 512}) {
    config.learner.shards = 1;
    const std::string message = MessageOf([&] { ShardsOfRank(config, OneOf(0, count)); });
    const std::string option = "--set learner.shards=";
    ASSERT_THAT(message, HasSubstr(option));
    config.learner.shards = std::stoi(message.substr(message.find(option) + option.size()));
    EXPECT_NO_THROW(ValidateLearning(config)) << message;
    EXPECT_NO_THROW(ShardsOfRank(config, OneOf(0, std::min(count, 32)))) << message;
    EXPECT_EQ(message.find("the most that its aircraft allow") != std::string::npos, count > 32);
  }
}

TEST(DefaultShardsTest, AreThirtyTwoUnlessRanksOrAircraftAskForOthers) {
  TrainConfig config = SmallConfig();  // of 96 aircraft: 32 shards at most
  for (const int ranks : {2, 8, 32, 64}) EXPECT_EQ(DefaultShards(config, ranks), 32);
  config.ppo.num_aircraft = 24;
  EXPECT_EQ(DefaultShards(config, 2), 8);
  config.ppo.num_aircraft = 4096;
  EXPECT_EQ(DefaultShards(config, 2), 32);
  EXPECT_EQ(DefaultShards(config, 64), 64);
}

TEST(ShardsTest, TheFirstRolloutsEpisodesAreThoseOfOneShard) {
  TrainConfig config = SmallConfig();
  config.env.stagger_clocks = false;
  // All end with the rollout.
  config.env.time_limit_steps = config.env.heading.earliest_success_step =
      config.ppo.rollout_steps * config.env.action_repeat;
  WorkerPool pool(1);
  const IterationReport one = Trainer(config, pool).Iterate();
  config.learner.shards = 4;
  const IterationReport four = Trainer(config, pool).Iterate();
  EXPECT_GE(one.episodes, 96u);
  EXPECT_EQ(four.episodes, one.episodes);
  EXPECT_EQ(four.terminations, one.terminations);
  EXPECT_NEAR(four.return_mean, one.return_mean, kSumOrder * std::abs(one.return_mean));
  EXPECT_NEAR(four.explained_variance, one.explained_variance, kSumOrder);
}

/// [shard][slice] vectors, and what SumGradients must leave of one element.
struct Gradients {
  Gradients(int shards, int slices) {
    std::normal_distribution<float> normal;
    for (int shard = 0; shard < shards; ++shard) {
      of_shards.emplace_back(kSize, 0.0f);
      for (int slice = 0; slice < slices; ++slice) {
        AlignedVector<float>& values = accumulators.emplace_back(kSize);
        for (int i = 0; i < kSize; ++i) {
          values[i] = normal(generator);
          of_shards.back()[i] += values[i];
        }
      }
    }
  }
  float Sum(int i) const {
    std::vector<float> parts;
    for (const std::vector<float>& shard : of_shards) parts.push_back(shard[i]);
    return SumByTree(parts);
  }

  static constexpr int kSize = 37;
  std::mt19937 generator{5};
  std::vector<AlignedVector<float>> accumulators;
  std::vector<std::vector<float>> of_shards;
};

TEST(ShardTreeTest, GradientsAreSummedBySliceAndThenByTheTree) {
  for (const simd::Target target : simd::SupportedTargets()) {
    const ScopedTarget scoped(target);
    for (const int shards : {1, 2, 4, 8, 16, 32, 64}) {
      for (const int slices : {1, 2, 5, 7, 16}) {
        Gradients gradients(shards, slices);
        const float untouched = gradients.accumulators[0][36];
        SumGradients(0, 36, slices, gradients.accumulators);
        for (int i = 0; i < 36; ++i) {
          EXPECT_EQ(gradients.accumulators[0][i], gradients.Sum(i)) << shards << " by " << slices;
        }
        EXPECT_EQ(gradients.accumulators[0][36], untouched);
      }
    }
  }
}

TrainConfig ShardedConfig(int shards) {
  TrainConfig config = SmallConfig();
  config.learner.shards = shards;
  return config;
}

struct Trained {
  std::uint64_t signature;
  std::vector<double> numbers;
};

Trained TrainToTheEnd(const TrainConfig& config, int threads) {
  WorkerPool pool(threads);
  Trainer trainer(config, pool);
  Trained trained{};
  while (!trainer.finished()) {
    const IterationReport report = trainer.Iterate();
    for (const double number : {report.policy_loss, report.value_loss, report.explained_variance,
                                report.actor_gradient_norm, report.critic_gradient_norm}) {
      trained.numbers.push_back(number);
    }
    if (report.episodes > 0) trained.numbers.push_back(report.return_mean);
  }
  trained.signature = trainer.Signature();
  return trained;
}

TEST(ShardsTest, NoBitDependsOnThreadsOrOnTheTilesOfRollouts) {
  const Trained expected = TrainToTheEnd(ShardedConfig(4), 1);
  for (const int threads : {2, 8}) {
    const Trained trained = TrainToTheEnd(ShardedConfig(4), threads);
    EXPECT_EQ(trained.signature, expected.signature) << threads << " threads";
    EXPECT_EQ(trained.numbers, expected.numbers) << threads << " threads";
  }
  TrainConfig whole = ShardedConfig(4);
  whole.learner.rollout_tile = 96;
  const Trained trained = TrainToTheEnd(whole, 2);
  EXPECT_EQ(trained.signature, expected.signature);
  EXPECT_EQ(trained.numbers, expected.numbers);
  EXPECT_NE(TrainToTheEnd(ShardedConfig(2), 2).signature, expected.signature);
}

TEST(ShardsTest, TheirGradientIsThatOfTheWholeMinibatch) {
  WorkerPool pool(2);
  const auto first_step = [&](int shards, bool normalised) {
    TrainConfig config = ShardedConfig(shards);
    config.ppo.minibatches = config.ppo.epochs = 1;
    config.ppo.normalise_advantages = normalised;
    config.evaluation.interval_iterations = 0;
    return Trainer(config, pool).Iterate();
  };
  for (const bool normalised : {true, false}) {
    const IterationReport expected = first_step(1, normalised);
    for (const int shards : {2, 8, 32}) {
      const IterationReport report = first_step(shards, normalised);
      EXPECT_NEAR(report.value_loss / expected.value_loss, 1, kSumOrder);
      EXPECT_NEAR(report.actor_gradient_norm / expected.actor_gradient_norm, 1, kSumOrder);
      EXPECT_NEAR(report.critic_gradient_norm / expected.critic_gradient_norm, 1, kSumOrder);
      // At a ratio of one the loss is minus the mean advantage, of which normalising leaves none.
      if (normalised) {
        EXPECT_NEAR(report.policy_loss, 0, kSumOrder);
      } else {
        EXPECT_NEAR(report.policy_loss / expected.policy_loss, 1, kSumOrder);
      }
    }
    EXPECT_EQ(std::abs(expected.policy_loss) > 1, !normalised);
  }
}

TEST(ShardsTest, ThoseThatAreNotPossibleAreRefusedWithThoseThatAre) {
  WorkerPool pool(1);
  for (const int shards : {3, 64}) {
    const std::string message =
        MessageOf([&] { const Trainer trainer(ShardedConfig(shards), pool); });
    EXPECT_THAT(message, HasSubstr("learner.shards = " + std::to_string(shards)));
    EXPECT_THAT(message, HasSubstr("1, 2, 4, 8, 16, 32"));
    EXPECT_THAT(message, ::testing::Not(HasSubstr("64,")));
  }
  TrainConfig many = ShardedConfig(32);
  many.ppo.minibatches = 7;  // of 6 chunks
  EXPECT_THAT(MessageOf([&] { const Trainer trainer(many, pool); }),
              HasSubstr("7 ppo.minibatches"));
}

TEST(ShardsTest, OneShardIsNoPartOfACheckpointsConfiguration) {
  EXPECT_EQ(DescribeConfig(ShardedConfig(1)).count("learner.shards"), 0u);
  EXPECT_EQ(DescribeConfig(ShardedConfig(2)).at("learner.shards"), "2");
}

}  // namespace
}  // namespace skein
