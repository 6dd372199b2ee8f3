// SPDX-License-Identifier: Apache-2.0
// Runs the program as a user does, on trainings of about a second.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "simd/target.h"
#include "src/bench/machine.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "src/report/run_record.h"
#include "src/run/run_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"
#include "tests/src/training_fixture.h"
#include "train/network/backend.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class TrainingPipeline : public TrainingFixture {};

TEST_F(TrainingPipeline, LeavesEverythingBehindThatItSays) {
  const ProgramResult result = RunSkein(TinyTraining(run_));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_EQ(result.error, "");
  for (const char* file :
       {"/config.toml", "/log.txt", "/metrics.csv", "/timing.csv", "/evaluation.json",
        "/checkpoints/policy-best.skein", "/checkpoints/policy-final.skein", kLastCheckpoint}) {
    EXPECT_TRUE(fs::is_regular_file(run_ + file)) << file;
  }
  EXPECT_THAT(result.output, HasSubstr(run_ + "/evaluation.json"));
  EXPECT_THAT(result.output, HasSubstr("/s return "));
  EXPECT_EQ(CheckpointsIn(run_ + "/checkpoints").size(), 3u) << "only the newest stay";

  const std::string metrics = ReadFile(run_ + "/metrics.csv");
  EXPECT_EQ(std::count(metrics.begin(), metrics.end(), '\n'), 1 + kIterations);

  const auto evaluation = nlohmann::json::parse(ReadFile(run_ + "/evaluation.json"));
  EXPECT_EQ(evaluation["policy"], run_ + "/checkpoints/policy-best.skein");
  EXPECT_EQ(evaluation["episodes"], 32);
  EXPECT_GE(evaluation["success_rate"], 0);
  int ended = 0;
  for (const auto& [kind, count] : evaluation["terminations"].items()) ended += count.get<int>();
  EXPECT_EQ(ended, 32) << "every episode ends for one reason";
  EXPECT_EQ(evaluation["program"], nlohmann::json(ProgramJson()));
}

TEST_F(TrainingPipeline, ControlTrainsAndFlies) {
  const ProgramResult trained = RunSkein(TinyTrainingOf("control", run_, {"--steps", "20480"}));
  ASSERT_EQ(trained.exit_code, 0) << trained.error;
  EXPECT_THAT(ReadFile(run_ + "/config.toml"), HasSubstr("task = \"control\""));
  const std::string json = root_ + "/control.json", flights = root_ + "/control.csv";
  const ProgramResult flown = CallSkein({"eval", "--policy", run_, "--task", "control",
                                         "--episodes", "32", "--json", json, "--flights", flights});
  ASSERT_EQ(flown.exit_code, 0) << flown.error;
  EXPECT_THAT(flown.output, HasSubstr("on control, 32 episodes"));
  int ended = 0;
  const auto evaluation = nlohmann::json::parse(ReadFile(json));
  for (const auto& [kind, count] : evaluation["terminations"].items()) ended += count.get<int>();
  EXPECT_EQ(ended, 32);
  EXPECT_THAT(ReadFile(flights),
              HasSubstr(",error_pitch_deg,error_yaw_deg,error_true_airspeed_fps"));
  const ProgramResult other = CallSkein({"eval", "--policy", run_, "--task", "heading"});
  EXPECT_EQ(other.exit_code, 2);
  ExpectOneLine(other.error, "env.task = control, but the task asked for is heading");
  // A file knows its task.
  const std::string policy = run_ + "/checkpoints/policy-final.skein";
  const ProgramResult alone = CallSkein({"eval", "--policy", policy, "--episodes", "32"});
  EXPECT_EQ(alone.exit_code, 0) << alone.error;
  EXPECT_THAT(alone.output, HasSubstr("on control, 32 episodes"));
  // It flies no other task, though the sizes fit, no other aircraft, and below no high-level policy
  // of another control interval.
  const ProgramResult file = CallSkein({"eval", "--policy", policy, "--task", "heading"});
  EXPECT_EQ(file.exit_code, 2);
  ExpectOneLine(file.error, "env.task = control, but is to fly with env.task = heading");
  const ProgramResult compared =
      CallSkein({"compare", "--task", "heading", "--agents", "zero,policy:" + policy});
  EXPECT_EQ(compared.exit_code, 2);
  ExpectOneLine(compared.error, "agent policy:" + policy);
  const ProgramResult aircraft =
      CallSkein({"eval", "--policy", policy, "--task", "control", "--preset", "aerosonde"});
  EXPECT_EQ(aircraft.exit_code, 2);
  ExpectOneLine(aircraft.error, "env.aircraft = f16, but is to fly with env.aircraft = aerosonde");
  const ProgramResult above =
      CallSkein({"train", "tracking", "--out", root_ + "/above", "--preset", "planner",
                 "--low-level", policy, "--set", "env.control_interval_s=0.01"});
  EXPECT_EQ(above.exit_code, 2);
  ExpectOneLine(above.error, "--low-level " + policy + " was made with env.control_interval_s");
  const ProgramResult further = CallSkein({"train", "--resume", run_});
  EXPECT_EQ(further.exit_code, 0) << further.error;
}

