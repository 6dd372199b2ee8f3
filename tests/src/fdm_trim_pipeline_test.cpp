// SPDX-License-Identifier: Apache-2.0
// `skein fdm trim` and the grids of its relatives.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/bench/machine.h"
#include "src/files/csv_columns.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/trimmed_flight.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class FdmTrimPipeline : public ::testing::Test {
 protected:
  const ScratchDirectory scratch_;
  std::string folder_ = scratch_.path();
};

TEST_F(FdmTrimPipeline, ATrimBeyondTheEngineSaysSo) {
  const std::string path = folder_ + "/trim.json";
  const auto trim = [&path](const char* speed) {
    const ProgramResult result =
        CallSkein({"fdm", "trim", "--altitude-ft", "15000", "--speed-fps", speed, "--json", path});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return std::pair(result.output, json::parse(ReadFile(path)));
  };
  const auto [easy_text, easy] = trim("500");
  EXPECT_TRUE(easy["within_model"]);
  EXPECT_THAT(easy_text, HasSubstr("engine power"));
  EXPECT_EQ(easy_text.find("steady flight of f16"), 0u) << easy_text;
  EXPECT_EQ(easy_text.find("this flight"), std::string::npos);
  const auto [fast_text, fast] = trim("2600");
  EXPECT_FALSE(fast["within_model"]);
  constexpr const char* kUnsustained =
      "this flight cannot be sustained: it needs more thrust than the engine has (";
  EXPECT_EQ(fast_text.find(kUnsustained), 0u) << "the reason comes first: " << fast_text;
  EXPECT_THAT(fast_text,
              HasSubstr("this flight is faster than the engine's tables, which end at Mach 1"));
  EXPECT_EQ(fast["exceeded_limits"].size(), 2u);
}

TEST_F(FdmTrimPipeline, ATurnThatIsNotSustainedSaysByHowMuchThrust) {
  constexpr Tolerance kSixDigits{1e-5, "of the text, relative"};
  const std::string path = folder_ + "/turn.json";
  const ProgramResult result = CallSkein({"fdm", "trim", "--altitude-ft", "15000", "--speed-fps",
                                          "600", "--turn-rate-deg-s", "30", "--json", path});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  const std::string first = result.output.substr(0, result.output.find('\n'));
  EXPECT_THAT(first, HasSubstr("cannot be sustained"));
  const std::string before = "short by ";
  const std::size_t figure = first.find(before);
  ASSERT_NE(figure, std::string::npos) << first;
  const json trim = json::parse(ReadFile(path));
  const double missing =
      trim["controls"][0].get<double>() - trim["available_thrust_lbf"].get<double>();
  EXPECT_NEAR(std::stod(first.substr(figure + before.size())), missing, kSixDigits * missing);
}

TEST_F(FdmTrimPipeline, ATrimIsPrintedInSixDigits) {
  const std::string path = folder_ + "/trim.json";
  const ProgramResult result =
      CallSkein({"fdm", "trim", "--altitude-ft", "15000", "--speed-fps", "500", "--json", path});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  const double alpha = json::parse(ReadFile(path))["alpha_deg"];
  EXPECT_THAT(result.output, HasSubstr(fmt::format(" {:.6g} deg\n", alpha)));
}

// The speed of sound at sea level is that of the U.S. Standard Atmosphere 1976, table I.
TEST_F(FdmTrimPipeline, AMachNumberIsASpeedInTheAtmosphereChosen) {
  constexpr Tolerance kRounding{1e-12, "rounding, relative"};
  const std::string path = folder_ + "/mach.json";
  constexpr double kSoundSpeedFtS = 1116.45;
  constexpr Tolerance kDigits{1e-5, "of the tabulated speed of sound, relative"};
  const ProgramResult result = CallSkein({"fdm", "trim", "--altitude-ft", "0", "--mach", "0.6",
                                          "--atmosphere", "standard_1976", "--json", path});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  const json by_mach = json::parse(ReadFile(path));
  const double speed = by_mach["speed_fps"];
  EXPECT_NEAR(speed, 0.6 * kSoundSpeedFtS, kDigits * speed);
  EXPECT_NEAR(by_mach["mach"].get<double>(), 0.6, kRounding);
  EXPECT_THAT(result.output, HasSubstr(fmt::format("Mach 0.6 ({:.6g} ft/s)", speed)));
  EXPECT_EQ(TrimmedIn(folder_, "0", fmt::format("{}", speed), {"--atmosphere", "standard_1976"}),
            by_mach);
}

