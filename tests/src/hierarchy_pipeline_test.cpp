// SPDX-License-Identifier: Apache-2.0
// Trains high-level policies over low-level policies as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"
#include "train/files/tensor_file.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class HighLevelPipeline : public ::testing::Test {
 protected:
  const ScratchDirectory scratch_;
  std::string root_ = scratch_.path();
  std::string reference_ = root_ + "/reference", run_ = root_ + "/run";
};

/// Arguments of a training of task tracking over the policy `low-level policy`.
std::vector<std::string> HighLevelTraining(const std::string& out, const std::string& low_level) {
  std::vector<std::string> arguments =
      TinyTrainingOf("tracking", out,
                     {"--preset", "planner", "--steps", std::to_string(64 * 16 * 10 * 3), "--set",
                      "env.action_repeat=10"});
  if (!low_level.empty()) arguments.insert(arguments.end(), {"--low-level", low_level});
  return arguments;
}

TEST_F(HighLevelPipeline, AHighLevelPolicyTrainsOverAControlPolicyAndFliesByItself) {
  const std::string control = root_ + "/control";
  ASSERT_EQ(CallSkein(TinyTrainingOf("control", control, {"--steps", "10240"})).exit_code, 0);
  const ProgramResult trained = CallSkein(HighLevelTraining(reference_, control));
  ASSERT_EQ(trained.exit_code, 0) << trained.error;
  EXPECT_THAT(trained.output, HasSubstr("low-level policy " + control + "/checkpoints/policy-"));

  // Interrupted, its low-level policy gone from where it was, it comes to the same end.
  {
    RunningProgram program(HighLevelTraining(run_, control));
    ASSERT_TRUE(program.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
    program.Signal(SIGTERM);
    ASSERT_EQ(program.Wait().exit_code, 0);
  }
  const std::string moved = root_ + "/moved";
  fs::rename(control, moved);
  const ProgramResult resumed = CallSkein(
      {"train", "--resume", run_, "--low-level", moved + "/checkpoints/policy-best.skein"});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  for (const char* file : {"/metrics.csv", "/checkpoints/policy-final.skein", "/low_level.skein",
                           "/checkpoints/checkpoint-000003.skein"}) {
    ExpectSameFile(reference_ + file, run_ + file);
  }

  // The file alone is enough.
  const std::string flights = root_ + "/tracking.csv";
  fs::remove_all(moved);
  const ProgramResult flown =
      CallSkein({"eval", "--policy", run_ + "/checkpoints/policy-final.skein", "--task", "tracking",
                 "--episodes", "32", "--set", "env.time_limit_steps=100", "--flights", flights});
  ASSERT_EQ(flown.exit_code, 0) << flown.error;
  EXPECT_THAT(flown.output,
              HasSubstr("an action every 10 control steps for a low-level policy with one "
                        "every 5"));
  // A low-level policy acts at the start of each of the high-level policy's policy steps, too.
  const ProgramResult faster = CallSkein(
      {"eval", "--policy", run_ + "/checkpoints/policy-final.skein", "--task", "tracking",
       "--episodes", "32", "--set", "env.time_limit_steps=100", "--set", "env.action_repeat=2"});
  ASSERT_EQ(faster.exit_code, 0) << faster.error;
  EXPECT_THAT(
      faster.output,
      HasSubstr("an action every 2 control steps for a low-level policy with one every 2\n"));
  EXPECT_THAT(ReadFile(flights), HasSubstr(",error_north_ft,error_east_ft,error_altitude_ft"));
  EXPECT_THAT(ReadFile(flights), HasSubstr(",action_target_pitch,"));
}

TEST_F(HighLevelPipeline, AHighLevelPolicyTrainsOverTheAutopilot) {
  const ProgramResult trained = CallSkein(HighLevelTraining(run_, "autopilot"));
  ASSERT_EQ(trained.exit_code, 0) << trained.error;
  EXPECT_THAT(trained.output, HasSubstr("low-level policy: the autopilot, variant aggressive"));
  const std::string policy = run_ + "/checkpoints/policy-final.skein";
  const ProgramResult flown = CallSkein({"eval", "--policy", policy, "--task", "tracking",
                                         "--episodes", "32", "--set", "env.time_limit_steps=100"});
  ASSERT_EQ(flown.exit_code, 0) << flown.error;
  EXPECT_THAT(flown.output, HasSubstr("for a low-level policy with one every 1\n"));
  const ProgramResult other =
      CallSkein({"train", "--resume", run_, "--low-level", "autopilot:traditional"});
  EXPECT_EQ(other.exit_code, 2);
  ExpectOneLine(other.error, "keeps its low-level policy");
  const ProgramResult exported =
      CallSkein({"export", policy, "--format", "c", "-o", run_ + "/tracking.h"});
  EXPECT_EQ(exported.exit_code, 0) << exported.error;
  EXPECT_THAT(exported.output, HasSubstr("left out  the autopilot"));
}

TEST_F(HighLevelPipeline, APolicyThatActsDirectlyTrainsResumesAndFliesWithoutALowLevelPolicy) {
  const auto training = [](const std::string& out) { return TinyTrainingOf("tracking", out, {}); };
  ASSERT_EQ(CallSkein(training(reference_)).exit_code, 0);
  {
    RunningProgram program(training(run_));
    ASSERT_TRUE(program.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
    program.Signal(SIGTERM);
    ASSERT_EQ(program.Wait().exit_code, 0);
  }
  const ProgramResult resumed = CallSkein({"train", "--resume", run_});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  const std::string policy = "/checkpoints/policy-final.skein";
  ExpectSameFile(reference_ + policy, run_ + policy);
  // Whatever the default preset would train.
  const ProgramResult flown = CallSkein({"eval", "--policy", run_ + policy, "--task", "tracking",
                                         "--episodes", "32", "--set", "env.time_limit_steps=100"});
  ASSERT_EQ(flown.exit_code, 0) << flown.error;
  EXPECT_THAT(flown.output, HasSubstr("an action every 5 control steps"));
  std::vector<std::string> with_low_level = training(root_ + "/other");
  with_low_level.insert(with_low_level.end(), {"--low-level", "autopilot"});
  const ProgramResult refused = CallSkein(with_low_level);
  EXPECT_EQ(refused.exit_code, 2);
  ExpectOneLine(refused.error, "not for tracking flown directly");
}

TEST_F(HighLevelPipeline, AgentsThatAreComparedSeeTheTargetEachInTheirOwnAxes) {
  std::vector<std::string> in_earth = HighLevelTraining(run_, "autopilot");
  in_earth.insert(in_earth.end(), {"--set", "env.tracking.error_axes=\"earth\""});
  ASSERT_EQ(CallSkein(in_earth).exit_code, 0);
  ASSERT_EQ(CallSkein(HighLevelTraining(reference_, "autopilot")).exit_code, 0);
  const std::string agents = "policy:" + run_ + ",policy:" + reference_ + ",autopilot,random";
  const std::vector<std::string> compare = {
      "compare",    "--task", "tracking", "--agents", agents, "--set", "env.time_limit_steps=100",
      "--episodes", "32"};
  const ProgramResult compared = CallSkein(compare);
  EXPECT_EQ(compared.exit_code, 0) << compared.error;
  std::vector<std::string> all_in_earth = compare;
  all_in_earth.insert(all_in_earth.end(), {"--set", "env.tracking.error_axes=\"earth\""});
  const ProgramResult refused = CallSkein(all_in_earth);
  EXPECT_EQ(refused.exit_code, 2);
  ExpectOneLine(refused.error, "env.tracking.error_axes cannot be set here");
}

TEST_F(HighLevelPipeline, LowLevelPoliciesThatDoNotFitAreNamed) {
  const std::string heading = root_ + "/heading";
  ASSERT_EQ(CallSkein(TinyTraining(heading, {"--steps", "10240"})).exit_code, 0);
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& part) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << part;
    ExpectOneLine(result.error, part);
    EXPECT_FALSE(fs::exists(run_)) << part;
  };
  refused(HighLevelTraining(run_, ""), "needs --low-level");
  refused(HighLevelTraining(run_, heading), "a policy of task heading");
  refused(HighLevelTraining(run_, root_ + "/absent.skein"), root_ + "/absent.skein");
  refused(TinyTraining(run_, {"--low-level", heading}), "not for heading");
  refused({"train", "--resume", heading, "--low-level", heading}, "not for heading");
  refused({"eval", "--policy", heading, "--low-level", heading}, "--policy untrained");

  // A policy that does not say its task, as older ones do not, is taken at its word.
  const std::string old = root_ + "/old.skein";
  TensorFile file = TensorFile::Read(heading + "/checkpoints/policy-best.skein");
  ASSERT_EQ(file.metadata.erase("policy.task"), 1u);
  file.Write(old);
  const ProgramResult trained = CallSkein(HighLevelTraining(run_, old));
  ASSERT_EQ(trained.exit_code, 0) << trained.error;
  EXPECT_THAT(trained.output, HasSubstr("it does not say its task"));
  const ProgramResult unsaid = CallSkein({"eval", "--policy", old});
  EXPECT_EQ(unsaid.exit_code, 2);
  ExpectOneLine(unsaid.error, "--task is needed: --policy " + old);
  const ProgramResult other = CallSkein({"train", "--resume", run_, "--low-level", heading});
  EXPECT_EQ(other.exit_code, 2);
  ExpectOneLine(other.error, "task heading");
  // And a high-level policy is no low-level policy.
  const ProgramResult nested =
      CallSkein(HighLevelTraining(root_ + "/nested", run_ + "/checkpoints/policy-final.skein"));
  EXPECT_EQ(nested.exit_code, 2);
  ExpectOneLine(nested.error, "a policy of task tracking");
  const ProgramResult unknown = CallSkein(HighLevelTraining(root_ + "/none", "autopilot:drunken"));
  EXPECT_EQ(unknown.exit_code, 2);
  ExpectOneLine(unknown.error, "parallel");
  // Untrained, both ways of flying Tracking.
  for (const bool over_low_level : {true, false}) {
    std::vector<std::string> untrained = {"eval",   "--policy", "untrained",
                                          "--task", "tracking", "--episodes",
                                          "32",     "--set",    "env.time_limit_steps=100"};
    if (over_low_level) untrained.insert(untrained.end(), {"--low-level", old});
    const ProgramResult flown = CallSkein(untrained);
    EXPECT_EQ(flown.exit_code, 0) << flown.error;
    EXPECT_EQ(flown.output.find("for a low-level policy") != std::string::npos, over_low_level);
  }
}

}  // namespace
}  // namespace skein
