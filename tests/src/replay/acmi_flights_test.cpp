// SPDX-License-Identifier: Apache-2.0
#include "src/replay/acmi_flights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "envs/aircraft/aircraft.h"
#include "src/replay/acmi_target.h"
#include "tests/src/replay/acmi_reader.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

constexpr double kMetresPerFoot = 0.3048;
constexpr Tolerance kHundredths{0.0051, "two decimals"};
constexpr Tolerance kThousandths{0.00051, "three decimals"};
constexpr Tolerance kTenths{0.051, "one decimal"};
constexpr Tolerance kPosition{0.1, "seven decimals of degrees, and a sphere's curvature over a km"};
constexpr Tolerance kTime{1e-9, "float64 rounding: times have four decimals, steps of 0.02 s two"};
constexpr Tolerance kDistance{0.015, "m: both ends are rounded to centimetres"};
constexpr Tolerance kSlope{0.02, "a marker's place is rounded to centimetres"};

/// North and east of a point of the earth seen from another, m: by way of the earth-centred axes of
/// WGS 84.
std::pair<double, double> NorthEast(double longitude, double latitude, double from_longitude,
                                    double from_latitude) {
  const auto centred = [](double longitude_deg, double latitude_deg) {
    const double lon = longitude_deg / kDegPerRad, lat = latitude_deg / kDegPerRad;
    const double squashed = 1 - 1 / 298.257223563;
    const double n =
        6378137 / std::sqrt(1 - (1 - squashed * squashed) * std::pow(std::sin(lat), 2));
    return std::array<double, 3>{n * std::cos(lat) * std::cos(lon),
                                 n * std::cos(lat) * std::sin(lon),
                                 n * squashed * squashed * std::sin(lat)};
  };
  const auto there = centred(longitude, latitude), here = centred(from_longitude, from_latitude);
  const double x = there[0] - here[0], y = there[1] - here[1], z = there[2] - here[2];
  const double lon = from_longitude / kDegPerRad, lat = from_latitude / kDegPerRad;
  return {-std::sin(lat) * (std::cos(lon) * x + std::sin(lon) * y) + std::cos(lat) * z,
          -std::sin(lon) * x + std::cos(lon) * y};
}

double Wrapped(double degrees) { return std::remainder(degrees, 360.0); }

class AcmiFlightsTest : public ::testing::Test {
 protected:
  AcmiFlightsTest() {
    env_.time_limit_steps = 60;
    env_.heading.earliest_success_step = 30;
  }

  /// Zero actions and random ones.
  std::vector<AgentFlights> Fly(int episodes) {
    EvaluationOptions options;
    options.episodes = episodes;
    const Agent random = Agent::Random(10);
    return {FlyAndRecord("zero", Agent::Zero(), Agent::Zero().EnvironmentFor(env_), options,
                         episodes, pool_),
            FlyAndRecord("random", random, random.EnvironmentFor(env_), options, episodes, pool_)};
  }

  static AcmiDocument Write(const std::vector<AgentFlights>& agents) {
    return ReadAcmi(AcmiFile(RecordAcmi(agents, "title", "comments")));
  }

  /// Those of one agent, or of its targets, in the order of the episodes.
  static std::vector<const AcmiObject*> ObjectsOf(const AcmiDocument& document,
                                                  const std::string& call_sign) {
    std::vector<const AcmiObject*> objects;
    for (const auto& [id, object] : document.objects) {
      if (object.property("CallSign") == call_sign) objects.push_back(&object);
    }
    return objects;
  }

  EnvConfig env_;
  WorkerPool pool_{1};
};

