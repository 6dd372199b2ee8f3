// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/tiny_training.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class PlotPipeline : public ::testing::Test {
 protected:
  ProgramResult Plot(const std::string& kind, const std::string& out,
                     const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"plot",       kind,
                                          "--task",     "heading",
                                          "--agents",   "zero,random:0.2",
                                          "--episodes", "2",
                                          "--set",      "env.time_limit_steps=60",
                                          "--set",      "env.heading.earliest_success_step=60",
                                          "-o",         scratch_ / out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return CallSkein(arguments);
  }

  const ScratchDirectory scratch_;
};

TEST_F(PlotPipeline, DrawsFlightsOfAgentsTwiceTheSame) {
  for (const std::string kind : {"space", "tracks", "flights"}) {
    const ProgramResult result = Plot(kind, kind + ".svg");
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_EQ(result.output, scratch_ / (kind + ".svg\n"));
    const std::string svg = ReadFile(scratch_ / (kind + ".svg"));
    EXPECT_THAT(svg, HasSubstr(">zero"));
    EXPECT_THAT(svg, HasSubstr(">random:0.2<"));
    Plot(kind, "again.svg", {"--threads", "1"});
    EXPECT_TRUE(svg == ReadFile(scratch_ / "again.svg")) << kind;
  }
}

TEST_F(PlotPipeline, SaysHowMuchLargerThanTheAircraftThatWasFlownItsPictureIs) {
  const auto number_before = [this](const std::string& picture, const std::string& words) {
    const std::string svg = ReadFile(scratch_ / picture);
    const std::size_t end = svg.find(words);
    EXPECT_NE(end, std::string::npos) << picture << " lacks " << words;
    if (end == std::string::npos) return 0.0;
    std::string number = svg.substr(svg.rfind(' ', end - 1) + 1);
    number.erase(std::remove(number.begin(), number.end(), ','), number.end());
    return std::stod(number);
  };
  const std::vector<std::string> flown = {"--task",     "heading",
                                          "--preset",   "aerosonde",
                                          "--agents",   "zero",
                                          "--episodes", "1",
                                          "--set",      "env.time_limit_steps=3000",
                                          "--set",      "env.heading.earliest_success_step=3000"};
  const auto call = [this, &flown](std::vector<std::string> words, const std::string& out) {
    words.insert(words.end(), flown.begin(), flown.end());
    words.insert(words.end(), {"-o", scratch_ / out});
    const ProgramResult result = CallSkein(words);
    EXPECT_EQ(result.exit_code, 0) << result.error;
  };
  call({"plot", "space"}, "flown.svg");
  call({"replay"}, "flights.csv");
  const ProgramResult read =
      CallSkein({"plot", "space", scratch_ / "flights.csv", "-o", scratch_ / "read.svg"});
  EXPECT_EQ(read.exit_code, 0) << read.error;
  // A file does not say which aircraft flew.
  const double of_f16 = number_before("read.svg", " times the size of an F-16");
  const double of_it = number_before("flown.svg", " times its true size");
  constexpr double kSpanF16_ft = 30, kSpanAerosonde_ft = 2.8956 / 0.3048;
  constexpr Tolerance kRounded{2.2, "both numbers are rounded to whole ones"};
  EXPECT_NEAR(of_it, of_f16 * kSpanF16_ft / kSpanAerosonde_ft, kRounded);
}

TEST_F(PlotPipeline, SaysThatItReplacesAPictureThatNobodyNamed) {
  const auto plot = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"plot",     "tracks", "--task",     "heading",
                                      "--agents", "zero",   "--episodes", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = RunSkein(words, [&] {
      if (chdir(scratch_.path().c_str()) != 0) _exit(1);
    });
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return result.output;
  };
  EXPECT_EQ(plot({}), "tracks.svg\n");
  EXPECT_EQ(plot({}), "tracks.svg (replaced)\n");
  EXPECT_EQ(plot({"-o", "tracks.svg"}), "tracks.svg\n");
}

TEST_F(PlotPipeline, AltitudesAreEnlargedAsAskedFor) {
  const ProgramResult result = Plot("space", "high.svg", {"--vertical-scale", "4"});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(ReadFile(scratch_ / "high.svg"), HasSubstr(">altitude enlarged 4 times<"));
}

TEST_F(PlotPipeline, TolerancesAreDrawnUpToTheLargest) {
  for (const std::string kind : {"space", "tracks", "flights"}) {
    const ProgramResult result =
        Plot(kind, "large.svg", {"--tolerance", "yaw_deg=180,altitude_ft=1e7"});
    EXPECT_EQ(result.exit_code, 0) << result.error;
  }
}

TEST_F(PlotPipeline, FilesAreDrawnAsTheirFlights) {
  const std::string flights = scratch_ / "flights.csv";
  const ProgramResult replay = CallSkein(
      {"replay", "--task", "heading", "--agents", "zero,random:0.2", "--episodes", "2", "--set",
       "env.time_limit_steps=60", "--set", "env.heading.earliest_success_step=60", "-o", flights});
  ASSERT_EQ(replay.exit_code, 0) << replay.error;
  const ProgramResult result =
      CallSkein({"plot", "tracks", scratch_ / "flights.zero.csv",
                 scratch_ / "flights.random-0.2.csv", "--names", "zero,random:0.2", "--tolerance",
                 "altitude_ft=100,yaw_deg=5,true_airspeed_fps=20", "-o", scratch_ / "files.svg"});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(ReadFile(scratch_ / "files.svg"), HasSubstr(">random:0.2<"));
}

