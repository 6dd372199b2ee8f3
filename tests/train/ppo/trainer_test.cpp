// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/trainer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include "base/error.h"
#include "simd/target.h"
#include "tests/error_message.h"
#include "tests/file_bytes.h"
#include "tests/scratch_directory.h"
#include "tests/tolerance.h"
#include "tests/train/hierarchy_config.h"
#include "tests/train/libtorch.h"
#include "tests/train/network/gradient_comparison.h"
#include "tests/train/small_config.h"
#include "tests/train/version_0_1.h"
#include "train/policy/policy_parameters.h"
#include "train/ppo/training_state.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

class TrainerTest : public testing::Test {
 protected:
  static std::string RefusalOf(const TrainConfig& config, const std::string& path) {
    WorkerPool pool(1);
    Trainer trainer(config, pool);
    const std::uint64_t before = trainer.Signature();
    try {
      trainer.Restore(path);
    } catch (const Error& error) {
      EXPECT_EQ(trainer.Signature(), before);
      return error.what();
    }
    return "";
  }

  /// From the checkpoint, path_, of two iterations, which flies as the training's policy does.
  void ExpectToResumeBitExactly(const TrainConfig& config) const {
    WorkerPool pool(1);
    Trainer whole(config, pool);
    whole.Iterate();
    whole.Iterate();
    whole.Save(path_);
    Trainer resumed(config, pool);
    resumed.Restore(path_);
    EXPECT_EQ(resumed.Signature(), whole.Signature());
    EXPECT_EQ(RecurrentPolicy::Load(path_).parameters()->values,
              whole.policy().parameters()->values);
    EXPECT_EQ(resumed.Iterate().learning_rate, whole.Iterate().learning_rate);
    EXPECT_EQ(resumed.Signature(), whole.Signature());
  }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "checkpoint.skein";
};

class TrainerPrecisionTest : public TrainerTest,
                             public testing::WithParamInterface<LearnerPrecision> {
 protected:
  static TrainConfig Config() {
    TrainConfig config = SmallConfig();
    config.learner.precision = GetParam();
    return config;
  }
};

TEST_P(TrainerPrecisionTest, EveryBitIsTheSameForAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 8}) {
    WorkerPool pool(threads);
    Trainer trainer(Config(), pool);
    while (!trainer.finished()) trainer.Iterate();
    if (first == 0) first = trainer.Signature();
    EXPECT_EQ(trainer.Signature(), first) << threads << " threads";
  }
}

TEST_P(TrainerPrecisionTest, ResumesBitExactly) {
  WorkerPool pool(2);
  Trainer whole(Config(), pool);
  whole.Iterate();
  whole.Save(path_);
  Trainer resumed(Config(), pool);
  resumed.Restore(path_);
  EXPECT_EQ(resumed.Signature(), whole.Signature());
  while (!whole.finished()) {
    const IterationReport expected = whole.Iterate();
    const IterationReport report = resumed.Iterate();
    EXPECT_EQ(report.iteration, expected.iteration);
    EXPECT_EQ(report.env_steps, expected.env_steps);
    EXPECT_EQ(report.episodes, expected.episodes);
    EXPECT_EQ(report.policy_loss, expected.policy_loss);
    EXPECT_EQ(report.learning_rate, expected.learning_rate);
    EXPECT_EQ(report.evaluation_success_rate, expected.evaluation_success_rate);
    EXPECT_EQ(report.best, expected.best);
  }
  EXPECT_TRUE(resumed.finished());
  EXPECT_EQ(resumed.Signature(), whole.Signature());
  whole.Save(scratch_ / "a");
  resumed.Save(scratch_ / "b");
  EXPECT_EQ(BytesOf(scratch_ / "a"), BytesOf(scratch_ / "b"));
}

TEST_F(TrainerTest, RefusesACheckpointOfAnotherConfigurationAndNamesTheField) {
  WorkerPool pool(1);
  Trainer trainer(SmallConfig(), pool);
  trainer.Save(path_);
  TrainConfig other = SmallConfig();
  other.ppo.gamma = 0.98;
  EXPECT_NE(RefusalOf(other, path_).find("ppo.gamma"), std::string::npos);
  other = SmallConfig();
  other.env.heading.yaw_change_rad = 1;
  EXPECT_NE(RefusalOf(other, path_).find("env.heading.yaw_change_rad"), std::string::npos);
  other = SmallConfig();
  other.network.gru_size = 32;
  EXPECT_NE(RefusalOf(other, path_).find("network.gru_size"), std::string::npos);
  trainer.policy().Save(scratch_ / "policy");
  EXPECT_NE(RefusalOf(SmallConfig(), scratch_ / "policy").find("not a checkpoint"),
            std::string::npos);
  EXPECT_EQ(RefusalOf(SmallConfig(), path_), "");
}

