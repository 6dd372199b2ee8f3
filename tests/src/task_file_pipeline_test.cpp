// SPDX-License-Identifier: Apache-2.0
// A task file through the program: trained, resumed, evaluated and exported, and the original gone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

class TaskFilePipelineTest : public testing::Test {
 protected:
  ProgramResult Train(const std::string& out) {
    return CallSkein(TinyTrainingOf(file_, out, {"--seed", "3"}));
  }

  ScratchDirectory scratch_;
  const std::string text_ = ReadFile(SKEIN_SOURCE "/examples/tasks/bank_and_altitude.toml");
  const std::string file_ = scratch_ / "my_task.toml", run_ = scratch_ / "run";
};

TEST_F(TaskFilePipelineTest, NeedsItsFileNoMoreOnceItIsTrained) {
  WriteFile(file_, text_);
  const ProgramResult trained = Train(run_);
  ASSERT_EQ(trained.exit_code, 0) << trained.error;
  std::filesystem::remove(file_);
  ExpectSameFile(run_ + "/task.toml", SKEIN_SOURCE "/examples/tasks/bank_and_altitude.toml");

  const std::string policy = run_ + "/checkpoints/policy-final.skein";
  for (const std::string& of : {run_, policy}) {
    const std::string flights = scratch_ / "flights.csv";
    const ProgramResult result = CallSkein({"eval", "--policy", of, "--episodes", "32", "--flights",
                                            flights, "--flights-observations"});
    ASSERT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.output, HasSubstr("on bank_and_altitude"));
    EXPECT_THAT(ReadFile(flights), HasSubstr("observation_climb_rate_fps_scaled"));
  }
  // Every form says what the task's own numbers are, in its bytes.
  for (const char* format : {"c", "onnx", "safetensors"}) {
    const std::string out = scratch_ / (std::string("policy.") + format);
    const ProgramResult exported = CallSkein({"export", policy, "--format", format, "-o", out});
    ASSERT_EQ(exported.exit_code, 0) << exported.error;
    EXPECT_THAT(exported.output, HasSubstr("task bank_and_altitude"));
    for (const char* number : {"climb_rate_fps", "error_roll", "error_altitude"}) {
      EXPECT_THAT(ReadFile(out), HasSubstr(number)) << format;
    }
  }
  EXPECT_THAT(ReadFile(scratch_ / "policy.c"), HasSubstr("bank_and_altitude_step("));
}

TEST_F(TaskFilePipelineTest, SaysOfNoOtherTaskThatItIsFlown) {
  for (const char* other :
       {"task = \"heading\"", "task_file_hash = \"0123\"", "task_interface = \"0123\""}) {
    WriteFile(file_, text_ + "\n[env]\n" + other + "\n");
    const ProgramResult result =
        CallSkein({"compare", "--task", file_, "--agents", "zero", "--no-html"});
    EXPECT_EQ(result.exit_code, 2) << other;
    EXPECT_THAT(result.error, HasSubstr(file_));
    EXPECT_THAT(result.error, HasSubstr("says env.task"));
  }
}

TEST_F(TaskFilePipelineTest, ResumesToTheSameBits) {
  WriteFile(file_, text_);
  const std::string other = scratch_ / "other";
  ASSERT_EQ(Train(run_).exit_code, 0);
  ASSERT_EQ(Train(other).exit_code, 0);
  const std::string final_policy = "/checkpoints/policy-final.skein";
  ExpectSameFile(run_ + final_policy, other + final_policy);
  std::filesystem::remove(other + final_policy);
  std::filesystem::remove(file_);
  const ProgramResult resumed = CallSkein({"train", "--resume", other});
  ASSERT_EQ(resumed.exit_code, 0) << resumed.error;
  ExpectSameFile(run_ + final_policy, other + final_policy);
}

TEST_F(TaskFilePipelineTest, BenchmarksOfAChangedFileSayThatTheyAreOfAnother) {
  const std::string before = scratch_ / "before.json", after = scratch_ / "after.json";
  WriteFile(file_, text_);
  for (const std::string& json : {before, after}) {
    const ProgramResult result = CallSkein({"bench", "sim", "--task", file_, "--num-aircraft", "64",
                                            "--steps", "2", "--threads", "1", "--json", json});
    ASSERT_EQ(result.exit_code, 0) << result.error;
    WriteFile(file_, text_ + "\n# changed\n");
  }
  const ProgramResult compared = CallSkein({"bench", "compare", before, after});
  EXPECT_EQ(compared.exit_code, 0) << compared.error;
  EXPECT_THAT(compared.output, HasSubstr("differ  task_hash "));
}

TEST_F(TaskFilePipelineTest, RefusesWhatIsNotItsOwn) {
  WriteFile(file_, text_);
  ASSERT_EQ(Train(run_).exit_code, 0);
  const auto eval = [this](const std::string& task) {
    return CallSkein({"eval", "--policy", run_, "--task", task, "--episodes", "8"});
  };
  const ProgramResult built_in = eval("heading");
  EXPECT_NE(built_in.exit_code, 0);
  ExpectOneLine(built_in.error, "bank_and_altitude");

  // Dearer rewards are no other task to a policy; other numbers are.
  WriteFile(file_, Replaced(text_, "weight = -1", "weight = -2"));
  EXPECT_EQ(eval(file_).exit_code, 0);
  const ProgramResult edited = CallSkein({"train", file_, "--resume", run_});
  EXPECT_EQ(edited.exit_code, 2);
  ExpectOneLine(edited.error, "says something else now; begin a new run instead");
  WriteFile(file_, Replaced(text_, "unit = 100", "unit = 50"));
  const ProgramResult other = eval(file_);
  EXPECT_NE(other.exit_code, 0);
  ExpectOneLine(other.error, "other units");

  WriteFile(run_ + "/task.toml", text_ + "# changed\n");
  const ProgramResult changed = CallSkein({"train", "--resume", run_});
  EXPECT_NE(changed.exit_code, 0);
  ExpectOneLine(changed.error, "is not the task file that");

  const ProgramResult missing = CallSkein({"train", scratch_ / "nowhere.toml"});
  EXPECT_EQ(missing.exit_code, 2);
  ExpectOneLine(missing.error, "nowhere.toml");
  const ProgramResult preset = CallSkein({"train", file_, "--preset", "paper"});
  EXPECT_EQ(preset.exit_code, 2);
  ExpectOneLine(preset.error, "a task file brings its own settings");
}

}  // namespace
}  // namespace skein