TEST_F(AcmiFlightsTest, AircraftAreWhereTheyFlewWithTheirOwnAttitude) {
  const std::vector<AgentFlights> agents = Fly(2);
  const AcmiDocument document = Write(agents);
  const double reference[] = {std::stod(document.properties.at("ReferenceLongitude")),
                              std::stod(document.properties.at("ReferenceLatitude"))};
  for (const AgentFlights& agent : agents) {
    const std::vector<const AcmiObject*> objects = ObjectsOf(document, agent.agent);
    ASSERT_EQ(objects.size(), 2u);
    for (std::size_t episode = 0; episode < 2; ++episode) {
      const FlightTable table = TableOf(agent.env, agent.flights[episode]);
      const std::vector<AcmiSample>& samples = objects[episode]->samples;
      ASSERT_EQ(samples.size(), table.rows());
      for (std::size_t row = 0; row < table.rows(); ++row) {
        const auto at = [&](const char* name) { return table.Column(name)[row]; };
        const auto& t = samples[row].transform;
        EXPECT_NEAR(samples[row].time_s - samples[0].time_s, at("time_s"), kTime);
        const auto [north, east] = NorthEast(t[0], t[1], reference[0], reference[1]);
        EXPECT_NEAR(north, at("north_ft") * kMetresPerFoot, kPosition) << row;
        EXPECT_NEAR(east, at("east_ft") * kMetresPerFoot, kPosition) << row;
        EXPECT_NEAR(t[2], at("altitude_ft") * kMetresPerFoot, kHundredths) << row;
        EXPECT_NEAR(Wrapped(t[3] - at("roll_deg")), 0, kHundredths) << row;
        EXPECT_NEAR(t[4], at("pitch_deg"), kHundredths) << row;
        EXPECT_NEAR(Wrapped(t[5] - at("yaw_deg")), 0, kHundredths) << row;
        EXPECT_NEAR(t[6], at("east_ft") * kMetresPerFoot, kHundredths) << row;
        EXPECT_NEAR(t[7], at("north_ft") * kMetresPerFoot, kHundredths) << row;
        EXPECT_EQ(t[8], t[5]) << "north is north on both earths";
      }
    }
  }
}

TEST_F(AcmiFlightsTest, TelemetryIsInTheFormatsUnits) {
  const std::vector<AgentFlights> agents = Fly(1);
  const AcmiDocument document = Write(agents);
  const FlightTable table = TableOf(agents[1].env, agents[1].flights[0]);
  const std::vector<AcmiSample>& samples = ObjectsOf(document, "random")[0]->samples;
  EXPECT_EQ(samples[0].properties.count("Throttle"), 0u) << "no commands before the first step";
  for (std::size_t row = 1; row < table.rows(); ++row) {
    const auto at = [&](const char* name) { return table.Column(name)[row]; };
    const auto shown = [&](const char* name) {
      return std::stod(samples[row].properties.at(name));
    };
    EXPECT_NEAR(shown("TAS"), at("true_airspeed_fps") * kMetresPerFoot, kTenths);
    EXPECT_NEAR(shown("Mach"), at("mach"), kThousandths);
    EXPECT_NEAR(shown("AOA"), at("alpha_deg"), kHundredths);
    EXPECT_NEAR(shown("AOS"), at("beta_deg"), kHundredths);
    EXPECT_NEAR(shown("VerticalGForce"), at("load_factor_g"), kHundredths);
    EXPECT_NEAR(shown("Throttle"), (at("action_throttle") + 1) / 2, kHundredths);
    EXPECT_NEAR(shown("RollControlInput"), at("action_roll"), kHundredths);
    EXPECT_NEAR(shown("PitchControlInput"), at("action_pitch"), kHundredths);
    // Shares of the F-16's largest deflections.
    EXPECT_NEAR(shown("Elevator"), at("elevator_deg") / 25, kHundredths);
    EXPECT_NEAR(shown("AileronRight"), at("aileron_deg") / 21.5, kHundredths);
    EXPECT_NEAR(shown("AileronLeft"), -at("aileron_deg") / 21.5, kHundredths);
    EXPECT_NEAR(shown("Rudder"), at("rudder_deg") / 30, kHundredths);
  }
}

TEST_F(AcmiFlightsTest, EpisodesFollowEachOtherWithAllAgentsSideBySide) {
  const AcmiDocument document = Write(Fly(3));
  const auto zero = ObjectsOf(document, "zero"), random = ObjectsOf(document, "random");
  double ended_s = -1;
  for (std::size_t episode = 0; episode < 3; ++episode) {
    const AcmiSample& first = zero[episode]->samples.front();
    const AcmiSample& other = random[episode]->samples.front();
    EXPECT_GT(first.time_s, ended_s);
    EXPECT_EQ(first.time_s, other.time_s);
    EXPECT_EQ(first.transform, other.transform);
    EXPECT_NE(first.properties.at("Color"), other.properties.at("Color"));
    EXPECT_EQ(first.properties.at("Color"), zero[0]->property("Color"));
    EXPECT_EQ(first.properties.at("Name"), "F-16C");
    EXPECT_EQ(first.properties.at("Group"), "episode " + std::to_string(episode));
    ended_s = std::max(zero[episode]->removed_s, random[episode]->removed_s);
  }
}