TEST_F(TrainerTest, CheckpointsOfVersion01ResumeBitExactly) {
  WorkerPool pool(1);
  Trainer whole(SmallHighLevelConfig(), pool), resumed(SmallHighLevelConfig(), pool);
  whole.Iterate();
  whole.Save(path_);
  const TensorFile old = AsOfVersion01(TensorFile::Read(path_));
  EXPECT_EQ(old.tensors.count("recurrent/keep"), 1u);
  old.Write(path_);
  resumed.Restore(path_);
  EXPECT_EQ(resumed.Signature(), whole.Signature());
  whole.Iterate();
  resumed.Iterate();
  EXPECT_EQ(resumed.Signature(), whole.Signature());
}

TEST_F(TrainerTest, RefusesACheckpointWhosePolicyHasOtherSizes) {
  WorkerPool pool(1);
  Trainer(SmallConfig(), pool).Save(path_);
  TensorFile file = TensorFile::Read(path_);
  // Forged: a larger policy than the configuration says would not fit into the trainer's memory.
  RecurrentPolicy::Parameters larger;
  larger.config = SmallConfig().network;
  larger.config.hidden_size = 64;
  larger.shape = ActorShape(larger.config, 22, 4);
  larger.values.assign(NetworkLayout(larger.shape).size(), 0.5f);
  StorePolicy(larger, file);
  file.Write(path_);
  EXPECT_NE(RefusalOf(SmallConfig(), path_).find("other sizes"), std::string::npos);
}

TEST_F(TrainerTest, StartsFromTheNetworksOfACheckpointOrAPolicy) {
  WorkerPool pool(1);
  Trainer trained(SmallConfig(), pool);
  trained.Iterate();
  trained.Save(path_);
  Trainer fresh(SmallConfig(), pool);
  EXPECT_TRUE(fresh.StartFrom(path_));
  EXPECT_EQ(fresh.env_steps(), 0u);
  EXPECT_EQ(fresh.policy().parameters()->values, trained.policy().parameters()->values);
  EXPECT_NE(fresh.Signature(), trained.Signature()) << "the optimiser is fresh";
  fresh.Iterate();

  trained.policy().Save(scratch_ / "policy");
  Trainer actor_alone(SmallConfig(), pool);
  EXPECT_FALSE(actor_alone.StartFrom(scratch_ / "policy"));
  TrainConfig unscaled = SmallConfig();
  unscaled.ppo.popart = false;
  Trainer without_scale(unscaled, pool);
  EXPECT_FALSE(without_scale.StartFrom(path_)) << "a critic of scaled values";
}

TEST_F(TrainerTest, APrivilegedCriticTrainsAndResumesBitExactly) {
  WorkerPool pool(2);
  TrainConfig config = SmallConfig();
  config.ppo.privileged_critic = config.env.truncate_at_time_limit = true;
  Trainer whole(config, pool);
  whole.Iterate();
  whole.Save(path_);
  Trainer resumed(config, pool);
  resumed.Restore(path_);
  EXPECT_EQ(resumed.Iterate().value_loss, whole.Iterate().value_loss);
  EXPECT_EQ(resumed.Signature(), whole.Signature());
  TrainConfig plain = config;
  plain.ppo.privileged_critic = false;
  EXPECT_NE(RefusalOf(plain, path_).find("ppo.privileged_critic"), std::string::npos);

  // Its actor serves any training; its critic one that sees as much.
  Trainer from(config, pool), without(plain, pool);
  EXPECT_TRUE(from.StartFrom(path_));
  EXPECT_FALSE(without.StartFrom(path_));
  EXPECT_EQ(without.policy().parameters()->values, from.policy().parameters()->values);
  without.Iterate();
}

TEST_F(TrainerTest, NetworksThatDoNotFitChangeNothing) {
  WorkerPool pool(1);
  Trainer(SmallConfig(), pool).Save(path_);
  TrainConfig larger = SmallConfig(), linear = SmallConfig();
  larger.network.gru_size = 32;
  linear.network.tanh_mean = false;
  for (const TrainConfig& other : {larger, linear}) {
    Trainer trainer(other, pool);
    const std::uint64_t before = trainer.Signature();
    EXPECT_THROW(trainer.StartFrom(path_), Error);
    EXPECT_EQ(trainer.Signature(), before);
  }
}

