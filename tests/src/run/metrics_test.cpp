// SPDX-License-Identifier: Apache-2.0
#include "src/run/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

/// The metrics of a run: a file with given text.
class MetricsFileTest : public testing::Test {
 protected:
  std::string FileWith(const std::string& text) const {
    const std::string path = scratch_ / "metrics.csv";
    WriteFile(path, text);
    return path;
  }

  const ScratchDirectory scratch_;
};

TEST(Metrics, RowsHaveTheColumnsOfTheHeader) {
  const auto commas = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  EXPECT_EQ(commas(MetricsHeader()), commas(MetricsRow({})));
  EXPECT_EQ(commas(TimingHeader()), commas(TimingRow({}, 0)));
}

TEST(Metrics, NoColumnOfMetricsDependsOnTheClock) {
  IterationReport a, b;
  b.rollout_seconds = b.update_seconds = b.evaluation_seconds = 5;
  EXPECT_EQ(MetricsRow(a), MetricsRow(b));
}

TEST(Metrics, NumbersKeepEveryDigitAndMissingOnesAreEmpty) {
  IterationReport report;
  report.iteration = 7;
  report.return_mean = 0.1 + 0.2;
  report.success_rate = std::nan("");
  const std::string row = MetricsRow(report);
  EXPECT_EQ(row.substr(0, row.find(",0,", 6)), "7,0,0,0.30000000000000004,,");
}

TEST(Metrics, ScalarsLeaveOutWhatDoesNotExist) {
  IterationReport report;
  report.return_mean = std::nan("");
  for (const auto& [name, value] : Scalars(report)) {
    EXPECT_TRUE(std::isfinite(value)) << name;
    EXPECT_NE(name, "train/return_mean");
    EXPECT_NE(name, "train/evaluation_success_rate");
  }
}

TEST_F(MetricsFileTest, TrimKeepsRowsUpToTheIteration) {
  const std::string path = FileWith("iteration,x\n1,a\n2,b\n3,c\n");
  EXPECT_EQ(TrimRows(path, 2), 2u);
  EXPECT_EQ(ReadFile(path), "iteration,x\n1,a\n2,b\n");
}

TEST_F(MetricsFileTest, TrimDropsATornRow) {
  const std::string path = FileWith("iteration,x\n1,a\n2,b\n3");
  EXPECT_EQ(TrimRows(path, 9), 2u);
  EXPECT_EQ(ReadFile(path), "iteration,x\n1,a\n2,b\n");
}

TEST_F(MetricsFileTest, TrimOfATornHeaderLeavesAnEmptyFile) {
  const std::string path = FileWith("iterat");
  EXPECT_EQ(TrimRows(path, 9), 0u);
  EXPECT_EQ(ReadFile(path), "");
}

TEST_F(MetricsFileTest, TrimOfNoFileIsNothing) {
  EXPECT_EQ(TrimRows(scratch_ / "absent.csv", 3), 0u);
}

}  // namespace
}  // namespace skein
