// SPDX-License-Identifier: Apache-2.0
// Runs trainings of several processes as a user does, with mpirun; skipped where there is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <sstream>
#include <thread>

#include "base/reason_of.h"
#include "simd/target.h"
#include "src/bench/version.h"
#include "src/files/output_file.h"
#include "src/run/run_directory.h"
#include "tests/sanitizers.h"
#include "tests/src/ranks_fixture.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> kShards = {"--set", "learner.shards=8", "--threads", "1"};

/// What a process has used so far; 0 once it has ended.
double ProcessorSeconds(pid_t process) {
  try {
    std::istringstream text(ReadFile("/proc/" + std::to_string(process) + "/stat"));
    std::string word;
    double user = 0, system = 0;
    for (int field = 1; field <= 13; ++field) text >> word;
    text >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  } catch (const Error&) {
    return 0;
  }
}

class RanksPipeline : public RanksFixture {
 protected:
  void ExpectSameRun(const std::string& a, const std::string& b) {
    for (const char* file :
         {"/metrics.csv", "/checkpoints/checkpoint-000012.skein", "/checkpoints/policy-final.skein",
          "/checkpoints/policy-best.skein", "/config.toml"}) {
      ExpectSameFile(a + file, b + file);
    }
  }

  /// evaluation.json but for the path of the policy.
  static std::string EvaluationOf(const std::string& run) {
    std::string text = ReadFile(run + "/evaluation.json");
    const std::size_t path = text.find(run);
    return path == std::string::npos ? text : text.replace(path, run.size(), "RUN");
  }

  /// Of ranks that `script` starts: "$@" is their program with its arguments.
  static std::vector<std::string> MpirunByShell(int count,
                                                const std::vector<std::string>& arguments,
                                                const std::string& script) {
    std::vector<std::string> words = Mpirun(count, arguments);
    const std::vector<std::string> shell = {"sh", "-c", script, "sh"};
    words.insert(std::find(words.begin(), words.end(), SKEIN_PROGRAM), shell.begin(), shell.end());
    return words;
  }

  /// A copy of the program with as many question marks in place of `text`, wherever it is in the
  /// file.
  std::string CopyWithout(const std::string& text) {
    std::string bytes = ReadFile(SKEIN_PROGRAM);
    for (std::size_t at = 0; (at = bytes.find(text, at)) != std::string::npos;) {
      bytes.replace(at, text.size(), text.size(), '?');
    }
    const std::string copy = scratch_ / "skein";
    WriteFile(copy, bytes);
    fs::permissions(copy, fs::perms::owner_all);
    return copy;
  }

  /// A training of two ranks, of which one does not get the memory that it asks for for the time
  /// `at`; 0: always does, and leaves in calls_ how often it asks (tests/src/faults/).
  ProgramResult TrainWithoutMemory(int rank, long at, int iterations = kIterations) {
    fs::remove_all(run_);
    const std::string script =
        "[ $OMPI_COMM_WORLD_RANK = " + std::to_string(rank) + " ] || exec \"$@\"; exec env " +
        "LD_PRELOAD='" SKEIN_FAILING_CALLS "' SKEIN_FAULT=m SKEIN_FAULT_AT=" + std::to_string(at) +
        " SKEIN_FAULT_RECORD='" + calls_ + "' \"$@\"";
    std::vector<std::string> arguments = TinyTraining(run_, kShards);
    arguments.insert(arguments.end(), {"--steps", std::to_string(iterations * kStepsPerIteration)});
    return RunWords(MpirunByShell(2, arguments, script));
  }

  /// How often rank 1 of two asks for memory.
  long AllocationsIn(int iterations) {
    EXPECT_EQ(TrainWithoutMemory(1, 0, iterations).exit_code, 0);
    const std::string counted = ReadFile(calls_);  // "allocations N"
    return std::stol(counted.substr(counted.find(' ')));
  }

  static bool LogSays(const std::string& run, const std::string& words) {
    return fs::exists(run + "/log.txt") &&
           ReadFile(run + "/log.txt").find(words) != std::string::npos;
  }