TEST_F(TrainerTest, StatisticsLeaveOutEpisodesWithStaggeredClocks) {
  WorkerPool pool(1);
  TrainConfig config = SmallConfig();
  config.evaluation.interval_iterations = 0;
  Trainer staggered(config, pool);
  // 80 of the 100 control steps that a whole episode takes at most: only those that fail early end.
  const IterationReport first = staggered.Iterate();
  EXPECT_EQ(first.terminations[static_cast<int>(Termination::kTimeLimit)], 0);
  const IterationReport second = staggered.Iterate();
  EXPECT_GT(second.episodes, 0u);
}

TEST_F(TrainerTest, RestoringTellsWhereTheCheckpointComesFrom) {
  WorkerPool pool(1);
  Trainer trainer(SmallConfig(), pool);
  trainer.Save(path_);
  EXPECT_EQ(trainer.Restore(path_).simd_target, Name(simd::ActiveTarget()));
  EXPECT_EQ(trainer.Restore(path_).records, "");
  trainer.Save(path_, "three rows");
  EXPECT_EQ(trainer.Restore(path_).records, "three rows");
  TensorFile file = TensorFile::Read(path_);
  file.metadata[kSimdTargetKey] = "another";
  file.Write(path_);
  EXPECT_EQ(trainer.Restore(path_).simd_target, "another");
}

TEST_P(TrainerPrecisionTest, AnExplosionLeavesTheStateOfBefore) {
  TrainConfig config = Config();
  // The standard deviation grows by e with every step until it is infinite.
  config.ppo.learning_rate = 1;
  config.ppo.entropy_coefficient = 1e6;
  config.ppo.epochs = 100;
  config.evaluation.interval_iterations = 0;
  WorkerPool pool(2);
  Trainer trainer(config, pool);
  std::uint64_t before = 0;
  const auto train = [&] {
    while (!trainer.finished()) {
      before = trainer.Signature();
      trainer.Iterate();
    }
  };
  EXPECT_THROW(train(), Error);
  EXPECT_EQ(trainer.Signature(), before);
  trainer.Save(path_);
  Trainer restored(config, pool);
  restored.Restore(path_);
  EXPECT_EQ(restored.Signature(), before);
}

TEST_F(TrainerTest, AStopAnywhereLeavesTheStateOfBefore) {
  using Clock = std::chrono::steady_clock;
  // The second iteration has a rollout, an update and an evaluation to be stopped in.
  constexpr int kMoments = 16;
  Clock::duration whole_time{};
  std::uint64_t before = 0, after = 0;
  {
    WorkerPool pool(2);
    Trainer trainer(SmallConfig(), pool);
    trainer.Iterate();
    trainer.Save(path_);
    before = trainer.Signature();
    const Clock::time_point start = Clock::now();
    EXPECT_GE(trainer.Iterate().evaluation_success_rate, 0);
    whole_time = Clock::now() - start;
    after = trainer.Signature();
  }
  int dropped = 0;
  for (int moment = 0; moment < kMoments; ++moment) {
    WorkerPool pool(2);
    Trainer trainer(SmallConfig(), pool);
    trainer.Restore(path_);
    std::thread stop([&] {
      std::this_thread::sleep_for(whole_time * moment / kMoments);
      pool.RequestStop();
    });
    const IterationReport report = trainer.Iterate();
    stop.join();
    EXPECT_EQ(trainer.Signature(), report.dropped ? before : after) << "moment " << moment;
    EXPECT_LE(report.dropped_steps, 96u * 16 * 5);
    if (!report.dropped) continue;
    ++dropped;
    EXPECT_EQ(trainer.iteration(), 1u);
    trainer.Save(scratch_ / "stopped");
    EXPECT_EQ(BytesOf(scratch_ / "stopped"), BytesOf(path_));
  }
  EXPECT_GT(dropped, 0);
}

TEST_F(TrainerTest, AStoppingPoolFliesNothing) {
  WorkerPool pool(2);
  Trainer trainer(SmallConfig(), pool);
  const std::uint64_t before = trainer.Signature();
  pool.RequestStop();
  const IterationReport report = trainer.Iterate();
  EXPECT_TRUE(report.dropped);
  EXPECT_EQ(report.dropped_steps, 0u);
  EXPECT_EQ(trainer.Signature(), before);
}

