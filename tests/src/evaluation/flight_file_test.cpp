// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/flight_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "envs/aircraft/aircraft.h"
#include "envs/state/attitude.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::vector<Row> Parse(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = Cells(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = Cells(line);
    EXPECT_EQ(cells.size(), names.size()) << line;
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
    EXPECT_EQ(row.size(), names.size()) << "a column's name occurs twice";
  }
  return rows;
}

/// At 20,000 ft, 800 ft/s along an axis 5 degrees above body x and 2 degrees to the right.
std::array<float, kNumRecordedColumns> State(const EulerAngles& attitude) {
  constexpr double kAlpha = 5 / kDegPerRad, kBeta = 2 / kDegPerRad;
  std::array<float, kNumRecordedColumns> state{};
  state[kU] = static_cast<float>(800 * std::cos(kAlpha) * std::cos(kBeta));
  state[kV] = static_cast<float>(800 * std::sin(kBeta));
  state[kW] = static_cast<float>(800 * std::sin(kAlpha) * std::cos(kBeta));
  state[kP] = static_cast<float>(10 / kDegPerRad);
  state[kQ] = static_cast<float>(-20 / kDegPerRad);
  state[kR] = static_cast<float>(30 / kDegPerRad);
  state[kNorth] = 100;
  state[kEast] = -200;
  state[kDown] = -20000;
  const Eigen::Vector4d quaternion = QuaternionFromEuler(attitude);
  for (int i = 0; i < 4; ++i) state[kQ0 + i] = static_cast<float>(quaternion[i]);
  state[kPower] = 42;
  state[kElevator] = -1;
  state[kAileron] = 2;
  state[kRudder] = -3;
  state[kLeadingEdgeFlap] = 4;
  state[kNz] = 1.5f;
  state[kNy] = -0.25f;
  return state;
}

class FlightFileTest : public ::testing::Test {
 protected:
  FlightFileTest() {
    EulerAngles attitude;
    attitude.roll = 40 / kDegPerRad;
    attitude.pitch = -10 / kDegPerRad;
    attitude.yaw = 170 / kDegPerRad;
    flight_.initial_state = State(attitude);
    flight_.target = {21000, static_cast<float>(-175 / kDegPerRad), 900};
    RecordedStep step;
    step.target = flight_.target;
    step.action = {-1, 0.25f, 0.5f, 1};
    step.stick = {-1, 0.25f, 0.5f, 1};
    attitude.yaw = 171 / kDegPerRad;
    step.state = State(attitude);
    step.reward = -0.5f;
    flight_.steps.push_back(step);
    step.termination = Termination::kOverload;
    step.reward = -200.5f;
    flight_.steps.push_back(step);
  }

  RecordedFlight flight_;
};

constexpr Tolerance kSevenDigits{1e-5, "seven digits of float32 states"};
constexpr Tolerance kVelocity{1e-2, "seven digits of float32 velocities"};
constexpr Tolerance kAtmospheres{0.005, "temperatures of the atmospheres differ"};
constexpr Tolerance kPosition{0.01, "seven digits of float32 of 2e4 ft"};
constexpr Tolerance kAngle{1e-4, "seven digits of degrees"};
constexpr Tolerance kAngleError{1e-3, "seven digits of differences of degrees"};

TEST_F(FlightFileTest, WritesStatesInTheUnitsOfTheirNames) {
  const std::vector<Row> rows = Parse(FlightsCsv(EnvConfig{}, {flight_}));
  ASSERT_EQ(rows.size(), 3u);
  const std::vector<std::pair<const char*, double>> expected = {{"north_ft", 100},
                                                                {"east_ft", -200},
                                                                {"altitude_ft", 20000},
                                                                {"roll_deg", 40},
                                                                {"pitch_deg", -10},
                                                                {"yaw_deg", 170},
                                                                {"p_deg_s", 10},
                                                                {"q_deg_s", -20},
                                                                {"r_deg_s", 30},
                                                                {"alpha_deg", 5},
                                                                {"beta_deg", 2},
                                                                {"true_airspeed_fps", 800},
                                                                {"load_factor_g", 1.5},
                                                                {"lateral_load_factor_g", -0.25},
                                                                {"power", 42},
                                                                {"elevator_deg", -1},
                                                                {"aileron_deg", 2},
                                                                {"rudder_deg", -3},
                                                                {"leading_edge_flap_deg", 4}};
  for (const auto& [name, value] : expected) {
    ASSERT_TRUE(rows[0].count(name)) << name;
    EXPECT_NEAR(std::stod(rows[0].at(name)), value, kSevenDigits * (1 + std::abs(value))) << name;
  }
  const double u = std::stod(rows[0].at("u_fps")), v = std::stod(rows[0].at("v_fps")),
               w = std::stod(rows[0].at("w_fps"));
  EXPECT_NEAR(std::hypot(u, v, w), 800, kVelocity);
  // The speed of sound at 20,000 ft is 1037 ft/s.
  EXPECT_NEAR(std::stod(rows[0].at("mach")), 800 / 1037.0, kAtmospheres);
}

