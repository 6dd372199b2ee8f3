// SPDX-License-Identifier: Apache-2.0
// `skein fdm` on the golden points and trajectories of the double-precision reference.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "src/bench/machine.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/run_program.h"
#include "tests/src/trimmed_flight.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* kGolden = SKEIN_TEST_DATA "/golden.json";

constexpr Tolerance kSumOrder{1e-9, "the same equations in another language and order"};
constexpr Tolerance kFloat32{2e-4, "float32 blends of tables and sums of moments, relative"};
// Of a quantity's largest: values below it are measured against it.
constexpr double kFloat32Floor = 1e-2;
constexpr Tolerance kTrajectory{1e-6, "500 steps of accumulated rounding"};

json WithoutResults(json file) {
  for (const char* list : {"points", "edge_points"}) {
    for (json& point : file[list]) {
      for (const char* key : {"coeffs", "xdot", "alpha_deg", "beta_deg", "mach", "qbar_psf"}) {
        point.erase(key);
      }
    }
  }
  for (json& trajectory : file["trajectories"]) {
    for (const char* key :
         {"states_dt0_02", "states_dt0_001", "max_abs_difference_between_the_two"}) {
      trajectory.erase(key);
    }
  }
  return file;
}

class FdmPipeline : public ::testing::Test {
 protected:
  const ScratchDirectory scratch_;
  std::string folder_ = scratch_.path();
  json golden_ = json::parse(ReadFile(kGolden));

  json Run(const std::string& command, const json& input, const std::string& precision) {
    WriteFile(folder_ + "/in.json", input.dump());
    const ProgramResult result = CallSkein({"fdm", command, "--in", folder_ + "/in.json", "--out",
                                            folder_ + "/out.json", "--precision", precision});
    EXPECT_EQ(result.exit_code, 0) << result.error;
    return json::parse(ReadFile(folder_ + "/out.json"));
  }
};

TEST_F(FdmPipeline, Float64EqualsTheReference) {
  const json out = Run("eval", WithoutResults(golden_), "float64");
  for (const char* list : {"points", "edge_points"}) {
    ASSERT_EQ(out[list].size(), golden_[list].size());
    for (std::size_t i = 0; i < golden_[list].size(); ++i) {
      for (const char* key : {"coeffs", "xdot"}) {
        for (std::size_t c = 0; c < golden_[list][i][key].size(); ++c) {
          const double expected = golden_[list][i][key][c];
          EXPECT_NEAR(out[list][i][key][c].get<double>(), expected,
                      kSumOrder * std::max(1.0, std::abs(expected)))
              << list << '[' << i << "]." << key << '[' << c << ']';
        }
      }
    }
  }
}

TEST_F(FdmPipeline, Float32IsWithinItsTolerance) {
  const json out = Run("eval", WithoutResults(golden_), "float32");
  for (const char* key : {"coeffs", "xdot"}) {
    const std::size_t size = golden_["points"][0][key].size();
    for (std::size_t c = 0; c < size; ++c) {
      double largest = 0;
      for (const json& point : golden_["points"]) {
        largest = std::max(largest, std::abs(point[key][c].get<double>()));
      }
      for (const char* list : {"points", "edge_points"}) {
        for (std::size_t i = 0; i < golden_[list].size(); ++i) {
          const double expected = golden_[list][i][key][c];
          const double scale = std::max(std::abs(expected), kFloat32Floor * largest);
          EXPECT_NEAR(out[list][i][key][c].get<double>(), expected, kFloat32 * scale)
              << list << '[' << i << "]." << key << '[' << c << ']';
        }
      }
    }
  }
}

TEST_F(FdmPipeline, TrajectoriesEqualTheReference) {
  const json out = Run("simulate", WithoutResults(golden_), "float64");
  EXPECT_FALSE(out.contains("points")) << "not this command's";
  ASSERT_EQ(out["trajectories"].size(), golden_["trajectories"].size());
  for (std::size_t i = 0; i < golden_["trajectories"].size(); ++i) {
    for (const char* key : {"states_dt0_02", "states_dt0_001"}) {
      const json& expected = golden_["trajectories"][i][key];
      const json& flown = out["trajectories"][i][key];
      ASSERT_EQ(flown.size(), expected.size());
      for (std::size_t row = 0; row < expected.size(); ++row) {
        for (std::size_t c = 0; c < 13; ++c) {
          const double value = expected[row][c];
          EXPECT_NEAR(flown[row][c].get<double>(), value,
                      kTrajectory * std::max(1.0, std::abs(value)))
              << key << '[' << row << "][" << c << ']';
        }
      }
    }
  }
}