/// Trains a tiny network and flies it; returns what both said.
ProgramResult TrainAndEvaluate(const std::string& run,
                               const std::vector<std::string>& assignments) {
  std::vector<std::string> more = {"--steps", "10240"};
  for (const std::string& assignment : assignments) {
    more.insert(more.end(), {"--set", assignment});
  }
  ProgramResult result = CallSkein(TinyTraining(run, more));
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(ReadFile(run + "/log.txt"), HasSubstr("networks by "));
  const ProgramResult flown = CallSkein({"eval", "--policy", run, "--episodes", "32"});
  EXPECT_EQ(flown.exit_code, 0) << flown.error;
  EXPECT_EQ(flown.error, "");
  result.output += flown.output;
  return result;
}

std::size_t CountOf(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST_F(TrainingPipeline, EveryBackendTrainsAndFliesAndSaysSo) {
  const std::vector<std::string> odd = {"network.hidden_layers=1", "network.hidden_size=20",
                                        "network.gru_layers=2", "network.gru_size=9"};
  EXPECT_EQ(CountOf("networks by the fused kernels", TrainAndEvaluate(run_, odd).output), 2u);
  std::vector<std::string> asked = odd;
  asked.push_back("learner.backend=libtorch");
  EXPECT_EQ(CountOf("networks by LibTorch, as asked",
                    TrainAndEvaluate(root_ + "/libtorch", asked).output),
            2u);
}

TEST_F(TrainingPipeline, WhatTheFusedKernelsCannotDoFallsBackAloud) {
  const std::string reason =
      "networks by LibTorch, slower: the fused kernels do not know network.activation = \"tanh\"";
  EXPECT_EQ(CountOf(reason, TrainAndEvaluate(run_, {"network.activation=tanh"}).output), 2u);
  EXPECT_EQ(CountOf(reason, ReadFile(run_ + "/log.txt")), 1u);
}

TEST_F(TrainingPipeline, OldNamesOfBackendsAreErrorsThatNameTheNewOnes) {
  for (const std::string name : {"tiled", "autograd"}) {
    const ProgramResult result =
        CallSkein(TinyTraining(run_, {"--set", "learner.backend=" + name}));
    EXPECT_EQ(result.exit_code, 2);
    ExpectOneLine(result.error, "learner.backend must be \"fused\" or \"libtorch\", not");
    EXPECT_FALSE(fs::exists(run_));
  }
}

TEST_F(TrainingPipeline, ARunSaysAndKeepsItsPrecision) {
  FlyReference({"--steps", "5120"});
  const std::string automatic = Name(DefaultPrecision());
  EXPECT_THAT(ReadFile(reference_ + "/config.toml"),
              HasSubstr("precision = \"" + automatic + "\"  #"));
  ASSERT_EQ(RunSkein(TinyTraining(run_, {"--steps", "5120", "--set", "learner.precision=mixed"}))
                .exit_code,
            0);
  EXPECT_THAT(ReadFile(run_ + "/config.toml"), HasSubstr("precision = \"mixed\"  #"));
  EXPECT_THAT(ReadFile(run_ + "/log.txt"), HasSubstr("networks by the fused kernels, in mixed"));
  EXPECT_EQ(CallSkein({"train", "--resume", run_}).exit_code, 0);
  const ProgramResult other =
      CallSkein({"train", "--resume", run_, "--set", "learner.precision=bf16"});
  EXPECT_EQ(other.exit_code, 2);
  ExpectOneLine(other.error, "learner.precision (\"mixed\" against \"bf16\")");
}

TEST_F(TrainingPipeline, AnUnknownPrecisionIsAnErrorThatNamesTheKnownOnes) {
  const ProgramResult result = CallSkein(TinyTraining(run_, {"--set", "learner.precision=fp16"}));
  EXPECT_EQ(result.exit_code, 2);
  ExpectOneLine(result.error, "learner.precision");
  for (const auto& [precision, name] : kPrecisionNames) {
    EXPECT_THAT(result.error, HasSubstr(std::string("\"") + name + "\""));
  }
  EXPECT_FALSE(fs::exists(run_));
}

TEST_F(TrainingPipeline, AConfigurationFileOfARunRepeatsIt) {
  FlyReference();
  const ProgramResult result =
      RunSkein({"train", "heading", "--config", reference_ + "/config.toml", "--out", run_});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameRun(reference_, run_);
}

TEST_F(TrainingPipeline, ANewRunCanStartFromTheNetworksOfAnother) {
  FlyReference({"--steps", "10240"});
  const ProgramResult further =
      CallSkein(TinyTraining(run_, {"--steps", "5120", "--from", reference_}));
  ASSERT_EQ(further.exit_code, 0) << further.error;
  const std::string line =
      "started from " + reference_ + "/checkpoints/checkpoint-000002.skein (actor and critic)";
  EXPECT_THAT(further.output, HasSubstr(line));
  EXPECT_THAT(ReadFile(run_ + "/log.txt"), HasSubstr(line));
  EXPECT_THAT(ReadFile(run_ + "/config.toml"), HasSubstr("# " + line));
  EXPECT_TRUE(fs::exists(run_ + "/checkpoints/checkpoint-000000.skein"))
      << "a kill must not lose them";
  EXPECT_NE(ReadFile(run_ + "/metrics.csv").find("\n1,5120,"), std::string::npos) << "counts anew";

  const std::string policy = reference_ + "/checkpoints/policy-final.skein";
  const ProgramResult actor =
      CallSkein(TinyTraining(root_ + "/actor", {"--steps", "5120", "--from", policy}));
  ASSERT_EQ(actor.exit_code, 0) << actor.error;
  EXPECT_THAT(actor.output, HasSubstr("started from " + policy + " (actor; a fresh critic)"));
}

TEST_F(TrainingPipeline, ARunCanStartFromAFileOfAnyName) {
  FlyReference({"--steps", "5120"});
  const std::string policy = root_ + "/caf\xe9\n[broken\x7f.skein";
  fs::copy_file(reference_ + "/checkpoints/policy-final.skein", policy);
  const ProgramResult result = CallSkein(TinyTraining(run_, {"--steps", "5120", "--from", policy}));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_EQ(ReadRecord(run_ + "/config.toml").train.total_steps, 5120u);
}

TEST_F(TrainingPipeline, NetworksThatDoNotFitAreRefusedInOneLine) {
  FlyReference({"--steps", "5120"});
  const auto refused = [&](const std::vector<std::string>& more, const std::string& message,
                           int exit_code = 1, const char* task = "heading") {
    std::vector<std::string> arguments = more;
    arguments.insert(arguments.end(), {"--from", reference_});
    arguments = TinyTrainingOf(task, run_, arguments);
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << message;
    ExpectOneLine(result.error, message);
    EXPECT_FALSE(fs::exists(run_));
  };
  refused({"--set", "network.gru_size=32"}, "other sizes, or another activation, than");
  refused({"--set", "network.tanh_mean=false"}, "was made with network.tanh_mean = true");
  refused({}, "env.task = heading", 2, "control");
  refused({"--preset", "aerosonde"}, "env.aircraft", 2);
  EXPECT_EQ(CallSkein({"train", "--resume", reference_, "--from", reference_}).exit_code, 2);
}

TEST_F(TrainingPipeline, TheBannerSaysWhatIsTrainedAndOnWhat) {
  const ProgramResult result = CallSkein(TinyTraining(run_, {"--steps", "5120", "--threads", "1"}));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  for (const char* part : {"training heading in ", "f16 from ", "preset default", "still air",
                           "networks by the fused kernels", "SIMD target ", ", 1 thread"}) {
    EXPECT_THAT(result.output, HasSubstr(part));
  }
  EXPECT_EQ(result.output.find('\x1b'), std::string::npos) << "no colour off a terminal";
}

TEST_F(TrainingPipeline, ThreadsDoNotChangeTheResult) {
  FlyReference({"--threads", "1"});
  const ProgramResult result = RunSkein(TinyTraining(run_, {"--threads", "3"}));
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameRun(reference_, run_);
}
TEST_F(TrainingPipeline, TwoRunsDoNotShareADirectory) {
  RunningProgram program(TinyTraining(run_, {"--steps", "1e8"}));
  ASSERT_TRUE(program.WaitUntil([&] { return HasCheckpoint(run_, 1); }));
  const ProgramResult second = RunSkein({"train", "--resume", run_});
  EXPECT_EQ(second.exit_code, 1);
  ExpectOneLine(second.error, "another skein is at work here");
  const ProgramResult third = RunSkein(TinyTraining(run_));
  EXPECT_EQ(third.exit_code, 2);
  ExpectOneLine(third.error, "--resume");
}

TEST_F(TrainingPipeline, AResumedRunKeepsItsConfiguration) {
  FlyReference();
  const ProgramResult same =
      RunSkein({"train", "--resume", reference_, "--set", "ppo.num_aircraft=64"});
  EXPECT_EQ(same.exit_code, 0) << same.error;
  // What "auto" means was decided when the run began, and is in its configuration by name.
  const ProgramResult chosen =
      RunSkein({"train", "--resume", reference_, "--set", "learner.precision=auto"});
  EXPECT_EQ(chosen.exit_code, 0) << chosen.error;
  const ProgramResult rounded =
      RunSkein({"train", "--resume", reference_, "--set", "learner.precision=mixed"});
  EXPECT_EQ(rounded.exit_code, 2);
  ExpectOneLine(rounded.error, "learner.precision");
  const ProgramResult other =
      RunSkein({"train", "--resume", reference_, "--set", "ppo.num_aircraft=128"});
  EXPECT_EQ(other.exit_code, 2);
  ExpectOneLine(other.error, "ppo.num_aircraft (64 against 128)");
  const ProgramResult longer = RunSkein({"train", "--resume", reference_, "--steps", "1e6"});
  EXPECT_EQ(longer.exit_code, 2);
  ExpectOneLine(longer.error, "run.total_steps");
  EXPECT_EQ(CallSkein({"train", "--resume", reference_, "--preset", "paper"}).exit_code, 2);
}

std::set<std::string> EventFilesOf(const std::string& run) {
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(run)) {
    const std::string path = entry.path().string();
    if (path.find("tfevents") != std::string::npos) files.insert(path);
  }
  return files;
}

