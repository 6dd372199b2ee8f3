// The command line: help, wrong usage, and the commands without a pipeline of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "src/output_file.h"
#include "tests/src/run_program.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

TEST(Usage, EveryCommandHasHelp) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{},
                                             {"train"},
                                             {"eval"},
                                             {"fdm"},
                                             {"fdm", "trim"},
                                             {"fdm", "eval"},
                                             {"fdm", "simulate"},
                                             {"bench"},
                                             {"bench", "sim"},
                                             {"bench", "rollout"},
                                             {"bench", "update"},
                                             {"bench", "signature"},
                                             {"info"}}) {
    std::vector<std::string> arguments = command;
    arguments.push_back("--help");
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, HasSubstr("Usage: skein"));
    EXPECT_EQ(result.error, "");
  }
}

TEST(Usage, WrongUsageExitsWithTwoAndOneLine) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {},
           {"fly"},
           {"train"},
           {"train", "heading", "--stpes", "5"},
           {"train", "heading", "--steps", "many"},
           {"train", "heading", "--threads", "0"},
           {"eval"},
           {"eval", "--policy", "x", "--task", "heading", "--episodes", "0"},
           {"fdm", "eval", "--in", "x"},
           {"fdm", "eval", "--in", "x", "--out", "y", "--precision", "float16"},
           {"bench"}}) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.error;
    EXPECT_EQ(result.error.rfind("skein: error: ", 0), 0u) << result.error;
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    EXPECT_THAT(result.error, HasSubstr("--help"));
  }
}

TEST(Usage, UnknownTasksAndPresetsListTheKnownOnes) {
  EXPECT_THAT(CallSkein({"train", "heding"}).error,
              HasSubstr("unknown task heding; did you mean heading?"));
  EXPECT_THAT(CallSkein({"train", "heading", "--preset", "fast"}).error,
              HasSubstr("default, paper"));
}

TEST(Usage, HelpKeysListsEveryKeyWithItsValue) {
  const ProgramResult result = CallSkein({"train", "heading", "--help-keys"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("env.action_repeat = 5\n"));
}

TEST(Usage, InfoNamesWhatItRunsOn) {
  const std::string path = FreshDirectory("info") + "/info.json";
  const ProgramResult result =
      RunSkein({"info", "--json", path}, [] { setenv("SKEIN_SIMD", "scalar", 1); });
  EXPECT_EQ(result.exit_code, 0) << result.error;
  const auto info = nlohmann::json::parse(ReadFile(path));
  EXPECT_EQ(info["simd"], "scalar");
  EXPECT_GE(info["threads"], 1);
  EXPECT_NE(info["libtorch"], "");
}

TEST(Usage, AnUnknownSimdTargetIsAnError) {
  const ProgramResult result = RunSkein({"info"}, [] { setenv("SKEIN_SIMD", "mmx", 1); });
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.error, HasSubstr("mmx"));
}

TEST(Usage, AFullDeviceIsAnError) {
  const ProgramResult result = CallSkein({"info", "--json", "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.error, HasSubstr("/dev/full"));
}

TEST(Usage, SignatureIsTheSameForAnyNumberOfThreads) {
  const std::string folder = FreshDirectory("signature");
  std::string first;
  for (const char* threads : {"1", "2", "8"}) {
    const std::string path = folder + "/" + threads + ".json";
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

TEST(Usage, BenchSimReportsRates) {
  const std::string path = FreshDirectory("bench") + "/sim.json";
  const ProgramResult result =
      CallSkein({"bench", "sim", "--aircraft", "2000", "--steps", "3", "--json", path});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_GT(nlohmann::json::parse(ReadFile(path))["plant"]["aircraft_steps_per_s"], 0);
}

}  // namespace
}  // namespace skein
