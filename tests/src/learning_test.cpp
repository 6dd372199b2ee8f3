// SPDX-License-Identifier: Apache-2.0
// Trainings of minutes, as a user starts them: that the default presets learn what they are for.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"

namespace skein {
namespace {

/// Deterministic success over fresh episodes of a training of `task` over `steps` control steps.
double TrainedSuccess(const std::string& task, const std::string& steps,
                      const std::vector<std::string>& more = {}) {
  const ScratchDirectory scratch;
  const std::string out = scratch / "run";
  std::vector<std::string> arguments = {"train", task, "--steps", steps, "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramResult result = RunSkein(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.error;
  return nlohmann::json::parse(ReadFile(out + "/evaluation.json"))["success_rate"];
}

TEST(Learning, HeadingIsReachedAndHeldAfterAQuarterOfItsBudget) {
  EXPECT_GT(TrainedSuccess("heading", "1e8"), 0.9);
}

TEST(Learning, HeadingIsReachedAndHeldAfterAQuarterOfThatByTheQuickPreset) {
  EXPECT_GT(TrainedSuccess("heading", "2.5e7", {"--preset", "quick"}), 0.9);
}

TEST(Learning, ControlIsReachedAfterAFifthOfItsBudget) {
  EXPECT_GT(TrainedSuccess("control", "1.4e8"), 0.9);
}

TEST(Learning, PointsAreHitAfterHalfOfTrackingsBudget) {
  EXPECT_GT(TrainedSuccess("tracking", "4e8"), 0.95);
}

TEST(Learning, AHighLevelReachesHalfOfItsPointsAfterASixthOfItsBudget) {
  EXPECT_GT(TrainedSuccess(
                "tracking", "1e8",
                {"--preset", "planner", "--low-level", SKEIN_SOURCE "/policies/control.skein"}),
            0.5);
}

}  // namespace
}  // namespace skein
