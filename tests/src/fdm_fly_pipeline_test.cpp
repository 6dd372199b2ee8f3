// SPDX-License-Identifier: Apache-2.0
// `skein fdm fly`: sticks of a file in the float64 closed loop, and agents in the environments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "src/files/csv_columns.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kHeadingPolicy = SKEIN_SOURCE "/policies/heading.skein";
constexpr const char* kControlPolicy = SKEIN_SOURCE "/policies/control.skein";

using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class FdmFly : public ::testing::Test {
 protected:
  CsvColumns Flown(const Words& words) const {
    const std::string path = folder_ + "/flown.csv";
    const ProgramResult result = CallSkein(Words{"fdm", "fly"} + words + Words{"-o", path});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return ParseCsv(ReadFile(path));
  }

  ScratchDirectory scratch_;
  const std::string folder_ = scratch_.path();
};

TEST_F(FdmFly, HandsOffTheFlightGoesOnInAnyWind) {
  constexpr Tolerance kAltitude{1.5, "a centred stick asks for 1 g, the trim has 0.997: ft in 5 s"};
  constexpr Tolerance kLastDigit{1e-6, "the last of seven digits, relative"};
  const auto fly = [&](const std::string& wind) {
    const std::string path = folder_ + "/fly.csv";
    const ProgramResult result =
        CallSkein({"fdm", "fly", "--altitude-ft", "15000", "--speed-fps", "500", "--seconds", "5",
                   "--wind-fps", wind, "-o", path});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return ParseCsv(ReadFile(path));
  };
  const CsvColumns calm = fly("0,0,0"), windy = fly("-40,30,0");
  ASSERT_EQ(calm.rows(), 251u);
  EXPECT_NEAR(calm.Find("altitude_ft")->back(), 15000, kAltitude);
  for (const char* same : {"altitude_ft", "alpha_deg", "load_factor_g", "elevator_deg"}) {
    EXPECT_NEAR(windy.Find(same)->back() / calm.Find(same)->back(), 1, kLastDigit) << same;
  }
  EXPECT_NEAR(windy.Find("north_ft")->back(), calm.Find("north_ft")->back() - 5 * 40, kAltitude);
  EXPECT_NEAR(windy.Find("east_ft")->back(), calm.Find("east_ft")->back() + 5 * 30, kAltitude);
}

TEST_F(FdmFly, LeavingTheTablesOfTheModelIsSaid) {
  WriteFile(folder_ + "/dive.csv", "time_s,pitch\n0,-0.5\n");
  const auto said = [&](const Words& words) {
    return CallSkein(Words{"fdm", "fly", "-o", folder_ + "/fly.csv"} + words).output;
  };
  const std::string dive = said({"--altitude-ft", "3000", "--speed-fps", "500", "--commands",
                                 folder_ + "/dive.csv", "--seconds", "30"});
  EXPECT_THAT(dive, HasSubstr("s the altitude is outside the engine's tables (0 to 50000 ft)"));
  EXPECT_THAT(said({"--altitude-ft", "15000", "--speed-fps", "500"}),
              ::testing::Not(HasSubstr("outside")));
}

TEST_F(FdmFly, GustsHaveTheirDeviationAndSeed) {
  const auto fly = [&](const std::string& seed) {
    const std::string path = folder_ + "/gusts.csv";
    EXPECT_EQ(
        CallSkein({"fdm", "fly", "--altitude-ft", "15000", "--speed-fps", "500", "--seconds", "300",
                   "--step-s", "0.05", "--turbulence-fps", "5", "--seed", seed, "-o", path})
            .exit_code,
        0);
    return ParseCsv(ReadFile(path));
  };
  const CsvColumns first = fly("1"), again = fly("1"), other = fly("2");
  EXPECT_EQ(first.values.at(18), again.values.at(18));
  const std::vector<double>&gusts = *first.Find("wind_down_fps"),
        &others = *other.Find("wind_down_fps");
  EXPECT_NE(gusts, others);
  double square = 0;
  for (const double gust : gusts) square += gust * gust / static_cast<double>(gusts.size());
  // 300 s are some 40 independent gusts of 1750 ft at 500 ft/s.
  constexpr Tolerance kSamples{0.3, "of 5 ft/s, relative"};
  EXPECT_NEAR(std::sqrt(square), 5, kSamples * 5);
}