TEST_P(TrainerPrecisionTest, NotANumberInAnyTileLeavesTheStateOfBefore) {
  TrainConfig config = Config();
  config.evaluation.interval_iterations = 0;
  config.ppo.popart = false;
  config.env.truncate_at_time_limit = true;  // rewards then hold values
  WorkerPool pool(2);
  Trainer trainer(config, pool);
  trainer.Iterate();
  trainer.Save(path_);
  const NetworkLayout actor(ActorShape(config.network, 22, 4)),
      critic(CriticShape(config.network, 22));
  const TrainingState whole = LoadCheckpoint(TensorFile::Read(path_), path_, config, actor, critic);
  for (const auto states : {&RecurrentState::actor, &RecurrentState::critic}) {
    for (const int aircraft : {0, 50, 95}) {
      // Forged: a state that is no number spoils what its aircraft alone adds.
      TrainingState forged = whole;
      (forged.recurrent.*states)[aircraft * config.network.gru_size + 3] = std::nanf("");
      StoreCheckpoint(config, actor, forged).Write(path_);
      trainer.Restore(path_);
      const std::uint64_t before = trainer.Signature();
      EXPECT_THAT(MessageOf([&] { trainer.Iterate(); }), HasSubstr("exploded")) << aircraft;
      EXPECT_EQ(trainer.Signature(), before);
    }
  }
}

TEST_P(TrainerPrecisionTest, TheFirstUpdateMovesALittleFromTheRolloutsPolicy) {
  TrainConfig config = Config();
  config.ppo.learning_rate = 1e-12;  // so that every minibatch still sees the rollout's policy
  config.evaluation.interval_iterations = 0;
  WorkerPool pool(1);
  const IterationReport report = Trainer(config, pool).Iterate();
  // Rollouts and updates compute in the same precision.
  constexpr Tolerance kSquareOfRounding{1e-7, "the square of float32 roundings of about ten"};
  EXPECT_NEAR(report.approximate_kl, 0, kSquareOfRounding);
  EXPECT_EQ(report.clip_fraction, 0);
}

TEST_P(TrainerPrecisionTest, ConfigurationSaysWhatRuns) {
  WorkerPool pool(1);
  const Trainer trainer(Config(), pool);
  EXPECT_EQ(trainer.config().learner.precision, GetParam());
  EXPECT_EQ(trainer.backend().precision, GetParam());
}

TEST_P(TrainerPrecisionTest, LibTorchRunsInFloat32) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  WorkerPool pool(1);
  TrainConfig config = Config();
  config.learner.backend = Backend::kLibTorch;
  EXPECT_EQ(Trainer(config, pool).config().learner.precision, LearnerPrecision::kFloat32);
}

INSTANTIATE_TEST_SUITE_P(Precisions, TrainerPrecisionTest, testing::ValuesIn(kRunnablePrecisions),
                         [](const auto& precision) { return Name(precision.param); });

TEST_F(TrainerTest, EveryPrecisionIsAnotherTraining) {
  WorkerPool pool(2);
  std::set<std::uint64_t> signatures;
  for (const LearnerPrecision precision : kRunnablePrecisions) {
    TrainConfig config = SmallConfig();
    config.learner.precision = precision;
    Trainer trainer(config, pool);
    trainer.Iterate();
    signatures.insert(trainer.Signature());
  }
  EXPECT_EQ(signatures.size(), kRunnablePrecisions.size());
}

TEST_F(TrainerTest, AutomaticPrecisionIsResolvedAndStaysInCheckpoints) {
  WorkerPool pool(1);
  TrainConfig config = SmallConfig();
  config.learner.precision = LearnerPrecision::kAuto;
  Trainer trainer(config, pool);
  EXPECT_EQ(trainer.config().learner.precision, DefaultPrecision());
  trainer.Save(path_);
  EXPECT_EQ(RefusalOf(config, path_), "");
  config.learner.precision = LearnerPrecision::kMixed;
  EXPECT_EQ(RefusalOf(config, path_),
            path_ + ": made with learner.precision = " + Name(DefaultPrecision()) +
                ", but the configuration says mixed");
}