/// At which step the session of an event file starts, by its second record: length, checksum, wall
/// time, step as a varint.
std::uint64_t SessionStart(const std::string& events) {
  constexpr std::size_t kFrame = 8 + 4, kWallTime = 1 + 8;
  const auto byte = [&events](std::size_t at) { return static_cast<unsigned char>(events.at(at)); };
  const std::size_t second = kFrame + byte(0) + 4;
  std::uint64_t step = 0;
  std::size_t at = second + kFrame + kWallTime + 1;
  for (int shift = 0;; shift += 7, ++at) {
    step |= static_cast<std::uint64_t>(byte(at) & 0x7f) << shift;
    if (byte(at) < 0x80) return step;
  }
}

TEST_F(TrainingPipeline, WhatAResumedRunFliesAgainIsRecordedOnce) {
  FlyReference();
  const std::set<std::string> before = EventFilesOf(reference_);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(SessionStart(ReadFile(*before.begin())), 1u);
  for (const int iteration : {11, 12}) {
    fs::remove(fmt::format("{}/checkpoints/checkpoint-{:06}.skein", reference_, iteration));
  }
  const ProgramResult resumed = RunSkein({"train", "--resume", reference_});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  const RunRecord run = ReadRunRecord(reference_);
  std::vector<double> iterations(kIterations);
  std::iota(iterations.begin(), iterations.end(), 1);
  EXPECT_EQ(*run.metrics.Find("iteration"), iterations);
  EXPECT_EQ(*run.timing.Find("iteration"), iterations);
  // TensorBoard forgets what the first file says of the steps from there on.
  ASSERT_EQ(EventFilesOf(reference_).size(), 2u);
  for (const std::string& events : EventFilesOf(reference_)) {
    if (before.count(events) > 0) continue;
    EXPECT_EQ(SessionStart(ReadFile(events)), 10u * kStepsPerIteration + 1);
  }
}

