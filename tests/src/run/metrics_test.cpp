// SPDX-License-Identifier: Apache-2.0
#include "src/run/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "base/error.h"
#include "src/files/csv_columns.h"
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
  EXPECT_EQ(commas(TimingHeader()), commas(TimingRow({}, 0, {})));
}

TEST(Metrics, TimesStandUnderTheirNames) {
  IterationReport report;
  report.iteration = 1;
  report.env_steps = 2;
  report.rollout_seconds = 4;
  report.update_seconds = 5;
  report.evaluation_seconds = 6;
  report.simulator_seconds = 7;
  report.gradient_seconds = 8;
  TurnSeconds turn;
  turn.files = 9;
  turn.start = 10;
  turn.whole = 11;
  const CsvColumns timing = ParseCsv(TimingHeader() + TimingRow(report, 3, turn));
  const std::pair<const char*, double> expected[] = {
      {"iteration", 1}, {"env_steps", 2},    {"unix_time_s", 3}, {"rollout_s", 4},
      {"update_s", 5},  {"evaluation_s", 6}, {"simulator_s", 7}, {"gradient_s", 8},
      {"files_s", 9},   {"start_s", 10},     {"whole_s", 11}};
  ASSERT_EQ(timing.names.size(), std::size(expected));
  ASSERT_EQ(timing.rows(), 1u);
  for (const auto& [name, value] : expected) {
    const std::vector<double>* const column = timing.Find(name);
    ASSERT_NE(column, nullptr) << name;
    EXPECT_EQ(column->front(), value) << name;
  }
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
  for (const auto& [name, value] : Scalars(report, 1000)) {
    EXPECT_TRUE(std::isfinite(value)) << name;
    EXPECT_NE(name, "train/return_mean");
    EXPECT_NE(name, "eval/success_rate");
    EXPECT_NE(name, "time/fps");
  }
}

TEST(Metrics, ScalarsAreGroupedAsTensorBoardShowsThem) {
  IterationReport report;
  report.evaluation_success_rate = 0.75;
  report.evaluation_hold_within = 0.5;
  report.rollout_seconds = 1.5;
  report.update_seconds = 2.5;
  report.episodes = 4;
  report.terminations[static_cast<std::size_t>(Termination::kTargetReached)] = 3;
  report.terminations[static_cast<std::size_t>(Termination::kLowAltitude)] = 1;
  const auto scalars = Scalars(report, 1000);
  const auto value = [&scalars](const std::string& tag) {
    for (const auto& [name, number] : scalars) {
      if (name == tag) return number;
    }
    return std::nan("");
  };
  EXPECT_EQ(value("eval/success_rate"), 0.75);
  EXPECT_EQ(value("eval/hold_within"), 0.5);
  EXPECT_EQ(value("time/fps"), 250);
  EXPECT_EQ(value("ended/target_reached"), 0.75);
  EXPECT_EQ(value("ended/low_altitude"), 0.25);
  EXPECT_EQ(value("train/return_mean"), 0);
}

TEST_F(MetricsFileTest, TrimKeepsRowsUpToTheIteration) {
  const std::string path = FileWith("iteration,x\n1,a\n2,b\n3,c\n");
  EXPECT_EQ(TrimRows(path, 2, "iteration,x\n"), 2u);
  EXPECT_EQ(ReadFile(path), "iteration,x\n1,a\n2,b\n");
}

TEST_F(MetricsFileTest, TrimDropsATornRow) {
  const std::string path = FileWith("iteration,x\n1,a\n2,b\n3");
  EXPECT_EQ(TrimRows(path, 9, "iteration,x\n"), 2u);
  EXPECT_EQ(ReadFile(path), "iteration,x\n1,a\n2,b\n");
}

TEST_F(MetricsFileTest, TrimOfATornHeaderLeavesAnEmptyFile) {
  const std::string path = FileWith("iterat");
  EXPECT_EQ(TrimRows(path, 9, "iteration,x\n"), 0u);
  EXPECT_EQ(ReadFile(path), "");
}

TEST_F(MetricsFileTest, TrimRenamesTheColumnsOfAnOlderVersion) {
  const std::string path = FileWith("iteration,ended_ResetTarget\n1,5\n2,6\n");
  EXPECT_EQ(TrimRows(path, 2, "iteration,ended_target_reached\n"), 2u);
  EXPECT_EQ(ReadFile(path), "iteration,ended_target_reached\n1,5\n2,6\n");
}

TEST_F(MetricsFileTest, TrimLeavesCellsEmptyThatAnOlderVersionDidNotHave) {
  const std::string path = FileWith("iteration,x\n1,5\n2,6\n3,7\n");
  EXPECT_EQ(TrimRows(path, 2, "iteration,x,y,z\n"), 2u);
  EXPECT_EQ(ReadFile(path), "iteration,x,y,z\n1,5,,\n2,6,,\n");
}

TEST_F(MetricsFileTest, TrimRefusesMoreColumns) {
  const std::string path = FileWith("iteration,x,y\n1,5,6\n");
  EXPECT_THROW(TrimRows(path, 2, "iteration,x\n"), Error);
  EXPECT_EQ(ReadFile(path), "iteration,x,y\n1,5,6\n");
}

TEST_F(MetricsFileTest, TrimOfNoFileIsNothing) {
  EXPECT_EQ(TrimRows(scratch_ / "absent.csv", 3, "iteration,x\n"), 0u);
}

}  // namespace
}  // namespace skein