TEST_F(FdmPipeline, ResultsInTheInputAreIgnored) {
  json wrong = golden_;
  for (json& point : wrong["points"]) point["xdot"] = json::array({1, 2, 3});
  wrong["program"] = "another one";
  for (const char* command : {"eval", "simulate"}) {
    EXPECT_EQ(Run(command, wrong, "float64")["program"], json(ProgramJson())) << command;
  }
  EXPECT_EQ(Run("eval", wrong, "float64")["points"],
            Run("eval", WithoutResults(golden_), "float64")["points"]);
}

TEST_F(FdmPipeline, ParametersOfAPointAreHonoured) {
  json input = {{"points", json::array({golden_["points"][0], golden_["points"][0]})}};
  input["points"][1]["params"] = {{"xcg", 0.35}, {"heng", 160.0}};
  const json out = Run("eval", input, "float64");
  EXPECT_NE(out["points"][0]["xdot"], out["points"][1]["xdot"]);
}

// The centre of gravity of this aircraft is 5 % of the chord behind that of the F-16 shipped.
TEST_F(FdmPipeline, APointWithoutParametersHasTheAircraftsOwnCentreOfGravity) {
  const std::string aircraft = SKEIN_SOURCE "/examples/aircraft/stevens_lewis_f16.json";
  json point = TrimmedIn(folder_, "0", "502", {"--aircraft", aircraft});
  point.erase("params");
  json forward = point;
  forward["params"] = {{"xcg", 0.30}};
  const std::string in = folder_ + "/in.json", out = folder_ + "/out.json";
  WriteFile(in, json{{"points", json::array({point, forward})}}.dump());
  const auto pitch_acceleration = [&](const char* precision, std::size_t i) {
    EXPECT_EQ(CallSkein({"fdm", "eval", "--aircraft", aircraft, "--in", in, "--out", out,
                         "--precision", precision})
                  .exit_code,
              0);
    return json::parse(ReadFile(out))["points"][i]["xdot"][4].get<double>();
  };
  constexpr Tolerance kInFloat32{1e-4, "residual of the trim in float32, rad/s2"};
  for (const char* precision : {"float64", "float32"}) {
    EXPECT_NEAR(pitch_acceleration(precision, 0), 0, kInFloat32) << precision;
    EXPECT_GT(std::abs(pitch_acceleration(precision, 1)), 100 * kInFloat32) << precision;
  }
}

TEST_F(FdmPipeline, MalformedInputIsNamedInOneLine) {
  const json point = golden_["points"][0];
  const auto with = [&point](const char* key, const json& value) {
    json changed = point;
    changed[key] = value;
    return json{{"points", json::array({point, changed})}}.dump();
  };
  json no_state = point;
  no_state.erase("state");
  json trajectory = golden_["trajectories"][0];
  trajectory["t"] = {0, 0.05};
  json endless = golden_["trajectories"][0];
  endless["t"] = {0, 1e300};
  json too_fast = point["state"];
  too_fast[0] = 1e200;
  json pulse = golden_["trajectories"][0];
  pulse["pulses"][1]["control_index"] = 7;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{\n\"points\": [1,\n}", "in.json:3: not valid JSON"},
      {"", "it ends too early"},
      {"[]", "expected an object"},
      {"{}", "holds none of points"},
      {R"({"points": 3})", "points: expected a list"},
      {R"({"points": [3]})", "points[0]: expected an object"},
      {json{{"points", json::array({no_state})}}.dump(), "points[0]: state is missing"},
      {with("state", json::array({1, 2})), "points[1].state: expected a list of 13 numbers"},
      {with("state", json(std::vector<double>(13, 0.0))), "quaternion"},
      {with("controls", json::array({1, 2, "x", 4, 5})), "points[1].controls[2]"},
      {with("params", {{"mass", 1}}), "points[1].params.mass: unknown parameter"},
      {R"({"points": [{"state": [1e999]}]})", "not"},
      {json{{"trajectories", json::array({trajectory})}}.dump(), "not a multiple of the step"},
      {json{{"trajectories", json::array({pulse})}}.dump(), "pulses[1].control_index"},
      {json{{"trajectories", json::array({endless})}}.dump(), "more than 1000000000 steps"},
      {R"({"points": [], "x": )" + std::string(100000, '[') + std::string(100000, ']') + "}",
       "nested deeper than 100 levels"},
      {with("state", too_fast), "a value that is not finite"},
  };
  for (const auto& [text, expected] : cases) {
    WriteFile(folder_ + "/in.json", text);
    const ProgramResult result =
        CallSkein({"fdm", "eval", "--in", folder_ + "/in.json", "--out", folder_ + "/none.json"});
    EXPECT_EQ(result.exit_code, 1) << text;
    EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
    EXPECT_THAT(result.error, HasSubstr(expected));
  }
  const ProgramResult absent =
      CallSkein({"fdm", "eval", "--in", folder_ + "/absent.json", "--out", folder_ + "/x.json"});
  EXPECT_EQ(absent.exit_code, 2);
  EXPECT_THAT(absent.error, HasSubstr("No such file"));
}