TEST_F(TrainingPipeline, NoCheckpointIsToBeRemovedForAnotherReasonThanDamage) {
  FlyReference();
  const std::string path = reference_ + "/config.toml", own = ReadFile(path);
  std::string edited = own;
  edited.replace(edited.find("num_aircraft = 64"), 17, "num_aircraft = 32");
  WriteFile(path, edited);
  const ProgramResult resumed = RunSkein({"train", "--resume", reference_});
  EXPECT_EQ(resumed.exit_code, 1);
  ExpectOneLine(resumed.error, "ppo.num_aircraft");
  EXPECT_EQ(resumed.error.find("remove"), std::string::npos) << resumed.error;

  WriteFile(path, own);
  const std::string metrics = ReadFile(reference_ + "/metrics.csv");
  std::vector<fs::path> checkpoints;
  for (const auto& entry : fs::directory_iterator(reference_ + "/checkpoints")) {
    if (entry.path().filename().string().rfind("checkpoint-", 0) == 0) {
      checkpoints.push_back(entry.path());
    }
  }
  for (const fs::path& checkpoint : checkpoints) fs::remove(checkpoint);
  const ProgramResult ended = RunSkein({"train", "--resume", reference_});
  EXPECT_EQ(ended.exit_code, 1);
  ExpectOneLine(ended.error, "has been trained to its end and has no checkpoint");
  EXPECT_EQ(ReadFile(reference_ + "/metrics.csv"), metrics) << "nothing is lost";
}