TEST_F(TrainerTest, LearningRateFallsLinearlyToItsFraction) {
  WorkerPool pool(1);
  TrainConfig config = SmallConfig();
  config.ppo.final_learning_rate_fraction = 0.5;
  Trainer trainer(config, pool);
  constexpr Tolerance kRounding{1e-12, "float64 rounding"};
  const double expected[] = {0.875, 0.75, 0.625, 0.5};
  for (const double fraction : expected) {
    EXPECT_NEAR(trainer.Iterate().learning_rate, fraction * config.ppo.learning_rate, kRounding);
  }
  EXPECT_TRUE(trainer.finished());
}

TEST_F(TrainerTest, ALearningRateThatHasFallenToZeroLeavesTheActorAsItIs) {
  WorkerPool pool(2);
  TrainConfig config = SmallConfig();
  config.ppo.final_learning_rate_fraction = 0;
  Trainer trainer(config, pool);
  std::vector<float> before;
  IterationReport last;
  while (!trainer.finished()) {
    before = trainer.policy().parameters()->values;
    last = trainer.Iterate();
    EXPECT_EQ(trainer.policy().parameters()->values == before, trainer.finished());
  }
  EXPECT_EQ(last.learning_rate, 0);
}

TEST_F(TrainerTest, LearningRateFollowsTheDivergenceBelowTheLine) {
  WorkerPool pool(1);
  TrainConfig config = SmallConfig();
  config.ppo.target_kl = 1e-9;  // every update goes beyond it
  Trainer trainer(config, pool);
  constexpr Tolerance kRounding{1e-12, "float64 rounding"};
  double expected = config.ppo.learning_rate;
  while (!trainer.finished()) {
    const double line = config.ppo.learning_rate *
                        (1 - 0.98 * static_cast<double>(trainer.env_steps() + 96 * 16 * 5) /
                                 static_cast<double>(config.total_steps));
    const IterationReport report = trainer.Iterate();
    EXPECT_NEAR(report.learning_rate, std::min(expected, line), kRounding);
    expected = report.learning_rate / 1.5;
  }
  config.ppo.target_kl = 1e9;  // none does
  const IterationReport unhindered = Trainer(config, pool).Iterate();
  config.ppo.target_kl = 0;
  EXPECT_EQ(Trainer(config, pool).Iterate().learning_rate, unhindered.learning_rate);
}

TEST_F(TrainerTest, AnAdaptedLearningRateResumesBitExactly) {
  TrainConfig config = SmallConfig();
  config.ppo.target_kl = 1e-9;
  ExpectToResumeBitExactly(config);
  EXPECT_NE(RefusalOf(SmallConfig(), path_).find("ppo.target_kl"), std::string::npos);
}

TEST_F(TrainerTest, TheCriticsOwnLearningRateLeavesTheActorsFirstUpdateAlone) {
  WorkerPool pool(1);
  TrainConfig quick = SmallConfig();
  quick.ppo.critic_learning_rate = 10 * quick.ppo.learning_rate;
  Trainer plain(SmallConfig(), pool), other(quick, pool);
  EXPECT_LT(other.Iterate().value_loss, plain.Iterate().value_loss);
  EXPECT_EQ(other.policy().parameters()->values, plain.policy().parameters()->values);
}

TEST_F(TrainerTest, KeepsTheMeanOfItsActorsAndTrainsAsWithoutIt) {
  WorkerPool pool(1);
  TrainConfig config = SmallConfig();
  Trainer plain(config, pool);
  config.ppo.average_iterations = 2;
  Trainer averaging(config, pool);
  const auto values = [](const Trainer& trainer) { return trainer.policy().parameters()->values; };
  EXPECT_EQ(values(averaging), values(plain));
  std::vector<float> expected;
  while (!plain.finished()) {
    plain.Iterate();
    averaging.Iterate();
    const std::vector<float> actor = values(plain);
    if (expected.empty()) expected = actor;
    for (std::size_t i = 0; i < actor.size(); ++i)
      expected[i] = 0.5F * expected[i] + 0.5F * actor[i];
    EXPECT_EQ(values(averaging), expected);
    EXPECT_EQ(expected == actor, plain.iteration() == 1);
  }
}

TEST_F(TrainerTest, AMeanOfActorsResumesBitExactly) {
  TrainConfig config = SmallConfig();
  config.ppo.average_iterations = 5;
  ExpectToResumeBitExactly(config);
  EXPECT_NE(RefusalOf(SmallConfig(), path_).find("ppo.average_iterations"), std::string::npos);
}

