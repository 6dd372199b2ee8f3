// SPDX-License-Identifier: Apache-2.0
// Runs evaluations, comparisons and studies on several processes as a user does, with mpirun.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "simd/target.h"
#include "tests/src/ranks_fixture.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

const std::vector<std::string> kShort = {"--task",     "heading",
                                         "--set",      "env.time_limit_steps=150",
                                         "--set",      "env.heading.earliest_success_step=100",
                                         "--episodes", "301",
                                         "--threads",  "1"};

/// Two levels and three seeds, in trainings of some iterations.
const char* const kStudy = R"(
tasks = ["heading"]
seeds = [3, 4, 5]
agents = ["zero", "autopilot"]
set = ["env.time_limit_steps=100", "env.heading.earliest_success_step=100"]

[training]
steps = 40960
set = ["ppo.num_aircraft=64", "ppo.rollout_steps=16", "ppo.chunk_length=8", "ppo.minibatches=2",
       "network.hidden_size=16", "network.gru_size=16", "evaluation.interval_iterations=2",
       "evaluation.episodes=8", "evaluation.final_episodes=8", "checkpoint.interval_iterations=1"]

[evaluation]
episodes = 21
seed = 5

[[level]]
name = "quiet"
[[level]]
name = "loud"
condition = ["noisy=0.1"]
)";

class RanksStudy : public RanksFixture {
 protected:
  RanksStudy() { WriteFile(file_, kStudy); }

  /// Runs the command with --json (and --csv) on one process and on `count`, and expects the same
  /// words and files.
  void ExpectSame(int count, std::vector<std::string> command,
                  const std::vector<std::string>& outputs) {
    command.insert(command.end(), kShort.begin(), kShort.end());
    std::vector<std::string> alone = command, together = command;
    for (const std::string& output : outputs) {
      alone.insert(alone.end(), {"--" + output, scratch_ / ("alone." + output)});
      together.insert(together.end(), {"--" + output, scratch_ / ("together." + output)});
    }
    const ProgramResult expected = RunSkein(alone);
    ASSERT_EQ(expected.exit_code, 0) << expected.error;
    const ProgramResult result = RunWords(Mpirun(count, together));
    ASSERT_EQ(result.exit_code, 0) << result.error;
    EXPECT_EQ(result.output, expected.output);
    for (const std::string& output : outputs) {
      ExpectSameFile(scratch_ / ("alone." + output), scratch_ / ("together." + output));
    }
  }

  std::vector<std::string> Study(const std::string& out) const {
    return {"study", file_, "--out", out, "--threads", "1"};
  }

  void ExpectSameStudy(const std::string& a, const std::string& b) {
    for (const char* file : {"/results.csv", "/results.json", "/comparisons/heading-quiet.json",
                             "/comparisons/heading-loud.json"}) {
      ExpectSameFile(a + file, b + file);
    }
    for (const std::string level : {"quiet", "loud"}) {
      for (const std::string seed : {"3", "4", "5"}) {
        const std::string run = "/runs/heading-" + level + "-seed" + seed;
        for (const char* file : {"/metrics.csv", "/checkpoints/policy-final.skein"}) {
          ExpectSameFile(a + run + file, b + run + file);
        }
      }
    }
  }

  const std::string file_ = scratch_ / "small.toml";
  const std::string alone_ = scratch_ / "alone", together_ = scratch_ / "together";
};

TEST_F(RanksStudy, EvaluationsAreThoseOfOneProcess) {
  for (const std::string agent : {"untrained", "autopilot", "random"}) {
    for (const int count : {2, 4}) ExpectSame(count, {"eval", "--policy", agent}, {"json"});
  }
}

TEST_F(RanksStudy, ComparisonsAreThoseOfOneProcess) {
  for (const int count : {2, 4}) {
    ExpectSame(count,
               {"compare", "--agents", "autopilot,random,policy:untrained@sampled", "--no-html"},
               {"json", "csv"});
  }
}

TEST_F(RanksStudy, StudiesLeaveTheFilesOfOneProcess) {
  const ProgramResult expected = RunSkein(Study(alone_));
  ASSERT_EQ(expected.exit_code, 0) << expected.error;
  for (const int count : {2, 4}) {
    const std::string out = together_ + std::to_string(count);
    const ProgramResult result = RunWords(Mpirun(count, Study(out)));
    ASSERT_EQ(result.exit_code, 0) << result.error;
    ExpectSameStudy(alone_, out);
    // The tables, and who trained what.
    const std::string table = expected.output.substr(expected.output.rfind("heading, quiet"));
    EXPECT_THAT(result.output, HasSubstr(table.substr(0, table.find("results  "))));
    EXPECT_THAT(result.output, HasSubstr("training 1 of 6 on rank "));
    EXPECT_THAT(result.output, HasSubstr("training 6 of 6 on rank "));
  }
}