TEST_F(FdmTrimPipeline, AGridOfMachNumbersHasThemAtEveryAltitude) {
  constexpr Tolerance kRounding{1e-12, "rounding, relative"};
  const std::string path = folder_ + "/grid.json";
  const ProgramResult result = CallSkein(
      {"fdm", "trim", "--altitude-ft", "0,30000", "--mach", "0.5..0.9:0.1", "--json", path});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("at 0 to 30000 ft and Mach 0.5 to 0.9"));
  const json points = json::parse(ReadFile(path))["points"];
  ASSERT_EQ(points.size(), 10u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double mach = 0.5 + 0.1 * static_cast<double>(i % 5);
    EXPECT_NEAR(points[i]["mach"].get<double>(), mach, kRounding);
  }
  EXPECT_LT(points[5]["speed_fps"], points[0]["speed_fps"]) << "the air is colder";
}

TEST_F(FdmTrimPipeline, LinearModelsAndFlyingQualitiesAreThoseOfTheMachNumber) {
  const std::string path = folder_ + "/points.json";
  for (const char* command : {"linearise", "sweep"}) {
    const auto points_of = [&](const std::string& option, const std::string& value) {
      const ProgramResult result =
          CallSkein({"fdm", command, "--altitude-ft", "15000", option, value, "--json", path});
      EXPECT_EQ(result.exit_code, 0) << result.error;
      return json::parse(ReadFile(path))["points"];
    };
    const json by_mach = points_of("--mach", "0.5");
    const std::string speed = fmt::format("{}", by_mach[0]["speed_fps"].get<double>());
    EXPECT_EQ(points_of("--speed-fps", speed), by_mach) << command;
  }
}

TEST_F(FdmTrimPipeline, EveryDocumentSaysWhichProgramMadeIt) {
  const std::string path = folder_ + "/figures.json";
  for (const char* command : {"trim", "linearise", "sweep"}) {
    for (const char* speeds : {"500", "500,600"}) {
      const ProgramResult result = CallSkein(
          {"fdm", command, "--altitude-ft", "15000", "--speed-fps", speeds, "--json", path});
      ASSERT_EQ(result.exit_code, 0) << result.error;
      EXPECT_EQ(json::parse(ReadFile(path))["program"], json(ProgramJson()))
          << command << ' ' << speeds;
    }
  }
}

