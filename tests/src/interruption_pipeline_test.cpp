// SPDX-License-Identifier: Apache-2.0
// What a training leaves behind that is killed, stopped or asked to save: nothing is lost.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>
#include <thread>

#include "base/error.h"
#include "src/files/output_file.h"
#include "src/run/run_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"
#include "tests/src/training_fixture.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The seed of the moments at which signals come: SKEIN_TEST_SEED; without it, a new one.
std::uint32_t SeedOfMoments() {
  const char* const text = std::getenv("SKEIN_TEST_SEED");
  if (text == nullptr) return std::random_device()();
  const char* const end = text + std::strlen(text);
  std::uint32_t seed = 0;
  const std::from_chars_result parsed = std::from_chars(text, end, seed);
  if (parsed.ec != std::errc() || parsed.ptr != end) {
    throw Error("SKEIN_TEST_SEED is '" + std::string(text) +
                "', and a whole number from 0 to 4294967295 is expected");
  }
  return seed;
}

std::string HowToRepeat(std::uint32_t seed) {
  return "SKEIN_TEST_SEED=" + std::to_string(seed) + " repeats the moments of the signals";
}

class InterruptedTraining : public TrainingFixture {};

TEST_F(InterruptedTraining, KilledAnywhereAndResumedEqualsUninterrupted) {
  FlyReference();
  const std::uint32_t seed = SeedOfMoments();
  SCOPED_TRACE(HowToRepeat(seed));
  std::mt19937 random(seed);
  bool finished = false;
  int killed = 0;
  for (int kill = 0; kill < 4 && !finished; ++kill) {
    RunningProgram program(kill == 0 ? TinyTraining(run_)
                                     : std::vector<std::string>{"train", "--resume", run_});
    const auto delay = std::chrono::milliseconds(random() % 60);
    const std::uint64_t iteration = 1 + random() % 2 + 3 * static_cast<std::uint64_t>(kill);
    if (program.WaitUntil([&] { return HasCheckpoint(run_, iteration); })) {
      std::this_thread::sleep_for(delay);
      program.Signal(SIGKILL);
    }
    const ProgramResult result = program.Wait();
    finished = result.exit_code == 0;
    killed += result.signal == SIGKILL;
    ASSERT_TRUE(finished || result.signal == SIGKILL) << result.error;
  }
  EXPECT_GE(killed, 1) << "the test shows nothing";
  const ProgramResult result = RunSkein({"train", "--resume", run_});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameRun(reference_, run_);
  for (const auto& entry : fs::recursive_directory_iterator(run_)) {
    EXPECT_NE(entry.path().extension(), kTemporaryExtension) << "left behind by a kill";
  }
}

TEST_F(InterruptedTraining, KilledBeforeTheFirstCheckpointBeginsAgain) {
  FlyReference();
  {
    RunningProgram program(TinyTraining(run_));
    ASSERT_TRUE(program.WaitUntil([&] { return fs::exists(run_ + "/config.toml"); }));
    program.Signal(SIGKILL);
    program.Wait();
  }
  const ProgramResult result = RunSkein({"train", "--resume", run_});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameRun(reference_, run_);
}

TEST_F(InterruptedTraining, KilledAfterACheckpointThatTimeAskedForGoesOnFromIt) {
  const std::string checkpoints = run_ + "/checkpoints";
  {
    RunningProgram program(
        TinyTraining(run_, {"--steps", "1e8", "--set", "checkpoint.interval_iterations=0", "--set",
                            "checkpoint.interval_s=0.2"}));
    ASSERT_TRUE(program.WaitUntil([&] { return CheckpointsIn(checkpoints).size() >= 2; }));
    program.Signal(SIGKILL);
    program.Wait();
  }
  const std::uint64_t iteration = CheckpointsIn(checkpoints).back().iteration;
  RunningProgram program({"train", "--resume", run_});
  EXPECT_TRUE(program.WaitUntil([&] {
    return HasCheckpoint(run_, iteration + 1) &&
           program.output().find("resuming heading") != std::string::npos;
  }));
}

