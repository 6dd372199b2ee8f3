// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "src/bench/version.h"
#include "src/config/configuration.h"
#include "src/evaluation/recording_limit.h"
#include "src/files/output_file.h"
#include "src/report/report_data.h"
#include "src/report/report_page.h"
#include "src/report/run_record.h"
#include "src/report/training_times.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"
#include "tests/src/report/report_client.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

/// The document of what ReportData returns (src/report/data_pack.h).
nlohmann::ordered_json DocumentOf(const std::string& data) {
  std::string bytes(std::size_t{1} << 24, '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(data.data()), data.size()),
            Z_OK);
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof length);
  return nlohmann::ordered_json::parse(bytes.substr(sizeof length, length));
}

/// Reports on the run of a training that takes a moment.
class ReportPipeline : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchDirectory;
    const ProgramResult result = CallSkein(TinyTraining(*folder_ / "run"));
    ASSERT_EQ(result.exit_code, 0) << result.error;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  /// A copy of the run that a test may damage.
  std::string Copy(const std::string& name = "copy") const {
    const std::string path = scratch_ / name;
    std::filesystem::copy(*folder_ / "run", path, std::filesystem::copy_options::recursive);
    return path;
  }

  static ScratchDirectory* folder_;
  const ScratchDirectory scratch_;
};

ScratchDirectory* ReportPipeline::folder_ = nullptr;

TEST_F(ReportPipeline, DataDependOnTheRunAloneAndNotOnThreads) {
  ReportRequest request;
  request.runs = {*folder_ / "run"};
  request.episodes = 8;
  request.flights = 2;
  request.made = "once";
  WorkerPool one(1), three(3);
  EXPECT_EQ(ReportData(request, one), ReportData(request, three));
}

TEST_F(ReportPipeline, ARunCutShortShowsWhatIsThere) {
  const std::string run = Copy();
  const std::string metrics = ReadFile(run + "/metrics.csv");
  WriteFile(run + "/metrics.csv", metrics.substr(0, metrics.size() - 20));
  WriteFile(run + "/evaluation.json", "{\"policy\": ");
  std::filesystem::remove_all(run + "/checkpoints");
  std::filesystem::remove(run + "/timing.csv");
  const RunRecord record = ReadRunRecord(run);
  EXPECT_EQ(record.metrics.rows(), static_cast<std::size_t>(kIterations - 1));
  EXPECT_THAT(record.notes, Contains(HasSubstr("metrics.csv: 1 row cut short")));
  EXPECT_THAT(record.notes, Contains(HasSubstr("evaluation.json: damaged")));
  EXPECT_THAT(record.notes, Contains(HasSubstr("timing.csv: not there")));
  WorkerPool pool(1);
  ReportRequest request;
  request.runs = {run};
  EXPECT_FALSE(ReportData(request, pool).empty());
}

TEST_F(ReportPipeline, ARunWithoutAnIterationIsOneLine) {
  const std::string run = Copy();
  const std::string metrics = ReadFile(run + "/metrics.csv");
  for (const std::string& text : {std::string(), metrics.substr(0, metrics.find('\n') + 1),
                                  metrics.substr(0, metrics.find('\n') - 5)}) {
    WriteFile(run + "/metrics.csv", text);
    const ProgramResult result = CallSkein({"report", run});
    EXPECT_EQ(result.exit_code, 1);
    ExpectOneLine(result.error, "nothing to show");
  }
  std::filesystem::create_directory(scratch_ / "empty");
  const ProgramResult empty = CallSkein({"report", scratch_ / "empty"});
  EXPECT_EQ(empty.exit_code, 2);
  ExpectOneLine(empty.error, "no config.toml");
}

TEST_F(ReportPipeline, ARunOfWhosePolicyNothingIsLeftSaysSoBesideItsCurves) {
  const std::string run = Copy();
  std::filesystem::remove_all(run + "/checkpoints");
  WorkerPool pool(1);
  ReportRequest request;
  request.runs = {run};
  const std::string without = ReportData(request, pool);
  request.runs = {*folder_ / "run"};
  EXPECT_LT(without.size(), ReportData(request, pool).size() / 2);
}

TEST_F(ReportPipeline, AWrittenComparisonIsShownWithoutFlyingAgain) {
  WorkerPool pool(1);
  ReportRequest request;
  request.runs = {*folder_ / "run"};
  request.episodes = 0;
  request.flights = 1;  // so that policies fly, but not for a comparison
  const ProgramConfig config = ReadRunRecord(request.runs.front()).config;
  const auto shown = ShownComparison({{"task", "heading"}}, config);
  EXPECT_FALSE(shown["quantities"].empty());
  request.comparisons = {shown};
  const auto document = DocumentOf(ReportData(request, pool));
  EXPECT_THAT(document["comparisons"], ElementsAre(shown));
  EXPECT_THAT(document["flights"], SizeIs(1));
}