  std::string reference_ = scratch_ / "reference", run_ = scratch_ / "run";
  const std::string calls_ = scratch_ / "calls";
};

TEST_F(RanksPipeline, LeaveTheSameFilesAsOneProcess) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  for (const int count : {2, 4, 8}) {
    const std::string run = run_ + std::to_string(count);
    const ProgramResult result = RunWords(Mpirun(count, TinyTraining(run, kShards)));
    ASSERT_EQ(result.exit_code, 0) << result.error;
    ExpectSameRun(reference_, run);
    EXPECT_EQ(EvaluationOf(run), EvaluationOf(reference_)) << "the final one, too, is shared out";
    EXPECT_THAT(result.output, HasSubstr(std::to_string(count) + " ranks"));
    EXPECT_EQ(result.output.find("training heading"), result.output.rfind("training heading"))
        << "rank 0 alone speaks";
  }
}

TEST_F(RanksPipeline, LeaveTheSameFilesAsOneProcessOverTcp) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  const ProgramResult result = RunWords(Mpirun(4, TinyTraining(run_, kShards), std::nullopt, kTcp));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameRun(reference_, run_);
}

TEST_F(RanksPipeline, TrainAsOneProcessOfThirtyTwoShardsUnlessAskedForOthers) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, {"--set", "learner.shards=32"})).exit_code, 0);
  const ProgramResult result = RunWords(Mpirun(2, TinyTraining(run_, {"--threads", "1"})));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("2 ranks, 16 of 32 shards each"));
  ExpectSameRun(reference_, run_);
}

/// Networks so large that more than two ranks sum their gradients part by part.
TEST_F(RanksPipeline, LeaveTheSameFilesAsOneProcessOfLargerNetworksToo) {
  std::vector<std::string> arguments = kShards;
  arguments.insert(arguments.end(),
                   {"--set", "network.hidden_size=64", "--set", "network.gru_size=64"});
  ASSERT_EQ(RunSkein(TinyTraining(reference_, arguments)).exit_code, 0);
  const ProgramResult result = RunWords(Mpirun(4, TinyTraining(run_, arguments)));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameRun(reference_, run_);
}

TEST(RanksFixture, LeavesTheSanitizerTheCallersOptions) {
  EXPECT_EQ(AsanOptionsOfRanks(nullptr), "ASAN_OPTIONS=detect_leaks=0");
  EXPECT_EQ(AsanOptionsOfRanks("log_path=a:verbosity=1"),
            "ASAN_OPTIONS=log_path=a:verbosity=1:detect_leaks=0");
}

TEST_F(RanksPipeline, EveryRankHasTheSanitizersOptions) {
  RunningProgram training(ProgramWords{Mpirun(2, TinyTraining(run_, kShards))});
  ASSERT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
  const std::vector<pid_t> ranks = ProcessesOf(run_);
  ASSERT_EQ(ranks.size(), 2u);
  const std::string options = AsanOptionsOfRanks(std::getenv("ASAN_OPTIONS"));
  for (const pid_t rank : ranks) {
    EXPECT_THAT(ReadFile("/proc/" + std::to_string(rank) + "/environ"), HasSubstr(options));
  }
  EXPECT_EQ(training.Wait().exit_code, 0);
}

TEST_F(RanksPipeline, ASignalToOneRankStopsAllAndTheRunGoesOnWithAnyNumber) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  RunningProgram training(ProgramWords{Mpirun(4, TinyTraining(run_, kShards))});
  ASSERT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, 3); }));
  const std::vector<pid_t> ranks = ProcessesOf(run_);
  ASSERT_EQ(ranks.size(), 4u);
  kill(ranks.back(), SIGTERM);
  const ProgramResult stopped = training.Wait();
  EXPECT_EQ(stopped.exit_code, 0) << stopped.error;
  EXPECT_THAT(stopped.output, HasSubstr("stopped by SIGTERM"));
  EXPECT_EQ(stopped.output.find("stopped by"), stopped.output.rfind("stopped by")) << "once";
  const ProgramResult resumed = RunWords(Mpirun(2, {"train", "--resume", run_, "--threads", "1"}));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  ExpectSameRun(reference_, run_);
}