TEST_F(InterruptedTraining, SigtermSavesAndEndsCleanly) {
  // The signal has all but five of them to come in.
  const std::vector<std::string> steps = {"--steps", std::to_string(200 * kStepsPerIteration)};
  const std::string last_checkpoint = "/checkpoints/checkpoint-000200.skein";
  FlyReference(steps);
  {
    std::vector<std::string> more = steps;
    more.insert(more.end(), {"--set", "checkpoint.interval_iterations=5"});
    RunningProgram program(TinyTraining(run_, more));
    ASSERT_TRUE(program.WaitUntil([&] { return HasCheckpoint(run_, 5); }));
    program.Signal(SIGTERM);
    const ProgramResult result = program.Wait();
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.output, HasSubstr("skein train --resume " + run_));
  }
  const auto saved = CheckpointsIn(run_ + "/checkpoints").back().iteration;
  const std::string metrics = ReadFile(run_ + "/metrics.csv");
  EXPECT_EQ(static_cast<std::uint64_t>(std::count(metrics.begin(), metrics.end(), '\n')), 1 + saved)
      << "everything flown is saved";
  const ProgramResult result = RunSkein({"train", "heading", "--resume", run_});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameFile(reference_ + last_checkpoint, run_ + last_checkpoint);
  ExpectSameFile(reference_ + "/metrics.csv", run_ + "/metrics.csv");
}

TEST_F(InterruptedTraining, StoppedAnywhereAndResumedEqualsUninterrupted) {
  FlyReference();
  const std::uint32_t seed = SeedOfMoments();
  SCOPED_TRACE(HowToRepeat(seed));
  std::mt19937 random(seed);
  int stopped = 0;
  for (int stop = 0; stop < 6; ++stop) {
    // One checkpoint of its own says that a run handles signals.
    const auto saved = CheckpointsIn(run_ + "/checkpoints");
    const std::uint64_t iteration = saved.empty() ? 1 : saved.back().iteration + 1;
    RunningProgram program(stop == 0 ? TinyTraining(run_)
                                     : std::vector<std::string>{"train", "--resume", run_});
    // The first has to come before the end of all.
    const auto delay = std::chrono::milliseconds(random() % (stop == 0 ? 20 : 60));
    const int signal = stop % 2 == 0 ? SIGTERM : SIGINT;
    if (program.WaitUntil([&] { return HasCheckpoint(run_, iteration); })) {
      std::this_thread::sleep_for(delay);
      program.Signal(signal);
    }
    const ProgramResult result = program.Wait();
    stopped += result.output.find("stopped by SIG") != std::string::npos;
    // A program that has finished its run no longer handles signals.
    ASSERT_TRUE(result.exit_code == 0 || result.signal == signal) << result.error;
  }
  EXPECT_GE(stopped, 1) << "the test shows nothing";
  const ProgramResult result = RunSkein({"train", "--resume", run_});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameRun(reference_, run_);
}

TEST_F(InterruptedTraining, AStopDropsTheIterationUnderWay) {
  // Iterations of many minutes, by the rollout and by the update.
  const std::vector<std::vector<std::string>> iterations = {
      {"--set", "ppo.rollout_steps=20000", "--set", "env.action_repeat=1000", "--set",
       "env.substeps=20"},
      {"--set", "ppo.num_aircraft=1024", "--set", "ppo.epochs=1000", "--set",
       "network.hidden_size=256", "--set", "network.gru_size=256"}};
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    const std::string run = run_ + std::to_string(i);
    std::vector<std::string> more = iterations[i];
    more.insert(more.end(), {"--steps", "1e14"});
    RunningProgram program(TinyTraining(run, more));
    ASSERT_TRUE(program.WaitUntil([&] { return fs::exists(run + "/timing.csv"); }));
    std::this_thread::sleep_for(std::chrono::seconds(1));  // for the update to begin
    program.Signal(SIGTERM);
    const ProgramResult result = program.Wait();
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.output, HasSubstr("after 0 of 100 T steps; dropped the iteration"));
    EXPECT_FALSE(HasCheckpoint(run, 1));
    const std::string metrics = ReadFile(run + "/metrics.csv");
    EXPECT_EQ(std::count(metrics.begin(), metrics.end(), '\n'), 1) << "the header alone";
  }
}