TEST_F(ReportPipeline, AComparisonThatIsFlownStandsBehindTheWrittenOne) {
  WorkerPool pool(1);
  ReportRequest request;
  request.runs = {*folder_ / "run"};
  request.episodes = 8;
  request.flights = 0;
  const auto flown = DocumentOf(ReportData(request, pool))["comparisons"];
  ASSERT_THAT(flown, SizeIs(1));
  EXPECT_EQ(flown[0]["episodes"], 8);
  const ProgramConfig config = ReadRunRecord(request.runs.front()).config;
  const auto shown = ShownComparison({{"task", "heading"}}, config);
  request.comparisons = {shown};
  EXPECT_THAT(DocumentOf(ReportData(request, pool))["comparisons"], ElementsAre(shown, flown[0]));
}

TEST_F(ReportPipeline, WatchServesWhatTheRunHasByNowUntilItIsStopped) {
  const std::string run = Copy(), metrics = ReadFile(run + "/metrics.csv");
  WriteFile(run + "/metrics.csv", metrics.substr(0, metrics.rfind('\n', metrics.size() - 2) + 1));
  RunningProgram program({"report", run, "--watch", "--episodes", "0", "--flights-count", "0"});
  std::string address;
  const bool serves = program.WaitUntil([&] {
    const std::string output = program.output();
    address = output.substr(0, output.find(' '));
    return output.find('\n') != std::string::npos;
  });
  if (!serves) {
    ASSERT_THAT(program.Wait().error, HasSubstr("this build has no page for reports"));
    GTEST_SKIP() << "built without the page";
  }
  ASSERT_THAT(address, StartsWith("http://127.0.0.1:"));
  EXPECT_THAT(ReportClient(address).Get("/"), StartsWith("HTTP/1.1 200 OK"));
  const auto iterations = [&address] {
    const std::string answer = ReportClient(address).Get("/data"), end = "\r\n\r\n";
    const auto document = DocumentOf(answer.substr(answer.find(end) + end.size()));
    return document["runs"][0]["metrics"]["iteration"]["f32"][1];
  };
  EXPECT_EQ(iterations(), kIterations - 1);
  WriteFile(run + "/metrics.csv", metrics);
  EXPECT_EQ(iterations(), kIterations);
  program.Signal(SIGTERM);
  const ProgramResult result = program.Wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.error, "");
}

/// By key, what a page of flights by `config` takes for the better side.
std::map<std::string, std::string> BetterSides(const ProgramConfig& config) {
  std::map<std::string, std::string> sides;
  const auto shown = ShownComparison({{"task", "heading"}}, config);
  for (const auto& quantity : shown["quantities"]) {
    sides[quantity["key"]] = quantity["better"];
  }
  return sides;
}

TEST(ReportedQuantities, SayWhichSideIsTheBetterOne) {
  ProgramConfig config = ResolveConfig({"heading", "default", "", {}});
  config.train.env.hold_s = 30;
  config.train.env.heading.dwell_s = 1;
  std::map<std::string, std::string> sides = BetterSides(config);
  for (const char* key : {"success_rate", "return", "alpha_margin", "smoothness", "hold_within"}) {
    EXPECT_EQ(sides[key], "higher") << key;
  }
  for (const char* key : {"time_to_target_s", "time_held_s", "roll_variation_per_s",
                          "hold_rms_p_deg_s", "hold_lost", "hold_pitch_reversals_per_s"}) {
    EXPECT_EQ(sides[key], "lower") << key;
  }
  for (const char* key : {"load_factor_g", "mach", "climb_rate_fps", "abs_alpha_deg"}) {
    EXPECT_EQ(sides.count(key), 1) << key;
    EXPECT_EQ(sides[key], "") << key;
  }
  config.train.env.hold_s = config.train.env.heading.dwell_s = 0;
  config.train.env.mission.length_s = 60;
  sides = BetterSides(config);
  EXPECT_EQ(sides["targets_per_minute"], "higher");
  EXPECT_EQ(sides["targets_missed"], "lower");
  EXPECT_EQ(sides["losses_per_hour"], "lower");
}

TEST_F(ReportPipeline, SharesOfATrainingsTimeSumToOne) {
  const std::string run = Copy();
  const std::optional<TrainingTimes> times = TimesOf(ReadRunRecord(run));
  ASSERT_TRUE(times);
  EXPECT_GT(times->seconds, 0);
  double sum = 0;
  for (const auto& [name, share] : times->shares) {
    EXPECT_GE(share, 0) << name;
    sum += share;
  }
  constexpr double kRounding = 1e-9;
  EXPECT_NEAR(sum, 1, kRounding);
  const ProgramResult told = CallSkein(
      {"report", run, "--episodes", "0", "--flights-count", "0", "--json", scratch_ / "times"});
  EXPECT_THAT(told.output, HasSubstr("environment ")) << "also by a build without a page";
  const auto json = nlohmann::json::parse(ReadFile(scratch_ / "times"));
  EXPECT_EQ(json[0]["seconds"], times->seconds);
  EXPECT_EQ(json[0]["shares"].size(), times->shares.size());
  EXPECT_EQ(json[0]["program"]["version"], Build().version);
}