TEST_F(RanksPipeline, ASignalToOneRankInTheFinalEvaluationKeepsWhatWasTrained) {
  std::vector<std::string> arguments = TinyTraining(run_, kShards);
  arguments.insert(arguments.end(), {"--set", "evaluation.final_episodes=30000"});
  RunningProgram training(ProgramWords{Mpirun(2, arguments)});
  ASSERT_TRUE(training.WaitUntil([&] { return LogSays(run_, "fresh episodes"); }));
  const std::vector<pid_t> ranks = RanksOf(run_);
  ASSERT_EQ(ranks.size(), 2u);
  kill(ranks[1], SIGTERM);
  const ProgramResult stopped = training.Wait();
  EXPECT_EQ(stopped.exit_code, 0) << stopped.error;
  EXPECT_THAT(stopped.output, HasSubstr("stopped by SIGTERM"));
  EXPECT_THAT(stopped.output, HasSubstr("dropped the evaluation"));
  EXPECT_FALSE(fs::exists(run_ + "/evaluation.json"));
  const ProgramResult resumed = RunWords(Mpirun(2, {"train", "--resume", run_, "--threads", "1"}));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.error;
  EXPECT_TRUE(fs::exists(run_ + "/evaluation.json"));
}

TEST_F(RanksPipeline, ASignalToTheLauncherSavesOnce) {
  std::vector<std::string> arguments = TinyTraining(run_, kShards);
  arguments.insert(arguments.end(),
                   {"--steps", "1e12", "--set", "checkpoint.interval_iterations=0"});
  std::vector<std::string> words = Mpirun(2, arguments);
  // How many seconds mpirun waits before it asks ranks to end, and again before it kills them.
  words.insert(words.begin() + 1, {"--mca", "odls_base_sigkill_timeout", "5"});
  RunningProgram training(ProgramWords{words});
  ASSERT_TRUE(training.WaitUntil([&] {
    return fs::exists(run_ + "/metrics.csv") &&
           ReadFile(run_ + "/metrics.csv").find("\n2,") != std::string::npos;
  }));
  training.Signal(SIGTERM);
  training.Wait();
  EXPECT_TRUE(ProcessesOf(run_).empty());
  EXPECT_TRUE(LogSays(run_, "stopped by SIGTERM"));
  const std::vector<Checkpoint> saved = CheckpointsIn(run_ + "/checkpoints");
  ASSERT_EQ(saved.size(), 1u);
  const std::string metrics = ReadFile(run_ + "/metrics.csv");
  EXPECT_EQ(static_cast<std::uint64_t>(std::count(metrics.begin(), metrics.end(), '\n')),
            1 + saved[0].iteration)
      << "everything flown is saved";
}

TEST_F(RanksPipeline, ARankThatIsAskedToSaveHasItSavedOnce) {
  std::vector<std::string> arguments = TinyTraining(run_, kShards);
  arguments.insert(arguments.end(), {"--set", "checkpoint.interval_iterations=0"});
  RunningProgram training(ProgramWords{Mpirun(2, arguments)});
  ASSERT_TRUE(training.WaitUntil([&] {
    if (!fs::exists(run_ + "/metrics.csv")) return false;
    const std::string rows = ReadFile(run_ + "/metrics.csv");
    return std::count(rows.begin(), rows.end(), '\n') > 2;
  }));
  const std::vector<pid_t> ranks = ProcessesOf(run_);
  ASSERT_EQ(ranks.size(), 2u);
  kill(ranks.back(), SIGUSR1);
  ASSERT_EQ(training.Wait().exit_code, 0);
  const std::string log = ReadFile(run_ + "/log.txt");
  EXPECT_THAT(log, HasSubstr("as asked"));
  EXPECT_EQ(log.find("as asked"), log.rfind("as asked"));
}