TEST_F(RanksStudy, AStopOfOneRankSavesAllAndOneProcessGoesOn) {
  ASSERT_EQ(RunSkein(Study(alone_)).exit_code, 0);
  RunningProgram study(ProgramWords{Mpirun(4, Study(together_))});
  ASSERT_TRUE(
      study.WaitUntil([&] { return HasCheckpoint(together_ + "/runs/heading-quiet-seed3", 1); }));
  const std::vector<pid_t> ranks = ProcessesOf(together_);
  ASSERT_EQ(ranks.size(), 4u);
  kill(ranks.back(), SIGTERM);
  const ProgramResult stopped = study.Wait();
  EXPECT_EQ(stopped.exit_code, 0) << stopped.error;
  EXPECT_THAT(stopped.output, HasSubstr("stopped; resume with: " SKEIN_PROGRAM " study " + file_));
  EXPECT_FALSE(fs::exists(together_ + "/results.json"));
  EXPECT_TRUE(ProcessesOf(together_).empty());
  ASSERT_EQ(RunSkein(Study(together_)).exit_code, 0);
  ExpectSameStudy(alone_, together_);
}

TEST_F(RanksStudy, ATrainingThatFailsEndsTheJobInOneLine) {
  fs::create_directories(together_ + "/comparisons");
  fs::create_directories(together_ + "/runs");
  WriteFile(together_ + "/runs/heading-quiet-seed4", "in the way");
  const ProgramResult result = RunWords(Mpirun(2, Study(together_)));
  // 2, as of one process, if it is a training of rank 0's, which says it; else 1.
  EXPECT_THAT(result.exit_code, AnyOf(1, 2));
  const std::size_t said = result.error.find("skein: error: ");
  ASSERT_NE(said, std::string::npos) << result.error;
  EXPECT_EQ(result.error.rfind("skein: error: "), said) << "said once";
  EXPECT_THAT(result.error, HasSubstr("heading-quiet-seed4"));
  EXPECT_TRUE(ProcessesOf(together_).empty());
}

TEST_F(RanksStudy, WhatCannotBeIsSaidOnceByRankZero) {
  const std::vector<std::vector<std::string>> wrong = {
      {"eval", "--policy", scratch_ / "none.skein"},
      {"compare", "--task", "heading", "--agents", "zero,nobody"},
      {"study", scratch_ / "none.toml"},
      {"eval", "--policy", "untrained", "--task", "heading", "--json", "/proc/none/result.json"}};
  for (const std::vector<std::string>& command : wrong) {
    const ProgramResult alone = RunSkein(command), together = RunWords(Mpirun(2, command));
    EXPECT_EQ(together.exit_code, alone.exit_code) << command[0];
    EXPECT_NE(alone.exit_code, 0);
    EXPECT_EQ(together.error.substr(0, alone.error.size()), alone.error);
    EXPECT_EQ(together.error.rfind("skein: error: "), together.error.find("skein: error: "));
  }
  const ProgramResult three =
      RunWords(Mpirun(3, {"eval", "--policy", "untrained", "--task", "heading"}));
  EXPECT_EQ(three.exit_code, 2);
  EXPECT_THAT(three.error, HasSubstr("3 processes cannot work together"));
}

TEST_F(RanksStudy, RanksThatComputeDifferentlyAreRefusedAndNamed) {
  if (simd::ActiveTarget() == simd::Target::kScalar) GTEST_SKIP() << "needs another SIMD target";
  const std::vector<std::vector<std::string>> commands = {
      {"eval", "--policy", "untrained", "--task", "heading"},
      {"compare", "--task", "heading", "--agents", "zero,random", "--no-html"},
      Study(together_)};
  for (const std::vector<std::string>& command : commands) {
    const ProgramResult result = RunWords(Mpirun(2, command, LastRank{"SKEIN_SIMD=scalar"}));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.error, HasSubstr("ranks differ in what they"));
    EXPECT_THAT(result.error, HasSubstr("rank 1 ("));
  }
}

}  // namespace
}  // namespace skein