TEST_F(FlightFileTest, ErrorsAreTargetMinusActualAndAnglesWrap) {
  const std::vector<Row> rows = Parse(FlightsCsv(EnvConfig{}, {flight_}));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_NEAR(std::stod(rows[0].at("target_altitude_ft")), 21000, kPosition);
  EXPECT_NEAR(std::stod(rows[0].at("target_yaw_deg")), -175, kAngle);
  EXPECT_NEAR(std::stod(rows[0].at("target_true_airspeed_fps")), 900, kPosition);
  EXPECT_NEAR(std::stod(rows[0].at("error_altitude_ft")), 1000, kPosition);
  EXPECT_NEAR(std::stod(rows[0].at("error_true_airspeed_fps")), 100, kPosition);
  // From 170 over the south to -175 degrees.
  EXPECT_NEAR(std::stod(rows[0].at("error_yaw_deg")), 15, kAngleError);
  EXPECT_NEAR(std::stod(rows[1].at("error_yaw_deg")), 14, kAngleError);
}

TEST_F(FlightFileTest, HasARowForTheStartAndOneForEveryStep) {
  EnvConfig config;
  config.control_interval_s = 0.01;
  RecordedFlight other = flight_;
  other.steps.pop_back();
  const std::vector<Row> rows = Parse(FlightsCsv(config, {other, flight_}));
  ASSERT_EQ(rows.size(), 5u);
  const char* const episodes[] = {"0", "0", "1", "1", "1"};
  const char* const times[] = {"0", "0.01", "0", "0.01", "0.02"};
  const char* const rewards[] = {"", "-0.5", "", "-0.5", "-200.5"};
  const char* const ends[] = {"", "", "", "", "overload"};
  const char* const rolls[] = {"", "0.5", "", "0.5", "0.5"};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("episode"), episodes[i]);
    EXPECT_EQ(rows[i].at("time_s"), times[i]);
    EXPECT_EQ(rows[i].at("reward"), rewards[i]);
    EXPECT_EQ(rows[i].at("termination"), ends[i]);
    EXPECT_EQ(rows[i].at("action_roll"), rolls[i]);
  }
  EXPECT_EQ(rows[1].at("action_throttle"), "-1");
  EXPECT_EQ(rows[1].at("action_pitch"), "0.25");
  EXPECT_EQ(rows[1].at("action_yaw"), "1");
}

TEST_F(FlightFileTest, FlightsOfHighLevelPoliciesShowBothActions) {
  EnvConfig config;
  config.task = "tracking";
  flight_.target = {1000, 2000, 18000};
  for (RecordedStep& step : flight_.steps) {
    step.action = {0.125f, -0.5f, 1};
    step.command = {0.25f, -2.5f, 830};
    step.target = flight_.target;
  }
  const std::vector<Row> rows = Parse(FlightsCsv(config, {flight_}));
  ASSERT_EQ(rows.size(), 3u);
  for (const char* name : {"action_target_pitch", "action_target_yaw", "action_target_speed"}) {
    ASSERT_TRUE(rows[0].count(name)) << name;
    EXPECT_EQ(rows[0].at(name), "");
  }
  EXPECT_EQ(rows[1].at("action_roll"), "0.5");
  EXPECT_EQ(rows[1].at("action_target_pitch"), "0.125");
  EXPECT_EQ(rows[1].at("action_target_yaw"), "-0.5");
  EXPECT_EQ(rows[1].at("action_target_speed"), "1");
  EXPECT_EQ(rows[0].at("command_pitch_deg"), "");
  EXPECT_NEAR(std::stod(rows[1].at("command_pitch_deg")), 0.25 * kDegPerRad, kAngle);
  EXPECT_NEAR(std::stod(rows[1].at("command_yaw_deg")), -2.5 * kDegPerRad, kAngle);
  EXPECT_EQ(rows[1].at("command_true_airspeed_fps"), "830");
  EXPECT_EQ(rows[1].at("target_east_ft"), "2000");
  EXPECT_NEAR(std::stod(rows[1].at("error_north_ft")), 900, kPosition);
  EXPECT_NEAR(std::stod(rows[1].at("error_east_ft")), 2200, kPosition);
  EXPECT_NEAR(std::stod(rows[1].at("error_altitude_ft")), -2000, kPosition);
}

TEST_F(FlightFileTest, TargetsAreThoseOfTheStep) {
  flight_.steps[1].target[0] = 19000;
  const std::vector<Row> rows = Parse(FlightsCsv(EnvConfig{}, {flight_}));
  EXPECT_EQ(rows[0].at("target_altitude_ft"), "21000");
  EXPECT_EQ(rows[1].at("target_altitude_ft"), "21000");
  EXPECT_EQ(rows[2].at("target_altitude_ft"), "19000");
  EXPECT_NEAR(std::stod(rows[2].at("error_altitude_ft")), -1000, kPosition);
}

TEST_F(FlightFileTest, NumbersThatAreNoneAreEmpty) {
  flight_.steps[1].state[kP] = std::nanf("");
  const std::vector<Row> rows = Parse(FlightsCsv(EnvConfig{}, {flight_}));
  EXPECT_EQ(rows[2].at("p_deg_s"), "");
}

}  // namespace
}  // namespace skein