TEST_F(TrainerTest, BothBackendsTrainTheSamePolicy) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  TrainConfig config = SmallConfig();
  config.network.hidden_layers = 1;
  config.network.hidden_size = 20;
  config.network.gru_layers = 2;
  config.network.gru_size = 9;
  config.learner.precision = LearnerPrecision::kFloat32;
  config.ppo.epochs = 1;
  config.ppo.minibatches = 1;
  config.evaluation.interval_iterations = 0;
  WorkerPool pool(2);
  Trainer fused_trainer(config, pool);
  EXPECT_EQ(fused_trainer.backend().backend, Backend::kFused);
  const IterationReport fused = fused_trainer.Iterate();
  config.learner.backend = Backend::kLibTorch;
  Trainer libtorch_trainer(config, pool);
  EXPECT_EQ(libtorch_trainer.backend().backend, Backend::kLibTorch);
  const IterationReport libtorch = libtorch_trainer.Iterate();
  constexpr Tolerance kBackends{1e-3, "float32 in another order through rollout and update"};
  EXPECT_NEAR(fused.actor_gradient_norm, libtorch.actor_gradient_norm,
              kBackends * libtorch.actor_gradient_norm);
  EXPECT_NEAR(fused.critic_gradient_norm, libtorch.critic_gradient_norm,
              kBackends * libtorch.critic_gradient_norm);
  EXPECT_NEAR(fused.value_loss, libtorch.value_loss, kBackends * libtorch.value_loss);
}

class TrainerBackendTest : public TrainerTest, public testing::WithParamInterface<Backend> {};

TEST_P(TrainerBackendTest, EveryShapeTrainsAndResumesBitExactly) {
  const bool is_fused = GetParam() == Backend::kFused;
  if (!is_fused) {
    SKEIN_SKIP_WITHOUT_LIBTORCH();
  }
  TrainConfig config = SmallConfig();
  config.network.hidden_size = 20;
  config.network.gru_layers = 2;
  config.network.gru_size = 11;
  config.network.activation = is_fused ? Activation::kRelu : Activation::kTanh;
  WorkerPool pool(1);
  EXPECT_EQ(Trainer(config, pool).backend().backend, GetParam());
  ExpectToResumeBitExactly(config);
}

INSTANTIATE_TEST_SUITE_P(Backends, TrainerBackendTest,
                         testing::Values(Backend::kFused, Backend::kLibTorch),
                         [](const auto& backend) { return Name(backend.param); });

TEST_F(TrainerTest, WhatWidensAndWhatGrowsResumesBitExactly) {
  WorkerPool pool(2);
  TrainConfig config = SmallConfig();
  config.env.plant.mass = {0.8, 1.2};
  config.env.observation_noise_max = 0.1;
  config.env.wind.speed_fps.max = 100;
  config.ppo.condition_ramp = 0.9;
  config.env.reward.near_roll_rate = config.env.reward.action_change = 0.1;
  config.ppo.action_smoothness_coefficient = 0.1;
  config.ppo.handling_ramp = 0.9;
  config.env.mission.training_length_s = 4;
  config.env.mission.training_time_limit_s = 0.4;
  config.ppo.time_limit_ramp = 0.9;
  Trainer whole(config, pool);
  whole.Iterate();
  whole.Save(path_);
  Trainer resumed(config, pool);
  resumed.Restore(path_);
  while (!whole.finished()) {
    whole.Iterate();
    resumed.Iterate();
    EXPECT_EQ(resumed.Signature(), whole.Signature());
  }
}

TEST_F(TrainerTest, AMissionThatIsFlownToItsEndIsASuccess) {
  WorkerPool pool(2);
  TrainConfig config = SmallConfig();
  config.env.mission.training_length_s = 0.4;
  Trainer trainer(config, pool);
  const IterationReport report = trainer.Iterate();
  ASSERT_GT(report.episodes, 0);
  EXPECT_EQ(report.terminations[static_cast<int>(Termination::kTimeLimit)], report.episodes);
  EXPECT_EQ(report.success_rate, 1);
}

TEST_F(TrainerTest, RefusesMoreMinibatchesThanChunks) {
  TrainConfig config = SmallConfig();
  config.ppo.minibatches = 1000;
  WorkerPool pool(1);
  EXPECT_THROW(Trainer(config, pool), Error);
}

TEST_F(TrainerTest, RefusesToPriceChangesThatNoChunkShows) {
  TrainConfig config = SmallConfig();
  config.ppo.action_smoothness_coefficient = 1;
  config.ppo.chunk_length = 1;
  WorkerPool pool(1);
  EXPECT_THROW(Trainer(config, pool), Error);
}

}  // namespace
}  // namespace skein