TEST_F(PlotPipeline, DrawsATrainingAndWhatACrashHasLeftOfIt) {
  const std::string run = scratch_ / "run";
  ASSERT_EQ(CallSkein(TinyTraining(run)).exit_code, 0);
  const auto plot = [&](const std::string& column) {
    return CallSkein({"plot", "curves", run, "--columns", column, "-o", scratch_ / "curves.svg"});
  };
  EXPECT_EQ(plot("evaluation_success_rate,return_mean").exit_code, 0);
  EXPECT_THAT(ReadFile(scratch_ / "curves.svg"), HasSubstr("mean return of the training episodes"));
  std::filesystem::resize_file(run + "/metrics.csv",
                               std::filesystem::file_size(run + "/metrics.csv") - 20);
  const ProgramResult torn = plot("return_mean");
  EXPECT_EQ(torn.exit_code, 0) << torn.error;
  EXPECT_THAT(torn.error, HasSubstr("1 row cut short and left out"));
  const ProgramResult unknown = plot("altitude");
  EXPECT_EQ(unknown.exit_code, 2);
  ExpectOneLine(unknown.error, "metrics.csv has no column altitude");
}

TEST_F(PlotPipeline, WhatIsAskedWronglyIsRefusedInOneLine) {
  const auto expect = [&](const std::vector<std::string>& arguments, int code,
                          const std::string& part) {
    const ProgramResult result = CallSkein(arguments);
    EXPECT_EQ(result.exit_code, code) << part;
    ExpectOneLine(result.error, part);
  };
  const std::string out = scratch_ / "out.svg";
  expect({"plot", "flights", "--task", "heading", "-o", out}, 2, "who flies?");
  expect({"plot", "flights", "a.csv", "--agents", "zero", "-o", out}, 2, "not both");
  expect({"plot", "flights", scratch_ / "nowhere.csv", "-o", out}, 2, "nowhere.csv");
  expect({"plot", "flights", "a.csv", "--set", "env.hold_s=3", "-o", out}, 2,
         "--set is for --policy and --agents");
  expect({"plot", "tracks", "a.csv", "--task", "heading", "-o", out}, 2, "--task is for --policy");
  expect({"plot", "flights", "a.csv", "-o", "out.png"}, 2, "out.png: let the name end in");
  expect({"plot", "flights", "a.csv", "-o", scratch_ / "no/out.svg"}, 2, "cannot be written");
  expect({"plot", "space", "--agents", "zero", "--task", "heading", "--episodes", "0", "-o", out},
         2, "--episodes");
  expect({"plot", "curves", scratch_.path(), "-o", out}, 2, "not the directory of a run");
  expect({"plot", "space", "--agents", "zero", "--task", "heading", "--tolerance", "x", "-o", out},
         2, "COLUMN=NUMBER");
  for (const char* scale : {"0.5", "101", "nan"}) {
    expect({"plot", "space", "a.csv", "--vertical-scale", scale, "-o", out}, 2, "--vertical-scale");
  }
  for (const char* tolerance : {"yaw_deg=inf", "yaw_deg=nan", "yaw_deg=180.1", "altitude_ft=1e300",
                                "altitude_ft=0", "altitude_ft=-5"}) {
    expect({"plot", "flights", "--agents", "zero", "--task", "heading", "--episodes", "1",
            "--tolerance", tolerance, "-o", out},
           2, std::string("--tolerance ") + tolerance + ": give a number above 0, up to ");
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(PlotPipeline, ComparisonsGiveTheAutopilotsFigure) {
  const std::string run = scratch_ / "run", comparison = scratch_ / "comparison.json";
  ASSERT_EQ(CallSkein(TinyTraining(run)).exit_code, 0);
  const std::string out = scratch_ / "curves.svg";
  WriteFile(comparison,
            "{\"task\": \"heading\", \"agents\": [{\"name\": \"policy:x\", \"success_rate\": 1.0},"
            " {\"name\": \"autopilot\", \"success_rate\": 0.75}]}");
  const auto plot = [&] {
    return CallSkein({"plot", "curves", run, "--comparison", comparison, "-o", out});
  };
  EXPECT_EQ(plot().exit_code, 0);
  EXPECT_THAT(ReadFile(out), HasSubstr("aggressive autopilot: 75.0 %"));
  EXPECT_THAT(plot().error, Not(HasSubstr("conditions"))) << "a file that says none";
  const auto compare = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"compare",
                                          "--task",
                                          "heading",
                                          "--agents",
                                          "autopilot",
                                          "--config",
                                          run + "/config.toml",
                                          "--episodes",
                                          "2",
                                          "--no-html",
                                          "--json",
                                          comparison};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = CallSkein(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.error;
  };
  compare({});
  EXPECT_THAT(plot().error, Not(HasSubstr("conditions")));
  compare({"--condition", "windy=hard"});
  EXPECT_THAT(plot().error, HasSubstr("its autopilot was flown under other conditions than " + run +
                                      " (env.wind"));
  WriteFile(comparison, "[]");
  ExpectOneLine(plot().error, "not what skein compare --json writes");
}

/// cairo is the price of a PDF alone.
TEST(PlotLibraries, NothingIsLoadedBeforeItIsNeeded) {
  RunningProgram program({"plot", "--help"}, [] { setenv("LD_DEBUG", "files", 1); });
  const ProgramResult result = program.Wait();
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.error, HasSubstr("libfmt"));
  EXPECT_THAT(result.error, Not(HasSubstr("cairo")));
}

}  // namespace
}  // namespace skein
