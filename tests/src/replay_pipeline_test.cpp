// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/replay/acmi_reader.h"
#include "tests/src/run_program.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

class ReplayPipeline : public ::testing::Test {
 protected:
  static std::vector<std::string> Command(const std::string& name,
                                          const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {name,
                                          "--task",
                                          "heading",
                                          "--set",
                                          "env.time_limit_steps=60",
                                          "--set",
                                          "env.heading.earliest_success_step=60"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  const ScratchDirectory scratch_;
};

TEST_F(ReplayPipeline, RecordsTheEpisodesThatCompareRecords) {
  const std::string replayed = scratch_ / "replayed.acmi", compared = scratch_ / "compared.acmi";
  const ProgramResult replay = CallSkein(Command(
      "replay", {"--agents", "zero,random:0.2", "--episodes", "3", "--seed", "7", "-o", replayed}));
  ASSERT_EQ(replay.exit_code, 0) << replay.error;
  EXPECT_EQ(replay.output, replayed + ": 3 episodes by 2 agents, for Tacview\n");
  const ProgramResult compare =
      CallSkein(Command("compare", {"--agents", "zero,random:0.2", "--episodes", "40", "--seed",
                                    "7", "--acmi", compared, "--flights-count", "3"}));
  ASSERT_EQ(compare.exit_code, 0) << compare.error;
  EXPECT_EQ(ReadFile(replayed), ReadFile(compared));
  EXPECT_EQ(ReadAcmi(ReadFile(replayed)).objects.size(), 12u) << "aircraft and targets";
}

TEST_F(ReplayPipeline, EvalRecordsItsPolicy) {
  const std::string file = scratch_ / "eval.acmi";
  const ProgramResult result =
      CallSkein(Command("eval", {"--policy", "untrained", "--episodes", "4", "--acmi", file}));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_EQ(ReadAcmi(ReadFile(file)).objects.size(), 8u);
}

TEST_F(ReplayPipeline, CsvHasAFileForEveryAgent) {
  const std::vector<std::string> agents = {"--agents", "zero,random", "--episodes", "1"};
  std::vector<std::string> arguments = Command("replay", agents);
  arguments.insert(arguments.end(), {"-o", scratch_ / "flights.csv"});
  ASSERT_EQ(CallSkein(arguments).exit_code, 0);
  for (const char* name : {"flights.zero.csv", "flights.random.csv"}) {
    EXPECT_EQ(ReadFile(scratch_ / name).rfind("episode,time_s,", 0), 0u) << name;
  }
  arguments = Command("replay", {"--agents", "zero", "--episodes", "1", "--format", "csv", "-o",
                                 scratch_ / "alone"});
  ASSERT_EQ(CallSkein(arguments).exit_code, 0);
  EXPECT_EQ(ReadFile(scratch_ / "alone"), ReadFile(scratch_ / "flights.zero.csv"));
}

TEST_F(ReplayPipeline, WrongUsageIsAnErrorOfOneLineThatLeavesNothingBehind) {
  const std::string out = scratch_ / "flights.acmi";
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"-o", out}, "--policy or --agents is needed"},
      {{"--agents", "zero"}, "-o FILE or --live PORT is needed"},
      {{"--agents", "zero", "-o", scratch_ / "flights.txt"},
       "--format is needed, one of acmi, csv"},
      {{"--agents", "zero", "-o", out, "--format", "svg"}, "--format: unknown svg; known: acmi"},
      {{"--agents", "zero,zero", "-o", out}, "zero is there twice"},
      {{"--agents", "zero", "-o", out, "--episodes", "1001"},
       "--episodes: '1001' is not a whole number in [1 - 1000]"},
      {{"--agents", "zero,random", "-o", out, "--episodes", "900", "--mission", "1"},
       "to record 900 flights of up to 60 s by 2 agents takes 5400000 control steps, and 5000000 "
       "are the most: lower --episodes or --mission"},
      {{"--agents", "zero", "-o", out, "--episodes", "1000", "--hold", "100"},
       "1000 flights of up to 102.2 s by 1 agent"},
      {{"--agents", "zero", "-o", out, "--live", "0"}, "--out and --live exclude each other"},
      {{"--agents", "zero", "-o", out, "--password", "x"}, "--password needs --live"},
      {{"--agents", "zero", "--live", "0", "--password", "\xFF"}, "not UTF-8"},
      {{"--agents", "zero", "-o", out, "--set", "env.action_repeat=2"}, "env.action_repeat"}};
  for (const auto& [arguments, message] : wrong) {
    const ProgramResult result = CallSkein(Command("replay", arguments));
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_THAT(result.error, HasSubstr(message));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    EXPECT_EQ(result.output, "");
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch_.path()));
  const ProgramResult unwritable =
      CallSkein(Command("replay", {"--agents", "zero", "-o", scratch_ / "absent/flights.acmi"}));
  EXPECT_EQ(unwritable.exit_code, 2);
  EXPECT_THAT(unwritable.error, HasSubstr("absent/flights.acmi: cannot be written"));
}

TEST_F(ReplayPipeline, ALiveReplayEndsCleanlyWithSigint) {
  RunningProgram program(Command("replay", {"--agents", "zero", "--episodes", "1", "--live", "0"}));
  const auto listens = [&] {
    return program.output().find("real-time telemetry on 127.0.0.1:") != std::string::npos;
  };
  ASSERT_TRUE(program.WaitUntil(listens));
  program.Signal(SIGINT);
  EXPECT_EQ(program.Wait().exit_code, 0);
}

}  // namespace
}  // namespace skein