TEST_F(RanksPipeline, AKilledRankEndsTheJobAndOneProcessGoesOn) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  RunningProgram training(ProgramWords{Mpirun(4, TinyTraining(run_, kShards))});
  ASSERT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, 3); }));
  const std::vector<pid_t> ranks = ProcessesOf(run_);
  ASSERT_EQ(ranks.size(), 4u);
  kill(ranks[1], SIGKILL);
  EXPECT_NE(training.Wait().exit_code, 0);
  EXPECT_TRUE(ProcessesOf(run_).empty());
  ASSERT_EQ(RunSkein({"train", "--resume", run_}).exit_code, 0);
  ExpectSameRun(reference_, run_);
}

TEST_F(RanksPipeline, AHungRankIsNamedAndEndsTheJob) {
  std::vector<std::string> arguments = TinyTraining(run_, kShards);
  arguments.insert(arguments.end(), {"--rank-timeout", "12", "--steps", "1e12"});
  RunningProgram training(ProgramWords{Mpirun(4, arguments)});
  ASSERT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
  const std::vector<pid_t> ranks = RanksOf(run_);
  ASSERT_EQ(ranks.size(), 4u);
  // Rank 1 is late, and waits for the one that hangs for the rest of the time.
  kill(ranks[2], SIGSTOP);
  kill(ranks[1], SIGSTOP);
  std::this_thread::sleep_for(std::chrono::seconds(7));
  kill(ranks[1], SIGCONT);
  const ProgramResult result = training.Wait();
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("): rank 2 ("));
  EXPECT_THAT(result.error, HasSubstr(") has not answered for 12 s"));
  EXPECT_THAT(result.error, Not(HasSubstr(" or rank "))) << "no other is named";
  EXPECT_TRUE(ProcessesOf(run_).empty());
}

TEST_F(RanksPipeline, ARankThatHangsInTheFinalEvaluationIsNamedAndEndsTheJob) {
  std::vector<std::string> arguments = TinyTraining(run_, kShards);
  arguments.insert(arguments.end(),
                   {"--set", "evaluation.final_episodes=30000", "--rank-timeout", "8"});
  RunningProgram training(ProgramWords{Mpirun(2, arguments)});
  ASSERT_TRUE(training.WaitUntil([&] { return LogSays(run_, "fresh episodes"); }));
  const std::vector<pid_t> ranks = RanksOf(run_);
  ASSERT_EQ(ranks.size(), 2u);
  kill(ranks[1], SIGSTOP);
  const ProgramResult result = training.Wait();
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("): rank 1 ("));
  EXPECT_THAT(result.error, HasSubstr(") has not answered for 8 s"));
  EXPECT_TRUE(ProcessesOf(run_).empty());
}

TEST_F(RanksPipeline, ARankThatHangsWhileRanksStartEndsTheJob) {
  std::vector<std::string> arguments = TinyTraining(run_, kShards);
  arguments.insert(arguments.end(), {"--rank-timeout", "2"});
  RunningProgram training(ProgramWords{Mpirun(4, arguments)});
  ASSERT_TRUE(training.WaitUntil([&] { return !ProcessesOf(run_).empty(); }));
  kill(ProcessesOf(run_).front(), SIGSTOP);
  const ProgramResult result = training.Wait();
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("2 s (--rank-timeout) while ranks start"));
  EXPECT_TRUE(ProcessesOf(run_).empty());
}