// At the same place, what is dropped gains speed by the gravity there, in both precisions.
TEST_F(FdmPipeline, GravityActsOnThePointsOfAFile) {
  constexpr Tolerance kInFloat32{2e-4, "float32, ft/s2"};
  const std::vector<double> level = {500, 0, 0, 0, 0, 0, 0, 0, -40000, 1, 0, 0, 0};
  const json point = {{"state", level}, {"controls", {0, 0, 0, 0, 0}}};
  WriteFile(folder_ + "/in.json", json{{"points", json::array({point})}}.dump());
  const auto downward = [&](const std::string& precision, const std::vector<std::string>& gravity) {
    const std::string out = folder_ + "/out.json";
    std::vector<std::string> words = {"fdm",   "eval", "--in",        folder_ + "/in.json",
                                      "--out", out,    "--precision", precision};
    words.insert(words.end(), gravity.begin(), gravity.end());
    EXPECT_EQ(CallSkein(words).exit_code, 0);
    return json::parse(ReadFile(out))["points"][0]["xdot"][2].get<double>();
  };
  const double share = std::pow(1 + 40000 / 20855531.5, -2);  // a radius of 6,356,766 m
  for (const char* precision : {"float64", "float32"}) {
    const double usual = downward(precision, {});
    EXPECT_NEAR(downward(precision, {"--gravity-ft-s2", "5.3"}), usual - 32.17 + 5.3, kInFloat32);
    EXPECT_NEAR(downward(precision, {"--gravity-falls-with-altitude"}), usual - 32.17 * (1 - share),
                kInFloat32);
  }
}

TEST_F(FdmPipeline, LinearModelsHaveNamesForRowsAndColumns) {
  constexpr Tolerance kDigits{2e-3, "of the known modes, and power for thrust"};
  const std::string path = folder_ + "/model.json";
  const ProgramResult result = CallSkein(
      {"fdm", "linearise", "--altitude-ft", "15000", "--speed-fps", "500", "--json", path});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  const json point = json::parse(ReadFile(path))["points"][0];
  const auto has_shapes = [](const json& model) {
    const std::size_t states = model["states"].size(), outputs = model["outputs"].size();
    return model["A"].size() == states && model["A"][0].size() == states &&
           model["B"].size() == states && model["B"][0].size() == model["inputs"].size() &&
           model["C"].size() == outputs && model["C"][0].size() == states &&
           model["D"].size() == outputs && model["D"][0].size() == model["inputs"].size();
  };
  EXPECT_TRUE(has_shapes(point["bare_airframe"]));
  EXPECT_TRUE(has_shapes(point["with_flight_control"]["longitudinal"]));
  EXPECT_TRUE(has_shapes(point["with_flight_control"]["lateral"]));
  const json& modes = point["bare_airframe"]["modes"];
  ASSERT_EQ(modes.size(), 5u);
  EXPECT_EQ(modes[0]["name"], "short period");
  EXPECT_NEAR(modes[0]["eigenvalue_per_s"][0].get<double>(), -0.781, kDigits);
  EXPECT_NEAR(modes[0]["eigenvalue_per_s"][1].get<double>(), 0.727, kDigits);
  EXPECT_EQ(modes[2]["name"], "Dutch roll");
  EXPECT_THAT(result.output, HasSubstr("with flight control, longitudinal, 50 control steps"));
}

TEST_F(FdmPipeline, ModelsWithFlightControlAreOfStraightFlight) {
  const std::string path = folder_ + "/straight.json";
  const auto has_loops = [&](const std::vector<std::string>& manoeuvre) {
    std::vector<std::string> command = {"fdm",         "linearise", "--altitude-ft", "15000",
                                        "--speed-fps", "600",       "--json",        path};
    command.insert(command.end(), manoeuvre.begin(), manoeuvre.end());
    const ProgramResult result = CallSkein(command);
    EXPECT_EQ(result.exit_code, 0) << result.error;
    const bool is_said =
        result.output.find("models with flight control are of flight with level wings") !=
        std::string::npos;
    const json point = json::parse(ReadFile(path))["points"][0];
    EXPECT_EQ(point["bare_airframe"]["A"].size(), 9u);
    EXPECT_EQ(point.contains("with_flight_control"), !is_said);
    return !is_said;
  };
  EXPECT_TRUE(has_loops({"--flight-path-deg", "10"}));
  EXPECT_FALSE(has_loops({"--turn-rate-deg-s", "8"}));
  EXPECT_FALSE(has_loops({"--pull-up-g", "3"}));
}

