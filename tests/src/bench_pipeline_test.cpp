// SPDX-License-Identifier: Apache-2.0
// The benchmarks' commands, shortened.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "simd/target.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// `benchmark` of the learner with little to do.
std::vector<std::string> Small(const std::string& benchmark) {
  return {"bench",        benchmark,
          "--iterations", "1",
          "--set",        "ppo.num_aircraft=64",
          "--set",        "ppo.rollout_steps=16",
          "--set",        "ppo.chunk_length=8",
          "--set",        "ppo.minibatches=2"};
}

TEST(Bench, SignatureIsTheSameForAnyNumberOfThreads) {
  const ScratchDirectory scratch;
  std::string first;
  for (const char* threads : {"1", "2", "8"}) {
    const std::string path = scratch / (std::string(threads) + ".json");
    const ProgramResult result =
        CallSkein({"bench", "signature", "--threads", threads, "--json", path});
    ASSERT_EQ(result.exit_code, 0) << result.error;
    const std::string signature =
        nlohmann::json::parse(ReadFile(path))["signature"].get<std::string>();
    EXPECT_EQ(signature.size(), 16u);
    EXPECT_THAT(result.output, HasSubstr(signature));
    if (first.empty()) first = signature;
    EXPECT_EQ(signature, first) << threads << " threads";
  }
}

TEST(Bench, ReportsRatesAndTheirShareOfThePeak) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "result.json";
  const auto measure = [&path](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", path});
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    auto json = nlohmann::json::parse(ReadFile(path));
    EXPECT_GT(json["fraction_of_peak"], 0);
    EXPECT_DOUBLE_EQ(json["fraction_of_peak"].get<double>(),
                     json["gflops"].get<double>() / json["peak_gflops"].get<double>());
    EXPECT_GE(json["threads"], 1);
    return json;
  };
  const auto held =
      measure({"bench", "sim", "--num-aircraft", "2000", "--steps", "3", "--action-repeat", "2"});
  EXPECT_GT(held["plant"]["aircraft_steps_per_s"], 0);
  EXPECT_EQ(held["action_repeat"], 2);
  EXPECT_EQ(held["settings"]["action_repeat"], 2);
  EXPECT_GT(held["environment_unheld"]["step_ms"], 0);
  const auto rollouts = measure(Small("rollout"));
  EXPECT_GT(rollouts["policy_steps_per_s"], 0);
  EXPECT_GT(rollouts["simulator_share"], 0);
  EXPECT_LT(rollouts["simulator_share"], 1);
  const auto updates = measure(Small("update"));
  EXPECT_GT(updates["samples_per_s"], 0);
  EXPECT_EQ(updates["learners"].back()["backend"], "libtorch");
  EXPECT_EQ(updates["learners"].back()["times_libtorch"], 1);
}

TEST(Bench, SaysWhenLibTorchDoesNotKnowTheProcessor) {
  if (!simd::FusesMultiplyAdd(simd::ActiveTarget())) GTEST_SKIP() << "a processor without AVX2";
  const auto update = [](const char* processor) {
    return RunSkein(Small("update"), [processor] { setenv("OPENBLAS_CORETYPE", processor, 1); });
  };
  const ScratchDirectory scratch;
  const std::string path = scratch / "info.json";
  RunSkein({"info", "--json", path}, [] { setenv("OPENBLAS_CORETYPE", "Prescott", 1); });
  const auto info = nlohmann::json::parse(ReadFile(path));
  if (info["libtorch"].is_null()) GTEST_SKIP() << "without LibTorch";
  ASSERT_EQ(info["libtorch_openblas"], "Prescott") << "of Debian's, which scripts/setup installs";
  const auto says = HasSubstr("LibTorch multiplies without AVX");
  const ProgramResult slow = update("Prescott"), fast = update("Haswell");
  EXPECT_EQ(slow.exit_code, 0) << slow.error;
  EXPECT_THAT(slow.output, says);
  EXPECT_EQ(fast.exit_code, 0) << fast.error;
  EXPECT_THAT(fast.output, Not(says));
}

TEST(Bench, OfIterationsSaysWhatABudgetWouldTake) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "result.json";
  const std::vector<std::string> high_level = {"--task",  "tracking",    "--preset",
                                               "planner", "--low-level", "autopilot"};
  for (const auto& task : {std::vector<std::string>{}, high_level}) {
    std::vector<std::string> arguments = Small("iteration");
    arguments.insert(arguments.end(), {"--json", path});
    arguments.insert(arguments.end(), task.begin(), task.end());
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_EQ(result.output.find("the low-level policy") != std::string::npos, !task.empty());
    const auto json = nlohmann::json::parse(ReadFile(path));
    EXPECT_GT(json["efficiency"], 0);
    EXPECT_LE(json["efficiency"], 1);
    constexpr Tolerance kOneStep{1, "digits of the JSON"};
    EXPECT_NEAR(json["budget_h"].get<double>() * 3600 * json["control_steps_per_s"].get<double>(),
                json["budget_steps"].get<double>(), kOneStep);
  }
}

TEST(Bench, OfHighLevelsNeedsALowLevelPolicy) {
  const ProgramResult result =
      CallSkein({"bench", "rollout", "--task", "tracking", "--preset", "planner"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.error.find("needs --low-level"), std::string::npos) << result.error;
}

}  // namespace
}  // namespace skein