TEST_F(AcmiFlightsTest, EveryFlightEndsWithItsReason) {
  env_.termination.max_load_factor = 1.2;
  const std::vector<AgentFlights> agents = Fly(4);
  const AcmiDocument document = Write(agents);
  for (const auto& [id, object] : document.objects) {
    EXPECT_EQ(object.removed_s, object.samples.back().time_s) << "nothing stays, object " << id;
  }
  std::set<std::string> kinds;
  for (const AgentFlights& agent : agents) {
    const auto objects = ObjectsOf(document, agent.agent);
    for (std::size_t episode = 0; episode < objects.size(); ++episode) {
      const RecordedFlight& flight = agent.flights[episode];
      const std::string kind =
          kTerminationNames[static_cast<std::size_t>(flight.steps.back().termination)];
      kinds.insert(kind);
      const bool is_told =
          std::any_of(document.events.begin(), document.events.end(), [&](const AcmiEvent& event) {
            return event.kind == "Message" && event.time_s == objects[episode]->removed_s &&
                   event.text.rfind(agent.agent + ": " + kind + " after ", 0) == 0;
          });
      EXPECT_TRUE(is_told) << agent.agent << " in episode " << episode;
    }
  }
  EXPECT_GE(kinds.size(), 2u) << "the test shows little";
}

TEST_F(AcmiFlightsTest, PointsAreShownWhereTheyLieInABoxOfTheirTolerance) {
  env_.task = "tracking";
  env_.tracking.acts_directly = true;
  env_.tracking.position_tolerance_ft = 100;
  const std::vector<AgentFlights> agents = Fly(1);
  const AcmiDocument document = Write(agents);
  const AcmiObject& target = *ObjectsOf(document, "target of zero").at(0);
  const std::vector<float>& point = agents[0].flights[0].target;
  const auto& t = target.samples.front().transform;
  EXPECT_NEAR(t[7], point[0] * kMetresPerFoot, kHundredths);
  EXPECT_NEAR(t[6], point[1] * kMetresPerFoot, kHundredths);
  EXPECT_NEAR(t[2], point[2] * kMetresPerFoot, kHundredths);
  for (const char* side : {"Length", "Width", "Height"}) {
    EXPECT_NEAR(std::stod(target.property(side)), 2 * 100 * kMetresPerFoot, kHundredths);
  }
  EXPECT_EQ(target.samples.size(), 1u) << "it stays where it is";
  EXPECT_THAT(target.property("Label"), HasSubstr("+- 30.5 m"));
}

TEST_F(AcmiFlightsTest, HeadingsAreMarkedAheadAtTheAltitudeAskedFor) {
  const std::vector<AgentFlights> agents = Fly(1);
  const AcmiDocument document = Write(agents);
  const FlightTable table = TableOf(agents[1].env, agents[1].flights[0]);
  const auto& aircraft = ObjectsOf(document, "random").at(0)->samples;
  const AcmiObject& target = *ObjectsOf(document, "target of random").at(0);
  ASSERT_EQ(target.samples.size(), aircraft.size());
  for (std::size_t row = 0; row < aircraft.size(); ++row) {
    const auto &t = target.samples[row].transform, &a = aircraft[row].transform;
    EXPECT_NEAR(t[2], table.Column("target_altitude_ft")[row] * kMetresPerFoot, kHundredths);
    const double bearing = std::atan2(t[6] - a[6], t[7] - a[7]) * kDegPerRad;
    EXPECT_NEAR(Wrapped(bearing - table.Column("target_yaw_deg")[row]), 0, kSlope);
    EXPECT_NEAR(std::hypot(t[6] - a[6], t[7] - a[7]), 1852, kDistance);
  }
  EXPECT_NEAR(std::stod(target.property("Height")), 2 * 100 * kMetresPerFoot, kHundredths);
  EXPECT_THAT(target.property("Label"), HasSubstr("yaw "));
  EXPECT_THAT(target.property("Label"), HasSubstr("+- 5 deg"));
}

TEST(AcmiTargetTest, WordsHaveEveryUnitAndShowEveryTolerance) {
  const std::vector<TargetQuantity> quantities = {{"altitude_ft", false, 1, 100},
                                                  {"true_airspeed_fps", false, 1, 0.1},
                                                  {"yaw_deg", true, 1, 5},
                                                  {"p_deg_s", false, 1, 2.5},
                                                  {"load_factor_g", false, 1, 0.02},
                                                  {"mach", false, 1, 0.004},
                                                  {"power", false, 1, 0}};
  FlightTable flight;
  for (const TargetQuantity& quantity : quantities) {
    flight.names.push_back(std::string("target_") + quantity.column);
  }
  flight.columns = {{5000}, {1000}, {10}, {-30}, {2.7}, {0.8}, {50}};
  flight.terminations = {Termination::kNone};
  EXPECT_EQ(AcmiTarget(quantities, flight).Describe(0),
            "altitude 1524 +- 30.5 m, true airspeed 304.8 +- 0.03 m/s, yaw 10 +- 5 deg, "
            "p -30 +- 2.5 deg/s, load factor 2.7 +- 0.02 g, mach 0.8 +- 0.004, power 50");
}