TEST_F(TrainingPipeline, DamagedCheckpointsAreRefused) {
  FlyReference();
  const std::string path = reference_ + kLastCheckpoint;
  const std::string whole = ReadFile(path);
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 4);
  const std::vector<std::string> damages = {flipped, whole.substr(0, whole.size() - 1), "",
                                            "not a checkpoint at all"};
  for (const std::string& damaged : damages) {
    WriteFile(path, damaged);
    const ProgramResult resumed = RunSkein({"train", "--resume", reference_});
    EXPECT_EQ(resumed.exit_code, 1);
    ExpectOneLine(resumed.error, path);
    EXPECT_THAT(resumed.error, HasSubstr("checkpoint-000011.skein")) << "the way out is named";
    const ProgramResult flown = CallSkein({"eval", "--policy", path, "--task", "heading"});
    EXPECT_EQ(flown.exit_code, 1);
    ExpectOneLine(flown.error, path);
  }
  fs::remove(path);
  EXPECT_EQ(RunSkein({"train", "--resume", reference_}).exit_code, 0);
  EXPECT_TRUE(ReadFile(path) == whole) << "flown again from the one before";
}

TEST_F(TrainingPipeline, DamagedRecordsAreNoticedAndTheTrainingGoesOn) {
  FlyReference();
  const std::string metrics = ReadFile(reference_ + "/metrics.csv");
  for (const char* name : {"checkpoint-000011.skein", "checkpoint-000012.skein"}) {
    fs::copy(reference_ + "/checkpoints/" + name, root_ + "/" + name);
  }
  const auto resume_with = [&](const std::string& rows) {
    fs::remove(reference_ + kLastCheckpoint);
    WriteFile(reference_ + "/metrics.csv", rows);
    const ProgramResult resumed = RunSkein({"train", "--resume", reference_});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.error;
    return resumed.output;
  };
  constexpr const char* kNoticed = "warning: metrics.csv is not what this run wrote";
  EXPECT_THAT(resume_with(metrics), Not(HasSubstr("warning")));
  std::string flipped = metrics;
  flipped[metrics.find("\n5,") + 8] ^= 1;
  EXPECT_THAT(resume_with(flipped), HasSubstr(kNoticed));
  ExpectSameFile(reference_ + "/checkpoints/checkpoint-000011.skein",
                 root_ + "/checkpoint-000011.skein");
  EXPECT_THAT(resume_with(metrics.substr(0, metrics.find("\n5,") + 1)), HasSubstr(kNoticed));
  // A torn last row is a kill's, and computed again.
  EXPECT_THAT(resume_with(metrics.substr(0, metrics.size() - 5)), Not(HasSubstr("warning")));
  ExpectSameFile(reference_ + kLastCheckpoint, root_ + "/checkpoint-000012.skein");
}