TEST_F(RanksPipeline, ALauncherThatIsKilledWhileRanksStartLeavesNone) {
  for (const int delay_ms : {0, 10, 20, 40, 80, 160}) {
    RunningProgram training(ProgramWords{Mpirun(4, TinyTraining(run_, kShards))});
    ASSERT_TRUE(training.WaitUntil([&] { return !ProcessesOf(run_).empty(); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    training.Signal(SIGKILL);
    training.Wait();
    EXPECT_TRUE(AllEnd(run_)) << "after " << delay_ms << " ms";
    fs::remove_all(run_);
  }
}

TEST_F(RanksPipeline, ALauncherThatIsKilledLeavesNoRankAndOneProcessGoesOn) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  RunningProgram training(ProgramWords{Mpirun(2, TinyTraining(run_, kShards))});
  ASSERT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
  training.Signal(SIGKILL);
  training.Wait();
  ASSERT_TRUE(AllEnd(run_));
  const ProgramResult resumed = RunSkein({"train", "--resume", run_, "--threads", "1"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  ExpectSameRun(reference_, run_);
}

TEST_F(RanksPipeline, ARankWithoutMemorySaysSoAndEndsTheJob) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers have allocators of their own";
  // Behind those of a training of one iteration: not while it starts.
  const long first = AllocationsIn(1), more = AllocationsIn(kIterations) - first;
  ASSERT_GT(more, 0);
  for (const int rank : {0, 1}) {
    for (const int quarter : {1, 2, 3}) {
      SCOPED_TRACE("rank " + std::to_string(rank) + ", quarter " + std::to_string(quarter));
      // Rank 0 has some more for files, and as many as the other while they train.
      const ProgramResult result = TrainWithoutMemory(rank, first + more * quarter / 4);
      EXPECT_NE(result.exit_code, 0);
      EXPECT_THAT(result.error, HasSubstr(ReasonOf(std::bad_alloc())));
      EXPECT_THAT(result.error, HasSubstr(rank == 1 ? "rank 1 (" : ""));
      EXPECT_THAT(result.error, Not(HasSubstr("MPI_ERR"))) << "at the wrong exchange";
      EXPECT_THAT(result.error, Not(HasSubstr("has not answered")));
      EXPECT_TRUE(ProcessesOf(run_).empty());
    }
  }
}

TEST_F(RanksPipeline, RanksThatComputeDifferentlyAreRefusedAndNamed) {
  if (simd::ActiveTarget() == simd::Target::kScalar) GTEST_SKIP() << "needs another SIMD target";
  const ProgramResult result =
      RunWords(Mpirun(2, TinyTraining(run_, kShards), LastRank{"SKEIN_SIMD=scalar"}));
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("ranks differ in what they train with"));
  EXPECT_THAT(result.error, HasSubstr("rank 1 ("));
  EXPECT_FALSE(fs::exists(run_));
}

TEST_F(RanksPipeline, ARankOfAnotherCommitIsRefusedAndNamed) {
  const std::string other = CopyWithout(Build().commit);
  const ProgramResult result =
      RunWords(Mpirun(2, TinyTraining(run_, kShards), LastRank{"", other}));
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("ranks differ in what they train with"));
  EXPECT_THAT(result.error, HasSubstr("of commit ???"));
  EXPECT_FALSE(fs::exists(run_));
}

TEST_F(RanksPipeline, ARankOfAnotherVersionLoadsNoModuleAndEndsTheJob) {
  const std::string other = CopyWithout(std::string(Build().version) + " (");
  const ProgramResult result =
      RunWords(Mpirun(2, TinyTraining(run_, kShards), LastRank{"", other}));
  EXPECT_NE(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("is of another build than ???"));
  EXPECT_FALSE(fs::exists(run_));
}

TEST_F(RanksPipeline, NumbersThatAreNotPossibleAreRefused) {
  const ProgramResult three = RunWords(Mpirun(3, TinyTraining(run_, kShards)));
  EXPECT_EQ(three.exit_code, 2);
  EXPECT_THAT(three.error, HasSubstr("a power of two"));
  const ProgramResult unsharded =
      RunWords(Mpirun(2, TinyTraining(run_, {"--threads", "1", "--set", "learner.shards = 1"})));
  EXPECT_EQ(unsharded.exit_code, 2);
  EXPECT_THAT(unsharded.error, HasSubstr("learner.shards = 1 cannot be done by 2 ranks"));
  EXPECT_THAT(unsharded.error, HasSubstr("--set learner.shards=2"));
  const ProgramResult wrong = RunWords(Mpirun(2, {"train", "heading", "--set", "ppo.gamma=2"}));
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.error.find("ppo.gamma = 2"), wrong.error.rfind("ppo.gamma = 2")) << "said once";
}