TEST_F(AcmiFlightsTest, MissionsShowEveryTargetAndWhenItIsReached) {
  env_.mission.length_s = 1.2;
  env_.mission.dwell_s = 0.2;
  env_.heading.altitude_tolerance_ft = env_.heading.speed_tolerance_fps = 1e6;
  env_.heading.yaw_tolerance_deg = 180;
  env_.heading.earliest_success_step = 1;
  const AcmiDocument document = Write(Fly(1));
  const auto targets = ObjectsOf(document, "target of zero");
  EXPECT_EQ(targets.size(), 6u) << "one for every 0.2 s of 1.2 s";
  EXPECT_EQ(
      std::count_if(document.events.begin(), document.events.end(),
                    [](const AcmiEvent& event) { return event.text == "zero reached its target"; }),
      5)
      << "the last one is the flight's end";
  EXPECT_TRUE(std::any_of(
      document.events.begin(), document.events.end(),
      [](const AcmiEvent& event) { return event.text == "zero: mission flown after 1.2 s"; }));
}

TEST_F(AcmiFlightsTest, CommandsOfAHighLevelPolicyAreTheAircraftsLabel) {
  env_.task = "tracking";
  env_.tracking.acts_directly = true;
  std::vector<AgentFlights> agents = Fly(1);
  for (RecordedStep& step : agents[0].flights[0].steps) {
    step.action = {0, 0, 0};
    step.command = {0.5f, -1, 800};
  }
  EXPECT_EQ(ObjectsOf(Write(agents), "zero")[0]->samples[1].properties.at("Label"),
            "commands pitch 28.6 deg, yaw -57.3 deg, true airspeed 243.8 m/s");
}

TEST_F(AcmiFlightsTest, NamesOfAnyKindStayNames) {
  std::vector<AgentFlights> agents = Fly(1);
  agents[0].agent = "policy:a,b\\c|-1\n#5\nd";
  const AcmiDocument document = Write(agents);
  EXPECT_EQ(ObjectsOf(document, "policy:a,b\\c|-1 #5 d").size(), 1u);
  EXPECT_TRUE(std::any_of(document.events.begin(), document.events.end(), [](const auto& event) {
    return event.text.rfind("policy:a,b\\c/-1 #5 d: ", 0) == 0;
  }));
}

TEST_F(AcmiFlightsTest, AStateThatIsNotFiniteIsLeftOut) {
  std::vector<AgentFlights> agents = Fly(1);
  RecordedStep& last = agents[0].flights[0].steps.back();
  last.state.fill(std::nanf(""));
  last.termination = Termination::kNonFinite;
  const AcmiDocument document = Write(agents);  // refuses what is no number
  EXPECT_EQ(ObjectsOf(document, "zero")[0]->samples.size(), agents[0].flights[0].steps.size());
}

TEST(AcmiWriter, WritesOnlyWhatHasChanged) {
  AcmiWriter writer({});
  writer.BeginFrame(0);
  const std::uint64_t object = writer.NewObject();
  writer.Place(object, {"1", "2", "3", "4", "5", "6", "7", "8", "6"});
  writer.Set(object, {{"Name", "a"}, {"Mach", "0.5"}});
  writer.BeginFrame(0.02);
  writer.Place(object, {"1", "2", "3.5", "4", "5", "6", "7", "8.25", "6"});
  writer.Set(object, {{"Name", "a"}, {"Mach", "0.6"}});
  writer.BeginFrame(0.04);
  writer.Place(object, {"1", "2", "3.5", "4", "5", "6", "7", "8.25", "6"});
  writer.Set(object, {{"Name", "a"}, {"Mach", "0.6"}});
  const AcmiRecording recording = writer.Finish();
  EXPECT_EQ(recording.frames[0].text, "#0\n1,T=1|2|3|4|5|6|7|8|6\n1,Name=a,Mach=0.5\n");
  EXPECT_EQ(recording.frames[1].text, "#0.02\n1,T=||3.5|||||8.25|\n1,Mach=0.6\n");
  EXPECT_EQ(recording.frames[2].text, "#0.04\n");
}

TEST(AcmiWriter, NumbersHaveNoZerosAtTheirEnd) {
  EXPECT_EQ(AcmiNumber(1.5, 3), "1.5");
  EXPECT_EQ(AcmiNumber(-0.001, 2), "0");
  EXPECT_EQ(AcmiNumber(100, 0), "100");
  EXPECT_EQ(AcmiNumber(120, 2), "120");
}

}  // namespace
}  // namespace skein