TEST_F(InterruptedTraining, AStopInTheFinalEvaluationKeepsWhatWasTrained) {
  const std::vector<std::string> long_evaluation = {"--set", "evaluation.final_episodes=300000",
                                                    "--set", "env.substeps=200",
                                                    "--set", "ppo.rollout_steps=8"};
  RunningProgram program(TinyTraining(run_, long_evaluation));
  ASSERT_TRUE(program.WaitUntil([&] {
    return fs::exists(run_ + "/log.txt") &&
           ReadFile(run_ + "/log.txt").find("fresh episodes") != std::string::npos;
  }));
  program.Signal(SIGINT);
  const ProgramResult result = program.Wait();
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("dropped the evaluation"));
  EXPECT_TRUE(fs::exists(run_ + "/checkpoints/policy-final.skein"));
  EXPECT_FALSE(fs::exists(run_ + "/evaluation.json"));
}

TEST_F(InterruptedTraining, ASecondSignalEndsAtOnce) {
  // Policy steps of minutes, so that the first signal has not been obeyed when the second comes.
  RunningProgram program(
      TinyTraining(run_, {"--set", "ppo.num_aircraft=100000", "--set", "ppo.rollout_steps=8",
                          "--set", "learner.rollout_tile=100000", "--set", "env.action_repeat=1000",
                          "--set", "env.substeps=20", "--steps", "1e12"}));
  ASSERT_TRUE(program.WaitUntil([&] { return fs::exists(run_ + "/timing.csv"); }));
  program.Signal(SIGINT);
  program.Signal(SIGTERM);
  const ProgramResult result = program.Wait();
  EXPECT_TRUE(result.signal == SIGTERM || result.signal == SIGINT) << result.exit_code;
}

TEST_F(InterruptedTraining, ALostTerminalSavesAndEnds) {
  RunningProgram program(TinyTraining(run_, {"--steps", "1e12"}));
  ASSERT_TRUE(program.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
  program.Signal(SIGHUP);
  const ProgramResult result = program.Wait();
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("stopped by SIGHUP"));
}

TEST_F(InterruptedTraining, Sigusr1HarmsNoProgramThatHasNothingToSave) {
  // Only a writer's end lets a reader of a pipe go on, which the program is until then.
  const std::string pipe = run_ + "-settings";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  RunningProgram program(TinyTraining(run_, {"--config", pipe}));
  const int writer = open(pipe.c_str(), O_WRONLY);
  ASSERT_GE(writer, 0);
  program.Signal(SIGUSR1);
  close(writer);
  EXPECT_EQ(program.Wait().exit_code, 0);
}

TEST_F(InterruptedTraining, Sigusr1SavesAndGoesOn) {
  RunningProgram program(
      TinyTraining(run_, {"--steps", "1e8", "--set", "checkpoint.interval_iterations=0", "--set",
                          "checkpoint.interval_s=1e6"}));
  ASSERT_TRUE(program.WaitUntil([&] {
    return fs::exists(run_ + "/metrics.csv") &&
           ReadFile(run_ + "/metrics.csv").find("\n2,") != std::string::npos;
  }));
  EXPECT_FALSE(HasCheckpoint(run_, 1));
  program.Signal(SIGUSR1);
  ASSERT_TRUE(program.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
  const std::string rows = ReadFile(run_ + "/metrics.csv");
  ASSERT_TRUE(program.WaitUntil([&] { return ReadFile(run_ + "/metrics.csv") != rows; }))
      << "continues";
  program.Signal(SIGINT);
  EXPECT_EQ(program.Wait().exit_code, 0);
}

}  // namespace
}  // namespace skein
