// SPDX-License-Identifier: Apache-2.0
#include "src/report/report_flights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "envs/aircraft/registry.h"
#include "envs/task_registry.h"

namespace skein {
namespace {

using ::testing::ElementsAre;

constexpr double kStep_s = 0.02;

/// `count` flights of so many steps each, of the task Heading.
AgentFlights Flown(int count, std::size_t steps) {
  AgentFlights flown;
  flown.agent = "someone";
  flown.targets = MakeTask(flown.env)->target_quantities();
  RecordedFlight flight;
  flight.initial_state[static_cast<std::size_t>(kQ0)] = 1;
  flight.target.assign(flown.targets.size(), 0);
  RecordedStep step;
  step.state = flight.initial_state;
  step.target = flight.target;
  flight.steps.assign(steps, step);
  flight.steps.back().termination = Termination::kTimeLimit;
  flown.flights.assign(static_cast<std::size_t>(count), flight);
  return flown;
}

nlohmann::ordered_json First(const AgentFlights& flown, std::size_t most_rows) {
  DataPack pack;
  return FlightsJson({flown}, 0, most_rows, &pack)["flights"][0];
}

std::size_t RowsOf(const nlohmann::ordered_json& flight) {
  return flight["columns"]["north_ft"]["i16"][1].get<std::size_t>();
}

TEST(ReportFlightsTest, FewFlightsKeepEveryRow) {
  const auto flight = First(Flown(3, 99), 300);
  EXPECT_EQ(RowsOf(flight), 100u);
  EXPECT_DOUBLE_EQ(flight["interval_s"].get<double>(), kStep_s);
  EXPECT_DOUBLE_EQ(flight["duration_s"].get<double>(), 99 * kStep_s);
}

TEST(ReportFlightsTest, ManyFlightsShareTheRowsOfAPageAndSayWhenTheyEnd) {
  const auto flight = First(Flown(30, 99), 1000);
  EXPECT_EQ(RowsOf(flight), 34u);  // every third
  EXPECT_DOUBLE_EQ(flight["interval_s"].get<double>(), 3 * kStep_s);
  EXPECT_DOUBLE_EQ(flight["duration_s"].get<double>(), 99 * kStep_s);
}

TEST(ReportFlightsTest, AFlightThatLeavesRowsOutKeepsTheOneThatEndedIt) {
  AgentFlights flown = Flown(30, 100);
  constexpr float kLast_ft = 900;
  for (RecordedFlight& flight : flown.flights) {
    flight.steps.back().state[static_cast<std::size_t>(kNorth)] = kLast_ft;
  }
  const auto flight = First(flown, 1100);
  EXPECT_DOUBLE_EQ(flight["interval_s"].get<double>(), 3 * kStep_s);
  EXPECT_EQ(RowsOf(flight), 35u);  // every third, to 99, and 100
  // Its one value that differs stretches the column's levels.
  const auto& north = flight["columns"]["north_ft"];
  EXPECT_NEAR(north["unit"].get<double>() * DataPack::kMostLevels, kLast_ft, 1e-6 * kLast_ft);
}

TEST(ReportFlightsTest, ALongFlightLeavesRowsOutByItself) {
  EXPECT_LE(RowsOf(First(Flown(1, 30000), 1000000)), 4001u);
}

TEST(ReportFlightsTest, AMissionSaysWhenTargetsCameAndWhichWereReached) {
  AgentFlights flown = Flown(1, 100);
  std::vector<RecordedStep>& steps = flown.flights[0].steps;
  for (std::size_t k = 50; k < 100; ++k) steps[k].target[0] = 1;
  steps[49].reaches_target = true;
  const auto flight = First(flown, 1000);
  EXPECT_THAT(flight["new_target_s"], ElementsAre(50 * kStep_s));
  EXPECT_THAT(flight["reached_s"], ElementsAre(50 * kStep_s));
}

TEST(ReportFlightsTest, SaysHowWideTheAircraftIs) {
  AgentFlights flown = Flown(1, 9);
  for (const std::string& aircraft : AircraftNames()) {
    flown.env.aircraft = aircraft;
    DataPack pack;
    EXPECT_EQ(FlightsJson({flown}, 0, 100, &pack)["span_ft"],
              LoadAircraft(aircraft).airframe.span_ft)
        << aircraft;
  }
}

TEST(ReportFlightsTest, LeavesOutWhatNoPageShows) {
  const auto flight = First(Flown(1, 9), 100);
  EXPECT_FALSE(flight["columns"].contains("u_fps"));
  EXPECT_TRUE(flight["columns"].contains("altitude_ft"));
}

}  // namespace
}  // namespace skein