TEST_F(RanksPipeline, ADirectoryThatRankZeroCannotMakeStopsAll) {
  const ProgramResult result = RunWords(Mpirun(2, TinyTraining("/dev/full/run", kShards)));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.error, HasSubstr("/dev/full/run"));
}

TEST_F(RanksPipeline, TheFinalEvaluationHasAsManyEpisodesAsRankZeroAsksFor) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  const ProgramResult result = RunWords(MpirunByShell(
      2, TinyTraining(run_, kShards),
      "exec \"$@\" --set evaluation.final_episodes=$((32 + 16 * OMPI_COMM_WORLD_RANK))"));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_EQ(EvaluationOf(run_), EvaluationOf(reference_));
}

TEST_F(RanksPipeline, AFullDiskAtRankZeroStopsAllAndLosesNothing) {
  ASSERT_EQ(RunSkein(TinyTraining(reference_, kShards)).exit_code, 0);
  // A write beyond a limit then fails, and does not kill.
  RunningProgram training(
      ProgramWords{MpirunByShell(2, TinyTraining(run_, kShards), "trap '' XFSZ; exec \"$@\"")});
  std::vector<pid_t> ranks;
  ASSERT_TRUE(training.WaitUntil([&] { return (ranks = RanksOf(run_)).size() == 2; }));
  ASSERT_TRUE(training.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
  // As a disk that fills up.
  const rlimit limit{8192, 8192};
  ASSERT_EQ(prlimit(ranks[0], RLIMIT_FSIZE, &limit, nullptr), 0);
  const ProgramResult full = training.Wait();
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.error, HasSubstr("skein: error: " + run_));
  EXPECT_THAT(full.error, HasSubstr("cannot be written: File too large"));
  EXPECT_TRUE(ProcessesOf(run_).empty());
  const ProgramResult resumed = RunSkein({"train", "--resume", run_, "--threads", "1"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  ExpectSameRun(reference_, run_);
}

TEST_F(RanksPipeline, RanksThatWaitForRankZeroAtTheEndSleep) {
  // Rank 0 alone records flights.
  const std::string word = scratch_ / "flights.csv";
  RunningProgram evaluation(ProgramWords{
      Mpirun(2, {"eval", "--policy", "untrained", "--task", "heading", "--episodes", "200",
                 "--flights", word, "--flights-count", "200", "--threads", "1"})});
  double used_s[2] = {};
  evaluation.WaitUntil([&] {
    const std::vector<pid_t> ranks = RanksOf(word);
    for (std::size_t rank = 0; rank < ranks.size() && ranks.size() == 2; ++rank) {
      used_s[rank] = std::max(used_s[rank], ProcessorSeconds(ranks[rank]));
    }
    return false;
  });
  EXPECT_EQ(evaluation.Wait().exit_code, 0);
  EXPECT_GT(used_s[0], 0);
  EXPECT_LT(used_s[1], used_s[0] / 2);
}

TEST(PlainStart, LoadsNoMpi) {
  const ScratchDirectory scratch;
  const ProgramResult result = RunSkein(TinyTraining(scratch / "run", {"--threads", "1"}),
                                        [] { setenv("LD_DEBUG", "libs", 1); });
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("libc.so")) << "the loader says what it does";
  EXPECT_THAT(result.error, Not(HasSubstr("libmpi")));
  EXPECT_THAT(result.error, Not(HasSubstr("libskein_mpi")));
}

TEST(PlainStart, OfSeveralProcessesBySrunWithoutPmixIsWarnedOf) {
  const ScratchDirectory scratch;
  const ProgramResult result = RunSkein(TinyTraining(scratch / "run", {"--threads", "1"}),
                                        [] { setenv("SLURM_STEP_NUM_TASKS", "4", 1); });
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("srun --mpi=pmix"));
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
}

}  // namespace
}  // namespace skein