TEST_F(FdmFly, GustsMayBeAsStrongAsTheStandardHasThemThere) {
  const auto deviation = [&](const std::string& altitude) {
    const std::string path = folder_ + "/gusts.csv";
    const ProgramResult result = CallSkein(
        {"fdm", "fly", "--altitude-ft", altitude, "--speed-fps", "700", "--seconds", "100",
         "--step-s", "0.05", "--turbulence-fps", "7.3", "--turbulence-by-altitude", "-o", path});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    const CsvColumns table = ParseCsv(ReadFile(path));
    double square = 0;
    for (const double gust : *table.Find("wind_down_fps")) square += gust * gust;
    return std::sqrt(square / static_cast<double>(table.rows()));
  };
  // MIL-F-8785C, figure 7: 7.3 ft/s at 20,000 ft, 5.0 at 35,000 ft; the same random numbers.
  constexpr Tolerance kPath{0.1, "gusts of the same draws, met along another path, relative"};
  EXPECT_NEAR(deviation("35000") / deviation("20000"), 5.0 / 7.3, kPath);
}

TEST_F(FdmFly, RotationalGustsTurnTheAircraftInTheSameLinearOnes) {
  const Words words = {"--altitude-ft", "15000", "--speed-fps",      "500", "--seconds", "10",
                       "--seed",        "5",     "--turbulence-fps", "7"};
  const CsvColumns linear = Flown(words), turning = Flown(words + Words{"--rotational-gusts"});
  EXPECT_EQ(linear.Find("wind_down_fps")->front(), turning.Find("wind_down_fps")->front());
  EXPECT_EQ(linear.Find("p_deg_s")->front(), turning.Find("p_deg_s")->front());
  const std::vector<double>&before = *linear.Find("p_deg_s"), &after = *turning.Find("p_deg_s");
  double square = 0;
  for (std::size_t row = 0; row < before.size(); ++row) {
    square += std::pow(after[row] - before[row], 2) / static_cast<double>(before.size());
  }
  // The air rolls by 3 deg/s; the aircraft's damping and the flight control leave a part of it.
  EXPECT_GT(std::sqrt(square), 0.1);
  EXPECT_LT(std::sqrt(square), 3);
}

