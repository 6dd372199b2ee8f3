// SPDX-License-Identifier: Apache-2.0
// Many ranks, and ranks that die at any moment: what takes minutes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <random>
#include <thread>

#include "base/seconds_since.h"
#include "tests/src/ranks_fixture.h"
#include "tests/src/run_program.h"
#include "tests/src/training_fixture.h"

namespace skein {
namespace {

using Clock = std::chrono::steady_clock;

const std::vector<std::string> kShards = {"--set", "learner.shards=16", "--threads", "1"};

class ManyRanks : public RanksFixture {
 protected:
  /// Kills one of `count` ranks after `delay_s`, or none if they have ended by then, and returns
  /// once the job has.
  void TrainAndKill(int count, double delay_s, std::mt19937* random) {
    const Clock::time_point start = Clock::now();
    RunningProgram training(ProgramWords{Mpirun(count, TinyTraining(run_, kShards))});
    training.WaitUntil([&] { return SecondsSince(start) > delay_s; });
    const std::vector<pid_t> ranks = ProcessesOf(run_);
    if (!ranks.empty()) kill(ranks[(*random)() % ranks.size()], SIGKILL);
    const Clock::time_point killed = Clock::now();
    training.Wait();
    // mpirun may end a moment before the system has put away what it killed.
    const auto is_left = [](pid_t rank) { return kill(rank, 0) == 0; };
    while (std::any_of(ranks.begin(), ranks.end(), is_left) && SecondsSince(killed) < kTimeout_s) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_LT(SecondsSince(killed), kTimeout_s) << "the job, or a rank, is left";
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
  }

  /// Goes on by one process, or begins if the job was killed before it had made its run.
  void Finish() {
    const bool has_begun = std::filesystem::exists(run_ + "/config.toml");
    if (!has_begun) std::filesystem::remove_all(run_);
    const ProgramResult result =
        RunSkein(has_begun ? std::vector<std::string>{"train", "--resume", run_, "--threads", "1"}
                           : TinyTraining(run_, kShards));
    EXPECT_EQ(result.exit_code, 0) << result.error;
  }

  static constexpr double kTimeout_s = 60;
  std::string reference_ = scratch_ / "reference", run_ = scratch_ / "run";
};

TEST_F(ManyRanks, ThirtyKillsAtAnyMomentLoseNothing) {
  constexpr int kKills = 30;
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  const Clock::time_point start = Clock::now();
  ASSERT_EQ(RunWords(Mpirun(4, TinyTraining(run_, kShards))).exit_code, 0);
  const double whole_s = SecondsSince(start);
  std::mt19937 random(1);
  for (int trial = 0; trial < kKills; ++trial) {
    SCOPED_TRACE(trial);
    std::filesystem::remove_all(run_);
    const double share = std::uniform_real_distribution<>(0, 1)(random);
    TrainAndKill(trial % 2 == 0 ? 4 : 2, share * whole_s, &random);
    Finish();
    ExpectSameRun(reference_, run_);
  }
}

TEST_F(ManyRanks, TenKilledLaunchersLoseNothing) {
  constexpr int kKills = 10;
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  std::mt19937 random(2);
  for (int trial = 0; trial < kKills; ++trial) {
    SCOPED_TRACE(trial);
    std::filesystem::remove_all(run_);
    RunningProgram training(
        ProgramWords{Mpirun(trial % 2 == 0 ? 4 : 2, TinyTraining(run_, kShards))});
    // Any checkpoint but the last, and a moment more.
    const std::uint64_t iteration = 1 + random() % (kIterations - 1);
    training.WaitUntil([&] { return HasCheckpoint(run_, iteration); });
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 50));
    training.Signal(SIGKILL);
    training.Wait();
    ASSERT_TRUE(AllEnd(run_));
    Finish();
    ExpectSameRun(reference_, run_);
  }
}