TEST_F(TrainingPipeline, AFullDiskLosesNothing) {
  FlyReference();
  // Larger than the records, smaller than a checkpoint: as a disk that fills up while saving.
  const auto limit_file_size = [] {
    const rlimit limit{8192, 8192};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
  };
  {
    RunningProgram program(TinyTraining(run_));
    ASSERT_TRUE(program.WaitUntil([&] { return HasCheckpoint(run_, 3); }));
    program.Signal(SIGTERM);
    ASSERT_EQ(program.Wait().exit_code, 0);
  }
  const auto before = CheckpointsIn(run_ + "/checkpoints").back();
  const std::string saved = ReadFile(before.path);
  const ProgramResult full = RunSkein({"train", "--resume", run_}, limit_file_size);
  EXPECT_EQ(full.exit_code, 1);
  ExpectOneLine(full.error, run_);
  EXPECT_TRUE(ReadFile(before.path) == saved);
  const ProgramResult result = RunSkein({"train", "--resume", run_});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  ExpectSameRun(reference_, run_);
}

TEST_F(TrainingPipeline, GoesOnWhenTheReaderOfItsOutputHasGone) {
  FlyReference();
  const ProgramResult result = RunSkein(TinyTraining(run_), [] {
    int ends[2];
    if (pipe(ends) != 0 || dup2(ends[1], STDOUT_FILENO) < 0) _exit(125);
    close(ends[0]);
    close(ends[1]);
  });
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_EQ(result.error, "");
  ExpectSameRun(reference_, run_);
  EXPECT_THAT(ReadFile(run_ + "/log.txt"), HasSubstr("the standard output broke: Broken pipe"));
}

TEST_F(TrainingPipeline, AnotherSimdTargetIsWarnedOf) {
  if (simd::ActiveTarget() == simd::Target::kScalar) GTEST_SKIP() << "needs another SIMD target";
  FlyReference();
  const auto scalar = [] { setenv("SKEIN_SIMD", "scalar", 1); };
  const ProgramResult other = RunSkein({"train", "--resume", reference_}, scalar);
  EXPECT_EQ(other.exit_code, 0) << other.error;
  EXPECT_THAT(other.output, HasSubstr("no longer bit-exact"));
}

TEST_F(TrainingPipeline, ALossThatIsNotFiniteStopsTheRunAndLeavesTheStateBefore) {
  // The standard deviation grows by e with every step until it is infinite.
  const ProgramResult result =
      RunSkein(TinyTraining(run_, {"--set", "ppo.learning_rate=1", "--set",
                                   "ppo.entropy_coefficient=1e6", "--set", "ppo.epochs=100"}));
  EXPECT_EQ(result.exit_code, 1);
  ExpectOneLine(result.error, "training exploded");
  EXPECT_THAT(result.error, HasSubstr("before-failure-"));
  const std::string path =
      result.error.substr(result.error.rfind(' ') + 1,
                          result.error.rfind(".skein") + 6 - (result.error.rfind(' ') + 1));
  const ProgramResult flown =
      RunSkein({"eval", "--policy", path, "--task", "heading", "--episodes", "32", "--set",
                "env.time_limit_steps=100", "--set", "env.heading.earliest_success_step=100"});
  EXPECT_EQ(flown.exit_code, 0) << flown.error;
}

TEST_F(TrainingPipeline, RewardsThatNothingCanBeLearntFromAreBlamedOnTheirWeight) {
  const ProgramResult result = RunSkein(
      TinyTraining(run_, {"--set", "env.reward.roll_rate=1e38", "--set", "env.reward.sideslip=2"}));
  EXPECT_EQ(result.exit_code, 1);
  ExpectOneLine(result.error, "the largest weight of the reward is env.reward.roll_rate = 1e+38");
}

TEST_F(TrainingPipeline, ADirectoryThatCannotBeMadeIsNamed) {
  const ProgramResult inside_a_file = CallSkein(TinyTraining("/dev/null/run"));
  EXPECT_EQ(inside_a_file.exit_code, 1);
  ExpectOneLine(inside_a_file.error, "/dev/null/run");
  WriteFile(root_ + "/file", "");
  const ProgramResult on_a_file = CallSkein(TinyTraining(root_ + "/file"));
  EXPECT_EQ(on_a_file.exit_code, 2);
  ExpectOneLine(on_a_file.error, root_ + "/file");
}

TEST_F(TrainingPipeline, ConfigurationErrorsLeaveNoDirectoryBehind) {
  for (const char* assignment :
       {"ppo.gama=0.9", "ppo.gamma=high", "ppo.gamma=2", "env.aircraft=balloon", "nonsense"}) {
    const ProgramResult result = CallSkein(TinyTraining(run_, {"--set", assignment}));
    EXPECT_EQ(result.exit_code, 2) << assignment;
    ExpectOneLine(result.error, "");
    EXPECT_FALSE(fs::exists(run_)) << assignment;
  }
}

}  // namespace
}  // namespace skein