TEST_F(FdmFly, SticksOfAFileAreFlown) {
  const std::string sticks = folder_ + "/sticks.csv", path = folder_ + "/fly.csv";
  WriteFile(sticks, "time_s,roll\n0,0\n1,0.2\n2,0");
  const std::vector<std::string> words = {
      "fdm",       "fly", "--altitude-ft", "15000", "--speed-fps", "500",
      "--seconds", "3",   "--commands",    sticks,  "-o",          path};
  ASSERT_EQ(CallSkein(words).exit_code, 0);
  const CsvColumns flown = ParseCsv(ReadFile(path));
  const std::vector<double>& stick = *flown.Find("action_roll");
  EXPECT_EQ(stick[50], 0) << "in the step that ends at 1 s";
  EXPECT_EQ(stick[51], 0.2);
  EXPECT_EQ(stick[101], 0);
  EXPECT_GT(flown.Find("p_deg_s")->at(100), 30);
  EXPECT_GT(flown.Find("roll_deg")->at(100), 20);
  const std::string as_flown = ReadFile(path);
  WriteFile(sticks, "time_s,roll\r\n0,0\r\n1,0.2\r\n2,0\r\n");
  ASSERT_EQ(CallSkein(words).exit_code, 0);
  EXPECT_EQ(ReadFile(path), as_flown) << "as Windows ends lines";
  WriteFile(sticks, "\xEF\xBB\xBFtime_s,roll\n0,0\n1,0.2\n2,0\n");
  ASSERT_EQ(CallSkein(words).exit_code, 0);
  EXPECT_EQ(ReadFile(path), as_flown) << "as spreadsheets begin a file";
  const ProgramResult drawn =
      CallSkein({"plot", "flights", path, "--columns", "p_deg_s", "-o", folder_ + "/fly.svg"});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.error;
  const ProgramResult lost = CallSkein({"fdm", "fly", "--altitude-ft", "15000", "--speed-fps",
                                        "500", "--seconds", "30", "--step-s", "0.5", "-o", path});
  EXPECT_EQ(lost.exit_code, 1);
  EXPECT_THAT(lost.error, HasSubstr("is a step of 0.5 s short enough?"));
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"", "expected a header"},
      {"time_s,roll\n", "expected a header"},
      {"time_s,roll\n0,0,0\n", "expected a header"},
      {"time_s;roll\n0;0,5\n", "rows of as many numbers, with commas between them"},
      {"roll\n0\n", "no column time_s"},
      {"time_s,stick\n0,0\n", "column stick"},
      {"time_s,ro\rll\n0,0\n", "column ro ll"},
      {"time_s,roll,roll\n0,0,0.2\n", "column roll is there twice"},
      {"time_s,roll\n1,0\n1,0\n", "row 2: times are from 0 on and increase"},
      {"time_s,roll\nx,0\n", "row 1: times"},
      {"time_s,roll\n0,2\n", "row 1: roll is not a number from -1 to 1"},
      {"time_s,throttle\n0,-1\n", "throttle is not a number from 0 to 1"}};
  for (const auto& [text, expected] : wrong) {
    WriteFile(sticks, text);
    const ProgramResult result = CallSkein(words);
    EXPECT_EQ(result.exit_code, 1) << text;
    EXPECT_THAT(result.error, HasSubstr(expected));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
}

Words StartOf(const std::string& altitude, const std::string& speed) {
  Words words;
  for (const char* end : {"min", "max"}) {
    words =
        words + Words{"--set", "env.initial.altitude_" + std::string(end) + "_ft=" + altitude,
                      "--set", "env.initial.true_airspeed_" + std::string(end) + "_fps=" + speed};
  }
  return words;
}

// The environments fly for it: not one bit of the file is another.
TEST_F(FdmFly, APolicyFliesAsInAReplayFromTheSameStart) {
  const std::string replayed = folder_ + "/replayed.csv", flown = folder_ + "/flown.csv";
  Words words = {"replay", "--policy", kHeadingPolicy, "--episodes", "1",     "--seed",
                 "3",      "--hold",   "50",           "-o",         replayed};
  for (const char* key :
       {"heading.altitude_change_ft=0", "heading.yaw_change_rad=0", "heading.speed_change_fps=0",
        "wind.speed_min_fps=50", "wind.speed_max_fps=50", "wind.from_min_deg=-90",
        "wind.from_max_deg=-90", "wind.step_at_reset=false", "wind.turbulence_min_fps=3.7",
        "wind.turbulence_max_fps=3.7", "wind.turbulence_by_altitude=true",
        "wind.rotational_gusts=true", "drag_rise=true", "gravity_falls_with_altitude=true",
        "atmosphere=standard_1976", "substeps=2", "time_limit_steps=2500"}) {
    words = words + Words{"--set", std::string("env.") + key};
  }
  words = words + StartOf("21000", "900");
  const ProgramResult replay = CallSkein(words);
  ASSERT_EQ(replay.exit_code, 0) << replay.error;
  const ProgramResult fly = CallSkein({"fdm",
                                       "fly",
                                       "--policy",
                                       kHeadingPolicy,
                                       "--altitude-ft",
                                       "21000",
                                       "--speed-fps",
                                       "900",
                                       "--seed",
                                       "3",
                                       "--wind-fps",
                                       "0,50,0",
                                       "--turbulence-fps",
                                       "3.7",
                                       "--turbulence-by-altitude",
                                       "--rotational-gusts",
                                       "--drag-rise",
                                       "--gravity-falls-with-altitude",
                                       "--atmosphere",
                                       "standard_1976",
                                       "--substeps",
                                       "2",
                                       "--seconds",
                                       "50",
                                       "-o",
                                       flown});
  ASSERT_EQ(fly.exit_code, 0) << fly.error;
  // The replay goes on: it holds what it has reached.
  const std::string text = ReadFile(flown);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2502);
  EXPECT_EQ(text, ReadFile(replayed).substr(0, text.size()));
}