TEST_F(ManyRanks, AJobThatStoodStillLongerThanTheTimeoutGoesOn) {
  std::vector<std::string> arguments = TinyTraining(run_, kShards);
  arguments.insert(arguments.end(), {"--rank-timeout", "12", "--steps", "1e12"});
  RunningProgram training(ProgramWords{Mpirun(2, arguments)});
  ASSERT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
  const std::vector<pid_t> ranks = RanksOf(run_);
  ASSERT_EQ(ranks.size(), 2u);
  const auto send = [&](int rank, int signal) {
    kill(ranks[static_cast<std::size_t>(rank)], signal);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  };
  // Rank 0 waits for the other by the time it is stopped, and is the first to go on.
  for (const int rank : {1, 0}) send(rank, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::seconds(13));
  const std::uint64_t before = CheckpointsIn(run_ + "/checkpoints").back().iteration;
  for (const int rank : {0, 1}) send(rank, SIGCONT);
  EXPECT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, before + 2); }));
  training.Signal(SIGKILL);
  training.Wait();
  EXPECT_TRUE(AllEnd(run_));
}

TEST_F(ManyRanks, SixteenAreOneInEveryPrecision) {
  for (const char* precision : {"fp32", "mixed", "bf16", "fast", "amx"}) {
    SCOPED_TRACE(precision);
    std::vector<std::string> more = kShards;
    more.insert(more.end(), {"--set", std::string("learner.precision=") + precision});
    const std::string alone = reference_ + precision, together = run_ + precision;
    ASSERT_EQ(RunSkein(TinyTraining(alone, more)).exit_code, 0);
    const ProgramResult result = RunWords(Mpirun(16, TinyTraining(together, more)));
    ASSERT_EQ(result.exit_code, 0) << result.error;
    ExpectSameRun(alone, together);
  }
}

TEST_F(ManyRanks, ARunGoesOnByAnyNumberOfThem) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  for (const std::vector<int>& counts : {std::vector<int>{8, 2, 1}, {1, 4}}) {
    SCOPED_TRACE(::testing::PrintToString(counts));
    std::filesystem::remove_all(run_);
    std::vector<std::string> words = TinyTraining(run_, kShards);
    for (std::size_t part = 0; part < counts.size(); ++part) {
      RunningProgram training(ProgramWords{Mpirun(counts[part], words)});
      if (part + 1 < counts.size()) {
        const std::uint64_t enough = kIterations * (part + 1) / counts.size();
        ASSERT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, enough); }));
        const std::vector<pid_t> ranks = ProcessesOf(run_);
        ASSERT_EQ(ranks.size(), static_cast<std::size_t>(counts[part]));
        kill(ranks.back(), SIGTERM);
      }
      const ProgramResult result = training.Wait();
      ASSERT_EQ(result.exit_code, 0) << result.error;
      EXPECT_EQ(result.output.find("stopped by SIGTERM") == std::string::npos,
                part + 1 == counts.size());
      words = {"train", "--resume", run_, "--threads", "1"};
    }
    ExpectSameRun(reference_, run_);
  }
}

TEST_F(ManyRanks, HighLevelPoliciesTrainOverALowLevelPolicyAsByOne) {
  const std::string control = scratch_ / "control";
  ASSERT_EQ(RunSkein(TinyTrainingOf("control", control, {"--steps", "10240"})).exit_code, 0);
  std::vector<std::string> more = kShards;
  more.insert(more.end(), {"--preset", "planner", "--low-level", control, "--steps",
                           std::to_string(2 * kStepsPerIteration * kIterations), "--set",
                           "env.action_repeat=10"});
  ASSERT_EQ(RunSkein(TinyTrainingOf("tracking", reference_, more)).exit_code, 0);
  for (const int count : {2, 4, 8, 16}) {
    SCOPED_TRACE(count);
    const std::string together = run_ + std::to_string(count);
    const ProgramResult result =
        RunWords(Mpirun(count, TinyTrainingOf("tracking", together, more)));
    ASSERT_EQ(result.exit_code, 0) << result.error;
    ExpectSameRun(reference_, together);
  }
}

}  // namespace
}  // namespace skein