TEST_F(ReportPipeline, TheTimeToATrainedPolicyIsThatOfItsEvaluation) {
  RunRecord run;
  run.metrics.names = {"iteration", "evaluation_success_rate"};
  run.metrics.values = {{1, 2, 3}, {std::nan(""), 0.95, 1}};
  run.timing.names = {"iteration",  "rollout_s", "update_s", "evaluation_s", "simulator_s",
                      "gradient_s", "files_s",   "start_s",  "whole_s"};
  run.timing.values = {{1, 2, 3}, {2, 2, 2},     {4, 4, 4}, {0, 1, 1}, {1, 1, 1},
                       {3, 3, 3}, {0, 0.5, 0.5}, {1, 0, 0}, {8, 8, 8}};
  const std::optional<TrainingTimes> times = TimesOf(run);
  ASSERT_TRUE(times);
  EXPECT_EQ(times->seconds, 24);
  EXPECT_EQ(times->seconds_to_trained, 16);
  EXPECT_THAT(
      times->shares,
      testing::ElementsAre(testing::Pair("environment", 3. / 24), testing::Pair("policy", 3. / 24),
                           testing::Pair("gradients", 9. / 24), testing::Pair("optimiser", 3. / 24),
                           testing::Pair("evaluation", 2. / 24), testing::Pair("files", 1. / 24),
                           testing::Pair("start", 1. / 24), testing::Pair("other", 2. / 24)));
  run.metrics.values[1] = {0.5, 0.6, 0.7};
  EXPECT_EQ(TimesOf(run)->seconds_to_trained, std::nullopt);
  run.timing.values[8][0] = std::nan("");
  EXPECT_FALSE(TimesOf(run)) << "a row of an older version";
}

TEST_F(ReportPipeline, WhatARunHoldsIsNotWrittenOver) {
  const std::string run = Copy();
  for (const std::string& file : {run + "/metrics.csv", run + "/checkpoints/policy-final.skein"}) {
    const std::string before = ReadFile(file);
    for (const std::vector<std::string>& option :
         std::vector<std::vector<std::string>>{{"--json", file}, {"-o", file}}) {
      const ProgramResult result = CallSkein({"report", run, option[0], option[1]});
      EXPECT_EQ(result.exit_code, 2);
      ExpectOneLine(result.error, file + ": is read, too");
      EXPECT_EQ(ReadFile(file), before);
    }
  }
}

TEST_F(ReportPipeline, WhatIsNoRunIsOneLine) {
  const ProgramResult missing = CallSkein({"report", scratch_ / "nothing"});
  EXPECT_EQ(missing.exit_code, 2);
  ExpectOneLine(missing.error, "not the directory of a run");
  const std::string newer = Copy();
  WriteFile(newer + "/config.toml", ReadFile(newer + "/config.toml") + "[later]\nkey = 1\n");
  const ProgramResult unknown = CallSkein({"report", newer});
  EXPECT_EQ(unknown.exit_code, 1);
  ExpectOneLine(unknown.error, "later");
  EXPECT_EQ(CallSkein({"report"}).exit_code, 2);
}

TEST_F(ReportPipeline, MoreFlightsThanMemoryHoldsAreRefusedIfAskedForElseFewer) {
  WorkerPool pool(1);
  ReportRequest request;
  request.runs = {*folder_ / "run"};
  request.flights = 1000000;
  request.flights_option = "--flights";
  EXPECT_THAT(MessageOf([&] { ReportData(request, pool); }),
              HasSubstr(" are the most: lower --flights"));

  EnvConfig env;
  env.mission.length_s = 3600;
  EXPECT_EQ(MostFlights(3, LongestFlight(env), env), 9) << "of 180,000 control steps";
  env.mission.length_s = 1e6;
  EXPECT_EQ(MostFlights(3, LongestFlight(env), env), 0);
}

TEST_F(ReportPipeline, AnUnwritablePathIsSaidFirst) {
  const ProgramResult result =
      CallSkein({"report", *folder_ / "run", "-o", scratch_ / "no" + std::string("/page.html")});
  EXPECT_EQ(result.exit_code, 2);
  ExpectOneLine(result.error, "page.html");
}

TEST_F(ReportPipeline, ATrainingSaysWhereItsReportIsOrThatThereIsNone) {
  const ProgramResult result = CallSkein(TinyTraining(scratch_ / "run"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output, HasSubstr("\nreport          "));
  EXPECT_EQ(std::filesystem::exists(scratch_ / "run/report.html"),
            FindReportTemplate().has_value());
}

TEST_F(ReportPipeline, AChangedSettingIsMarkedBesideThePresets) {
  const RunRecord record = ReadRunRecord(*folder_ / "run");
  EXPECT_EQ(record.preset, "default");
  bool has_changed = false, has_same = false;
  for (const auto& row : ConfigurationJson(record)) {
    if (row["key"] == "ppo.num_aircraft") {
      has_changed = row["value"] == "64" && row.contains("preset");
    }
    if (row["key"] == "env.control_interval_s") has_same = !row.contains("preset");
  }
  EXPECT_TRUE(has_changed);
  EXPECT_TRUE(has_same);
}

}  // namespace
}  // namespace skein
