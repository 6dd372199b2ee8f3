// SPDX-License-Identifier: Apache-2.0
#include "src/run/run_summary.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

/// A run of Heading with a budget of two million control steps.
class RunSummaryTest : public ::testing::Test {
 protected:
  RunSummaryTest() {
    std::filesystem::create_directory(run_);
    WriteFile(run_ + "/config.toml",
              DumpToml(ResolveConfig({"heading", "default", "", {"run.total_steps=2000000"}})));
  }
  RunSummary Summary() const { return SummariseRuns(scratch_.path()).at(0); }

  const ScratchDirectory scratch_;
  const std::string run_ = scratch_ / "run";
};

TEST_F(RunSummaryTest, StepsAreThoseOfTheLastWholeRow) {
  const std::string header = "iteration,env_steps,x\n", rows = "1,1000,5\n2,250000,6\n";
  EXPECT_EQ(Summary().steps, "0 of 2.00 M");
  for (const auto& [text, steps] : {std::pair<std::string, std::string>{header, "0"},
                                    {header + "1,1000,5\n", "1.00 k"},
                                    {header + rows, "250 k"},
                                    {header + rows + "3,9999", "250 k"}}) {
    WriteFile(run_ + "/metrics.csv", text);
    EXPECT_EQ(Summary().steps, steps + " of 2.00 M") << text;
  }
}

TEST_F(RunSummaryTest, ARunIsFinishedOnceItIsEvaluated) {
  EXPECT_EQ(Summary().state, "stopped");
  EXPECT_EQ(Summary().success, "-");
  WriteFile(run_ + "/evaluation.json", R"({"success_rate": 0.875})");
  EXPECT_EQ(Summary().state, "finished");
  EXPECT_EQ(Summary().success, "87.5 %");
  EXPECT_EQ(Summary().task, "heading");
}

}  // namespace
}  // namespace skein