TEST_F(FdmTrimPipeline, AnImpossibleTrimIsOneLine) {
  const ProgramResult result =
      CallSkein({"fdm", "trim", "--altitude-ft", "15000", "--speed-fps", "30"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  EXPECT_EQ(result.error.find("skein: error: this flight is below stall speed: at 15000 ft"), 0u)
      << result.error;
}

TEST_F(FdmTrimPipeline, ATrimOfWhatIsNoNumberIsWrongUsage) {
  for (const char* altitude : {"nan", "inf", "high"}) {
    const ProgramResult result =
        CallSkein({"fdm", "trim", "--altitude-ft", altitude, "--speed-fps", "500"});
    EXPECT_EQ(result.exit_code, 2) << altitude;
    EXPECT_THAT(result.error,
                HasSubstr("--altitude-ft: '" + std::string(altitude) + "' is not a finite number"));
  }
}

TEST_F(FdmTrimPipeline, ASteadyWindCarriesTheFlightAndNoMore) {
  constexpr Tolerance kRounding{1e-9, "rounding"};
  const json calm = TrimmedIn(folder_, "5000", "500", {});
  const json windy = TrimmedIn(folder_, "5000", "500", {"--wind-fps", "-30,20,5"});
  EXPECT_EQ(calm["controls"], windy["controls"]);
  EXPECT_NEAR(calm["mach"].get<double>(), windy["mach"].get<double>(), kRounding);
  const double wind[] = {-30, 20, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(windy["ground_velocity_fps"][i].get<double>(),
                calm["ground_velocity_fps"][i].get<double>() + wind[i], kRounding * 500);
  }
}

TEST_F(FdmTrimPipeline, AGridInAWindShowsTheSpeedOverGround) {
  constexpr Tolerance kRounding{1e-9, "rounding, relative"};
  const std::string csv = folder_ + "/grid.csv", path = folder_ + "/grid.json";
  std::vector<std::string> words = {"fdm",         "trim",    "--altitude-ft", "5000",
                                    "--speed-fps", "500,700", "--csv",         csv,
                                    "--json",      path};
  const ProgramResult calm = CallSkein(words);
  ASSERT_EQ(calm.exit_code, 0) << calm.error;
  const json in_still_air = json::parse(ReadFile(path));
  words.insert(words.end(), {"--wind-fps", "-30,20,5"});
  const ProgramResult windy = CallSkein(words);
  ASSERT_EQ(windy.exit_code, 0) << windy.error;
  const CsvColumns table = ParseCsv(ReadFile(csv));
  const std::vector<double>* const shown = table.Find("ground_speed_fps");
  ASSERT_NE(shown, nullptr);
  for (std::size_t i = 0; i < 2; ++i) {
    const json& velocity = in_still_air["points"][i]["ground_velocity_fps"];
    const double carried =
        std::hypot(velocity[0].get<double>() - 30, velocity[1].get<double>() + 20);
    EXPECT_NEAR(shown->at(i), carried, kRounding * carried);
  }
  EXPECT_THAT(windy.output, HasSubstr("over ground"));
  EXPECT_THAT(windy.output, HasSubstr(fmt::format("{:.0f} to {:.0f}", shown->at(0), shown->at(1))));
  EXPECT_THAT(windy.output, HasSubstr("wind -30 ft/s north, 20 east, 5 down"));
  EXPECT_THAT(calm.output, ::testing::Not(HasSubstr("over ground")));
  EXPECT_EQ(json::parse(ReadFile(path))["wind_fps"], json({-30, 20, 5}));
  EXPECT_EQ(in_still_air["wind_fps"], json({0, 0, 0}));
}

// Half the weight needs half the lift: the aircraft flies as one of half the mass, but for
// inertia.
TEST_F(FdmTrimPipeline, GravityIsAskedFor) {
  const auto alpha = [&](const std::vector<std::string>& gravity) {
    return TrimmedIn(folder_, "40000", "700", gravity)["alpha_deg"].get<double>();
  };
  EXPECT_LT(alpha({"--gravity-ft-s2", "16.085"}), 0.6 * alpha({}));
  EXPECT_LT(alpha({"--gravity-falls-with-altitude"}), alpha({}));
  EXPECT_EQ(alpha({"--gravity-ft-s2", "32.17"}), alpha({}));
}

TEST_F(FdmTrimPipeline, AGridSaysOfEveryPointWhyItIsNotFlown) {
  const std::string csv = folder_ + "/grid.csv", path = folder_ + "/grid.json";
  const ProgramResult result =
      CallSkein({"fdm", "trim", "--altitude-ft", "0..40000:20000", "--speed-fps", "100..1100:500",
                 "--csv", csv, "--json", path, "--picture", folder_ + "/grid.svg"});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("s below stall speed"));
  const json grid = json::parse(ReadFile(path));
  ASSERT_EQ(grid["points"].size(), 9u);
  EXPECT_THAT(ReadFile(folder_ + "/grid.svg"), HasSubstr("below stall speed"));
  const std::string table = ReadFile(csv);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 10);
  // In quotes where there is a comma.
  EXPECT_THAT(table, HasSubstr(",below stall speed,is below stall speed: at 0 ft the wing"));
  EXPECT_THAT(table, HasSubstr(",\"is faster than the engine's tables, which end at Mach 1\","));
  for (const json& point : grid["points"]) {
    const std::vector<std::string> one = {"fdm",           "trim",
                                          "--altitude-ft", point["altitude_ft"].dump(),
                                          "--speed-fps",   point["speed_fps"].dump(),
                                          "--json",        folder_ + "/one.json"};
    // The point alone says the same.
    const ProgramResult alone = CallSkein(one);
    const bool is_flown =
        alone.exit_code == 0 && json::parse(ReadFile(folder_ + "/one.json"))["within_model"];
    EXPECT_EQ(point["flown"].get<bool>(), is_flown) << point;
    EXPECT_EQ(point.contains("reason"), !is_flown) << point;
  }
  EXPECT_EQ(grid["points"][0]["limit"], "below stall speed");
}

TEST_F(FdmTrimPipeline, AStalledWingThatCarriesTheWeightIsBelowStallSpeed) {
  // An elevator that holds any alpha: there are trims at which the wing is a plate.
  json aircraft = json::parse(ReadFile(SKEIN_SOURCE "/data/cessna172/aircraft.json"));
  aircraft["longitudinal"]["Cm_elevator"] =
      4 * aircraft["longitudinal"]["Cm_elevator"].get<double>();
  aircraft["longitudinal"]["CL_elevator"] = 0;
  const std::string file = folder_ + "/strong.json", path = folder_ + "/grid.json";
  WriteFile(file, aircraft.dump());
  const std::vector<std::string> trim = {"fdm", "trim",          "--aircraft",
                                         file,  "--altitude-ft", "1000"};
  std::vector<std::string> of_one = trim, of_grid = trim;
  of_one.insert(of_one.end(), {"--speed-fps", "40"});
  of_grid.insert(of_grid.end(), {"--speed-fps", "30..90:10", "--json", path});
  EXPECT_THAT(CallSkein(of_one).output, HasSubstr("this flight is beyond the stall (alpha 78.2"));
  ASSERT_EQ(CallSkein(of_grid).exit_code, 0);
  const json points = json::parse(ReadFile(path))["points"];
  ASSERT_EQ(points.size(), 7u);
  for (const json& point : points) {
    if (point["flown"].get<bool>()) continue;
    EXPECT_EQ(point["limit"], "below stall speed") << point;
  }
}