TEST_F(FdmFly, AgentsFlyToTheTargetsThatAreGiven) {
  constexpr Tolerance kFloat32{1e-4, "float32 of the 7.85 rad of 450 degrees, and seven digits"};
  constexpr Tolerance kAngle{5, "degrees from yaw or pitch at which a target counts as reached"};
  constexpr Tolerance kAltitude{100, "ft from an altitude at which a target counts as reached"};
  const Words start = {"--altitude-ft", "20000", "--speed-fps", "1000", "--seconds", "60"};
  for (const Words& agent :
       {Words{"--policy", kHeadingPolicy}, Words{"--agents", "autopilot", "--task", "heading"}}) {
    const CsvColumns flown =
        Flown(start + agent + Words{"--target", "yaw_deg=450", "--target", "altitude_ft=21000"});
    ASSERT_EQ(flown.rows(), 3001u);
    EXPECT_NEAR(flown.Find("target_yaw_deg")->front(), 90, kFloat32) << "a whole turn less";
    EXPECT_EQ(flown.Find("target_altitude_ft")->back(), 21000);
    EXPECT_EQ(flown.Find("target_true_airspeed_fps")->back(), 1000) << "as at the start";
    EXPECT_EQ(flown.Find("altitude_ft")->front(), 20000);
    EXPECT_NEAR(flown.Find("yaw_deg")->back(), 90, kAngle);
    EXPECT_NEAR(flown.Find("altitude_ft")->back(), 21000, kAltitude);
  }
  const CsvColumns control = Flown({"--altitude-ft", "20000", "--speed-fps", "1000", "--policy",
                                    kControlPolicy, "--target", "pitch_deg=10", "--seconds", "15"});
  EXPECT_NEAR(control.Find("pitch_deg")->back(), 10, kAngle);
}

TEST_F(FdmFly, StartsAndTargetsAboveTheEnginesTablesAreSaid) {
  const std::string above =
      " ft: the engine's tables end at 50000 ft, and thrust above is held as "
      "there\n";
  const auto said = [&](const std::string& altitude, const Words& words) {
    const ProgramResult result =
        CallSkein(Words{"fdm", "fly", "--altitude-ft", altitude, "--speed-fps", "1000", "--seconds",
                        "0.1", "-o", folder_ + "/high.csv", "--agents", "autopilot"} +
                  words);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return result.error;
  };
  const Words heading = {"--task", "heading"};
  EXPECT_EQ(said("45000", heading + Words{"--target", "altitude_ft=50000"}), "");
  EXPECT_EQ(said("45000", heading + Words{"--target", "altitude_ft=55000"}),
            "warning: the target altitude is at up to 55000" + above);
  EXPECT_EQ(said("51000", heading + Words{"--target", "altitude_ft=49000"}),
            "warning: flights begin at up to 51000" + above);
  EXPECT_EQ(said("51000", {"--task", "control", "--target", "pitch_deg=0"}),
            "warning: flights begin at up to 51000" + above);
  EXPECT_EQ(said("49000", {"--task", "tracking", "--target", "altitude_ft=49000"}), "")
      << "points as they are drawn may lie higher";
}