// Level flight: thrust and aerodynamic force along and across the path hold drag and weight.
TEST_F(FdmPipeline, LiftAndDragAreInBalanceWithWeightAndThrust) {
  constexpr Tolerance kBalance{1e-6, "of the trim, relative"};
  constexpr Tolerance kBank{2e-4, "the aerodynamic tables are not symmetrical: it banks a little"};
  constexpr double kWingAreaFt2 = 300, kWeightLbf = 636.94 * 32.17;
  const json trim = TrimmedIn(folder_, "15000", "500", {});
  const double force_lbf = trim["qbar_psf"].get<double>() * kWingAreaFt2;
  const double alpha = trim["alpha_deg"].get<double>() * M_PI / 180;
  const double thrust_lbf = trim["controls"][0];
  EXPECT_NEAR(trim["drag_coefficient"].get<double>() * force_lbf, thrust_lbf * std::cos(alpha),
              kBalance * kWeightLbf);
  EXPECT_NEAR(trim["lift_coefficient"].get<double>() * force_lbf,
              kWeightLbf - thrust_lbf * std::sin(alpha), kBank * kWeightLbf);
}

TEST_F(FdmPipeline, PicturesShowPolarsAndHandlingLevels) {
  const std::string polar = folder_ + "/polar.svg", levels = folder_ + "/levels.svg";
  ASSERT_EQ(CallSkein({"fdm", "trim", "--altitude-ft", "0,40000", "--speed-fps", "300..900:100",
                       "--drag-rise", "--polar", polar})
                .exit_code,
            0);
  EXPECT_THAT(ReadFile(polar), HasSubstr("40,000 ft: lift over drag at most"));
  const std::string path = folder_ + "/sweep.json";
  const ProgramResult result =
      CallSkein({"fdm", "sweep", "--altitude-ft", "15000", "--speed-fps", "500,700", "--class",
                 "II", "--category", "C", "--picture", levels, "--json", path});
  ASSERT_EQ(result.exit_code, 0) << result.error;
  EXPECT_THAT(result.output, HasSubstr("levels of class II, category C"));
  EXPECT_THAT(ReadFile(levels), HasSubstr("boundary of level 1"));
  const json sweep = json::parse(ReadFile(path));
  EXPECT_EQ(sweep["class"], "II");
  EXPECT_EQ(sweep["points"][0]["bank_deg"], 30);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"sweep", "--class", "V"},
                                                {"sweep", "--picture", "x.png"},
                                                {"trim", "--polar", folder_ + "/one.svg"}}) {
    std::vector<std::string> command = {"fdm"};
    command.insert(command.end(), words.begin(), words.end());
    command.insert(command.end(), {"--altitude-ft", "15000", "--speed-fps", "500"});
    const ProgramResult wrong = CallSkein(command);
    EXPECT_EQ(wrong.exit_code, 2) << words[1];
    EXPECT_EQ(std::count(wrong.error.begin(), wrong.error.end(), '\n'), 1) << wrong.error;
  }
}

TEST_F(FdmPipeline, TrimIsSteadyFlight) {
  const json trim = TrimmedIn(folder_, "15000", "500", {});
  constexpr Tolerance kResidual{1e-6, "residual of the trim"};
  constexpr Tolerance kDigits{1e-4, "five decimals known"};
  // The trim is a point like any other: flown through `fdm eval`, nothing accelerates.
  const json out = Run("eval", {{"points", json::array({trim})}}, "float64");
  for (std::size_t c = 0; c < 6; ++c) {
    EXPECT_NEAR(out["points"][0]["xdot"][c].get<double>(), 0, kResidual);
  }
  EXPECT_NEAR(trim["alpha_deg"].get<double>(), 4.53134, kDigits);
}

// A pull-up bends the path upwards by the load factor's excess over gravity's share.
TEST_F(FdmPipeline, APullUpTurnsAsItsLoadFactorSays) {
  constexpr Tolerance kResidual{1e-6, "residual of the trim"};
  constexpr double kGravity = 32.17, kSpeed = 600, kLoadFactor = 3;
  const std::string path = folder_ + "/pull_up.json";
  ASSERT_EQ(CallSkein({"fdm", "trim", "--altitude-ft", "15000", "--speed-fps", "600",
                       "--flight-path-deg", "20", "--pull-up-g", "3", "--json", path})
                .exit_code,
            0);
  const json trim = json::parse(ReadFile(path));
  const json out = Run("eval", {{"points", json::array({trim})}}, "float64");
  const json& rate = out["points"][0]["xdot"];
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(rate[c].get<double>(), 0, kResidual);
  const double climb = std::asin(-rate[8].get<double>() / kSpeed);
  EXPECT_NEAR(climb, 20 * M_PI / 180, kResidual);
  const double p = trim["state"][3], q = trim["state"][4], r = trim["state"][5];
  EXPECT_NEAR(std::hypot(p, q, r), kGravity * (kLoadFactor - std::cos(climb)) / kSpeed, kResidual);
}

}  // namespace
}  // namespace skein