TEST_F(FdmTrimPipeline, AGridIsTheSameInWhateverOrderItsAxesAreGiven) {
  const auto flown = [&](const std::string& altitudes_ft, const std::string& speeds_fps) {
    const std::string numbers = folder_ + "/grid.json", picture = folder_ + "/grid.svg";
    const ProgramResult result =
        CallSkein({"fdm", "trim", "--altitude-ft", altitudes_ft, "--speed-fps", speeds_fps,
                   "--json", numbers, "--picture", picture});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return std::vector<std::string>{result.output, ReadFile(numbers), ReadFile(picture)};
  };
  const std::vector<std::string> ascending = flown("0,20000", "500,700,900");
  EXPECT_THAT(ascending[0], HasSubstr("500 to 900"));
  EXPECT_EQ(flown("20000,0", "900,700,500"), ascending);
  EXPECT_EQ(flown("20000,0,20000", "700,900,500,700"), ascending) << "each once";
}

TEST_F(FdmTrimPipeline, WrongGridsAreWrongUsage) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--altitude-ft", "0..10:0", "--speed-fps", "500"}, "STEP must be above 0"},
      {{"--altitude-ft", "10..0:5", "--speed-fps", "500"}, "TO must not be below FROM"},
      {{"--altitude-ft", "0..1e9:1", "--speed-fps", "500"}, "more than 10000 numbers"},
      {{"--altitude-ft", "0", "--speed-fps", "0,500"}, "is not a number above 0"},
      {{"--altitude-ft", "0", "--speed-fps", "500", "--flight-path-deg", "120"}, "90"},
      {{"--altitude-ft", "0", "--speed-fps", "500", "--csv", folder_ + "/x.csv"}, "--csv"},
      {{"--altitude-ft", "0", "--speed-fps", "500", "--xcg", "50"}, "above 0, at most 1"},
      {{"--altitude-ft", "0", "--speed-fps", "500", "--wind-fps", "1,2"}, "NORTH,EAST,DOWN"},
      {{"--altitude-ft", "0", "--speed-fps", "500", "--pull-up-g", "2", "--turn-rate-deg-s", "3"},
       "--turn-rate-deg-s and --pull-up-g exclude each other"},
      {{"--altitude-ft", "0"}, "--speed-fps or --mach is required"},
      {{"--altitude-ft", "0", "--mach", "0"}, "is not a number above 0"},
      {{"--altitude-ft", "0", "--mach", "0.5", "--speed-fps", "500"}, "exclude each other"},
      {{"--altitude-ft", "0,9", "--mach", "0.5,0.6", "--picture", folder_ + "/x.svg"},
       "drawn over --speed-fps"},
      {{"--altitude-ft", "0", "--speed-fps", "80", "--aircraft", "aerosonde", "--drag-rise"},
       "no data of drag rise"}};
  for (const auto& [words, expected] : cases) {
    std::vector<std::string> command = {"fdm", "trim"};
    command.insert(command.end(), words.begin(), words.end());
    const ProgramResult result = CallSkein(command);
    EXPECT_EQ(result.exit_code, 2) << expected;
    EXPECT_THAT(result.error, HasSubstr(expected));
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  }
}

TEST_F(FdmTrimPipeline, AGridOfTooManyPointsIsWrongUsageInEveryCommand) {
  for (const char* command : {"trim", "linearise", "sweep"}) {
    const ProgramResult result =
        CallSkein({"fdm", command, "--altitude-ft", "0..9999:1", "--speed-fps", "1..11:1"});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_EQ(result.error, "skein: error: 110000 points are more than 100000\n") << command;
  }
}

TEST_F(FdmTrimPipeline, ATrimAboveTheTablesSaysSo) {
  const ProgramResult result =
      CallSkein({"fdm", "trim", "--altitude-ft", "60000", "--speed-fps", "900"});
  EXPECT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output,
              HasSubstr("this flight is above the engine's tables, which end at 50000 ft"));
  // 4500 m, which no number of feet is exactly.
  EXPECT_THAT(CallSkein({"fdm", "trim", "--altitude-ft", "15000", "--speed-fps", "200",
                         "--aircraft", "cessna172"})
                  .output,
              HasSubstr("is above the engine's tables, which end at 14764 ft\n"));
}

}  // namespace
}  // namespace skein