TEST_F(FdmFly, AMissionIsFlownToItsEnd) {
  for (const char* task : {"heading", "tracking"}) {
    const ProgramResult result =
        CallSkein({"fdm", "fly", "--altitude-ft", "20000", "--speed-fps", "1000", "--agents",
                   "autopilot", "--task", task, "--set", "env.mission.length_s=2", "--set",
                   "env.hold_s=0", "--seconds", "3", "-o", folder_ + "/mission.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    EXPECT_THAT(result.output, HasSubstr("autopilot: 2 s of 3, flown to the end\n"));
  }
}

TEST_F(FdmFly, AFlightHasAtLeastOneStep) {
  const Words start = {"--altitude-ft", "20000", "--speed-fps", "1000"};
  for (const Words& pilot : {Words{}, Words{"--agents", "autopilot", "--task", "heading"}}) {
    EXPECT_EQ(Flown(start + pilot + Words{"--seconds", "0.02"}).rows(), 2u);
    const ProgramResult result = CallSkein(
        Words{"fdm", "fly", "-o", folder_ + "/none.csv", "--seconds", "0.001"} + start + pilot);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.error,
              "skein: error: 0.001 s are less than a step of 0.02 s: raise --seconds\n");
    EXPECT_FALSE(fs::exists(folder_ + "/none.csv"));
  }
}

TEST_F(FdmFly, SaysHowLongItFlew) {
  for (const auto& [asked, flown] :
       {std::pair("0.02", "0.02"), std::pair("0.03", "0.04"), std::pair("0.3", "0.3")}) {
    const std::string path = folder_ + "/short.csv";
    const ProgramResult result = CallSkein({"fdm", "fly", "--altitude-ft", "20000", "--speed-fps",
                                            "1000", "--seconds", asked, "-o", path});
    EXPECT_THAT(result.output, HasSubstr(std::string(" for ") + flown + " s: "));
    EXPECT_EQ(ParseCsv(ReadFile(path)).Find("time_s")->back(), std::stod(flown));
  }
}

TEST_F(FdmFly, AFileOfAnotherFormatIsRefused) {
  const Words start = {"fdm", "fly", "--altitude-ft", "20000", "--speed-fps", "1000"};
  for (const Words& pilot : {Words{}, Words{"--agents", "autopilot", "--task", "heading"}}) {
    for (const std::string ending : {".svg", ".acmi", ".json", ".SVG"}) {
      const std::string path = folder_ + "/flight" + ending;
      const ProgramResult result = CallSkein(start + pilot + Words{"-o", path});
      EXPECT_EQ(result.exit_code, 2) << ending;
      EXPECT_EQ(result.error, "skein: error: " + path +
                                  ": flights are written as CSV: let the name end in .csv\n");
      EXPECT_FALSE(fs::exists(path));
    }
    for (const std::string name : {"/flight", "/a.flight.csv", "/flight.CSV"}) {
      const Words out = {"--seconds", "0.1", "-o", folder_ + name};
      EXPECT_EQ(CallSkein(start + pilot + out).exit_code, 0) << name;
      EXPECT_TRUE(fs::exists(folder_ + name));
    }
  }
}

TEST_F(FdmFly, SaysThatItReplacesAFileThatNobodyNamed) {
  const auto fly = [&](const Words& more) {
    const Words start = {"fdm",         "fly",  "--altitude-ft", "20000",
                         "--speed-fps", "1000", "--seconds",     "0.1"};
    const ProgramResult result = RunSkein(start + more, [&] {
      if (chdir(folder_.c_str()) != 0) _exit(1);
    });
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return result.output;
  };
  const Words autopilot = {"--agents", "autopilot", "--task", "heading"};
  EXPECT_THAT(fly({}), HasSubstr("0.1 s: flight.csv\n"));
  const std::string sticks = ReadFile(folder_ + "/flight.csv");
  EXPECT_THAT(fly({}), HasSubstr("0.1 s: flight.csv (replaced)\n"));
  EXPECT_THAT(fly({"-o", "flight.csv"}), HasSubstr("0.1 s: flight.csv\n"));
  EXPECT_THAT(fly(autopilot), HasSubstr("flight.csv (replaced): 1 flight by autopilot\n"));
  EXPECT_NE(ReadFile(folder_ + "/flight.csv"), sticks);
  EXPECT_THAT(fly(autopilot + Words{"-o", "flight.csv"}), HasSubstr("flight.csv: 1 flight by"));
}

TEST_F(FdmFly, HowGustsAreNeedsGusts) {
  for (const std::string flag : {"--rotational-gusts", "--turbulence-by-altitude"}) {
    const ProgramResult result = CallSkein({"fdm", "fly", "--altitude-ft", "20000", "--speed-fps",
                                            "1000", flag, "-o", folder_ + "/x.csv"});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.error, HasSubstr(flag + " needs --turbulence-fps"));
  }
}

TEST_F(FdmFly, WhatAgentsCannotFlySaysSo) {
  const Words start = {"fdm",  "fly", "--altitude-ft",   "20000", "--speed-fps",
                       "1000", "-o",  folder_ + "/x.csv"};
  const Words autopilot = {"--agents", "autopilot", "--task", "heading"};
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"--agents", "autopilot"}, "--task is needed"},
      {{"--target", "yaw_deg=3"}, "--target is for --policy and --agents"},
      {{"--agents", "autopilot", "--commands", "x.csv"}, "exclude each other"},
      {autopilot + Words{"--target", "pitch_deg=3"},
       "targets of heading are altitude_ft, yaw_deg, true_airspeed_fps"},
      {autopilot + Words{"--target", "yaw_deg"}, "give yaw_deg=NUMBER"},
      {autopilot + Words{"--target", "yaw_deg=nan"}, "give yaw_deg=NUMBER"},
      {{"--agents", "autopilot", "--task", "control", "--target", "pitch_deg=91"}, "-90 to 90"},
      {autopilot + Words{"--target", "true_airspeed_fps=-5"}, "from 10 to 3000"},
      {autopilot + Words{"--target", "altitude_ft=1e6"}, "from 0 to 60000"},
      {autopilot + Words{"--target", "yaw_deg=3", "--target", "yaw_deg=4"},
       "--target yaw_deg: it is there twice"},
      {autopilot + Words{"--xcg", "5"}, "--xcg: '5' is not a number above 0, at most 1"},
      {autopilot + Words{"--heng", "-1"}, "--heng: env.engine_angular_momentum"},
      {autopilot + Words{"--step-s", "5"}, "--step-s: env.control_interval_s = 5 is out of range"},
      {autopilot + Words{"--seconds", "1.5e5"}, "5000000 are the most: lower --seconds"},
      {autopilot + Words{"--pull-up-g", "3"}, "begins in level flight"},
      {autopilot + Words{"--condition", "high_altitude=40kft"},
       "--altitude-ft and --speed-fps say where the flight begins"},
      {autopilot + Words{"--wind-fps", "0,0,3"}, "down must be 0"},
      {{"--agents", "pilot", "--task", "heading"}, "pilot"},
      {autopilot + Words{"--set", "ppo.epochs=3"}, "is for trainings"}};
  for (const auto& [words, expected] : cases) {
    const ProgramResult result = CallSkein(start + words);
    EXPECT_EQ(result.exit_code, 2) << expected << result.error;
    EXPECT_THAT(result.error, HasSubstr(expected));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
  const ProgramResult stalled =
      CallSkein({"fdm", "fly", "--altitude-ft", "20000", "--speed-fps", "60", "--agents",
                 "autopilot", "--task", "heading", "-o", folder_ + "/x.csv"});
  EXPECT_EQ(stalled.exit_code, 2);
  EXPECT_THAT(stalled.error, HasSubstr("this flight is below stall speed"));
  EXPECT_EQ(std::count(stalled.error.begin(), stalled.error.end(), '\n'), 1) << stalled.error;
}

}  // namespace
}  // namespace skein
