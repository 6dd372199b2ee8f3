// SPDX-License-Identifier: Apache-2.0
#include "src/replay/acmi_flights.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "envs/aircraft/aircraft.h"
#include "envs/aircraft/registry.h"
#include "envs/aircraft/units.h"
#include "envs/interface_names.h"
#include "src/bench/version.h"
#include "src/evaluation/flight_summary.h"
#include "src/replay/acmi_target.h"
#include "src/replay/flat_earth.h"

namespace skein {
namespace {

/// Between the end of an episode and the next, so that their marks can be told apart.
constexpr double kPause_s = 2;

/// All that the format knows, the ones that are easiest to tell apart first.
constexpr std::array<const char*, 7> kColours = {"Blue", "Orange", "Green", "Violet",
                                                 "Red",  "Cyan",   "Yellow"};

/// What Tacview calls an aircraft, to find its shape; else the aircraft's own name.
std::string NameOf(const Aircraft& aircraft) {
  return aircraft.name == "f16" ? "F-16C" : aircraft.name;
}

double LargestDeflection(const Actuator& actuator) {
  return std::max(std::abs(actuator.min_deg), std::abs(actuator.max_deg));
}

/// A column as a property of the aircraft: its values times `factor`.
struct Telemetry {
  const char* property;
  const std::vector<double>* column;
  double factor = 1;
  double offset = 0;
  int decimals = 2;
};

std::vector<Telemetry> TelemetryOf(const FlightTable& table, const Actuators& actuators) {
  const auto of = [&](const char* name) { return &table.Column(name); };
  const double aileron = 1 / LargestDeflection(actuators.aileron);
  return {
      {"TAS", of("true_airspeed_fps"), kMetresPerFoot, 0, 1},
      {"Mach", of("mach"), 1, 0, 3},
      {"AOA", of("alpha_deg")},
      {"AOS", of("beta_deg")},
      {"VerticalGForce", of("load_factor_g")},
      {"LateralGForce", of("lateral_load_factor_g")},
      {"Throttle", of("action_throttle"), 0.5, 0.5},
      {"RollControlInput", of("action_roll")},
      {"PitchControlInput", of("action_pitch")},
      {"YawControlInput", of("action_yaw")},
      {"AileronLeft", of("aileron_deg"), -aileron},
      {"AileronRight", of("aileron_deg"), aileron},
      {"Elevator", of("elevator_deg"), 1 / LargestDeflection(actuators.elevator)},
      {"Rudder", of("rudder_deg"), 1 / LargestDeflection(actuators.rudder)},
      {"Flaps", of("leading_edge_flap_deg"), 1 / LargestDeflection(actuators.leading_edge_flap)}};
}

/// One agent's flight of an episode, as it is written.
class AcmiFlight {
 public:
  AcmiFlight(const AgentFlights& agent, const Aircraft& aircraft, std::size_t episode,
             const char* colour)
      : agent_(agent),
        name_(NameOf(aircraft)),
        episode_(episode),
        colour_(colour),
        flight_(agent.flights[episode]),
        table_(TableOf(agent.env, flight_)),
        target_(agent.targets, table_),
        telemetry_(TelemetryOf(table_, aircraft.actuators)) {}

  std::size_t rows() const { return table_.rows(); }
  std::string DescribeTarget() const { return target_.Describe(0); }

  void Write(std::size_t row, AcmiWriter* writer) {
    if (row == 0) Begin(writer);
    // What ends as non_finite has nowhere to be.
    if (std::isfinite(table_.Column("u_fps")[row])) {
      writer->Place(aircraft_, TransformAt(row));
      writer->Set(aircraft_, PropertiesAt(row));
      WriteTarget(row, writer);
    }
    if (row == 0) return;
    if (flight_.steps[row - 1].reaches_target && row + 1 < rows()) {
      writer->AddEvent("Message", {aircraft_}, agent_.agent + " reached its target");
    }
    if (row + 1 == rows()) End(writer);
  }

 private:
  void Begin(AcmiWriter* writer) {
    aircraft_ = writer->NewObject();
    writer->Set(aircraft_, {{"Name", name_},
                            {"Type", "Air+FixedWing"},
                            {"CallSign", agent_.agent},
                            {"Group", fmt::format("episode {}", episode_)},
                            {"Color", colour_}});
  }

  AcmiTransform TransformAt(std::size_t row) const {
    const auto at = [&](const char* name) { return table_.Column(name)[row]; };
    return TransformOf({at("north_ft"), at("east_ft"), at("altitude_ft"), at("roll_deg"),
                        at("pitch_deg"), at("yaw_deg")});
  }

  std::vector<AcmiProperty> PropertiesAt(std::size_t row) const {
    std::vector<AcmiProperty> properties;
    for (const Telemetry& telemetry : telemetry_) {
      const double value = (*telemetry.column)[row];
      if (!std::isfinite(value)) continue;  // commands at time 0, surfaces that there are not
      const double shown = value * telemetry.factor + telemetry.offset;
      if (!std::isfinite(shown)) continue;
      properties.emplace_back(telemetry.property, AcmiNumber(shown, telemetry.decimals));
    }
    if (row > 0 && table_.Has("command_pitch_deg")) {
      properties.emplace_back("Label", HighLevelCommand(row));
    }
    return properties;
  }

  std::string HighLevelCommand(std::size_t row) const {
    const auto at = [&](const char* name) { return table_.Column(name)[row]; };
    return fmt::format("commands pitch {} deg, yaw {} deg, true airspeed {} m/s",
                       AcmiNumber(at("command_pitch_deg"), 1), AcmiNumber(at("command_yaw_deg"), 1),
                       AcmiNumber(at("command_true_airspeed_fps") * kMetresPerFoot, 1));
  }

  void WriteTarget(std::size_t row, AcmiWriter* writer) {
    if (target_.IsNew(row)) {
      if (row > 0) writer->Remove(target_object_);
      target_object_ = writer->NewObject();
      std::vector<AcmiProperty> properties = {{"Name", "target"},
                                              {"Type", "Navaid+Static+Waypoint"},
                                              {"CallSign", "target of " + agent_.agent},
                                              {"Color", colour_},
                                              {"Label", target_.Describe(row)}};
      for (const AcmiProperty& size : target_.Size()) properties.push_back(size);
      writer->Set(target_object_, properties);
      writer->Set(aircraft_, {{"FocusedTarget", fmt::format("{:x}", target_object_)}});
    }
    writer->Place(target_object_, target_.Place(row));
  }

  void End(AcmiWriter* writer) {
    const char* const end =
        kTerminationNames[static_cast<std::size_t>(flight_.steps.back().termination)];
    const bool is_flown = IsMissionFlown(EvaluationConfig(agent_.env).mission.enabled(), end);
    writer->AddEvent(
        "Message", {aircraft_},
        fmt::format("{}: {} after {} s", agent_.agent, is_flown ? "mission flown" : end,
                    AcmiNumber(table_.Column("time_s").back(), 2)));
    // Nothing was destroyed: Tacview is told that they have left.
    for (const std::uint64_t object : {aircraft_, target_object_}) {
      writer->AddEvent("LeftArea", {object}, "");
      writer->Remove(object);
    }
  }

  const AgentFlights& agent_;
  std::string name_;
  std::size_t episode_;
  const char* colour_;
  const RecordedFlight& flight_;
  FlightTable table_;
  AcmiTarget target_;
  std::vector<Telemetry> telemetry_;
  std::uint64_t aircraft_ = 0, target_object_ = 0;
};

/// Writes the episode from `start_s` on, and says when it ends.
double WriteEpisode(const std::vector<AgentFlights>& agents, const Aircraft& aircraft,
                    std::size_t episode, double start_s, AcmiWriter* writer) {
  std::vector<std::unique_ptr<AcmiFlight>> flights;  // they refer to their own members
  std::size_t rows = 0;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    flights.push_back(
        std::make_unique<AcmiFlight>(agents[i], aircraft, episode, kColours[i % kColours.size()]));
    rows = std::max(rows, flights.back()->rows());
  }
  const double interval_s = agents.front().env.control_interval_s;
  for (std::size_t row = 0; row < rows; ++row) {
    writer->BeginFrame(start_s + static_cast<double>(row) * interval_s);
    if (row == 0) {
      writer->AddEvent("Bookmark", {},
                       fmt::format("episode {}: {}", episode, flights.front()->DescribeTarget()));
    }
    for (const auto& flight : flights) {
      if (row < flight->rows()) flight->Write(row, writer);
    }
  }
  return start_s + static_cast<double>(rows - 1) * interval_s;
}

}  // namespace

AcmiRecording RecordAcmi(const std::vector<AgentFlights>& agents, const std::string& title,
                         const std::string& comments) {
  // Noon at the reference, of no particular day: files are equal for equal flights.
  AcmiWriter writer({{"ReferenceTime", "2000-06-21T20:00:00Z"},
                     {"ReferenceLongitude", AcmiNumber(kReferenceLongitude_deg, 4)},
                     {"ReferenceLatitude", AcmiNumber(kReferenceLatitude_deg, 4)},
                     {"DataSource", fmt::format("Skein {}", Build().version)},
                     {"DataRecorder", fmt::format("Skein {}", Build().version)},
                     {"Title", title},
                     {"Comments", comments}});
  const Aircraft aircraft = LoadAircraft(agents.front().env.aircraft);  // all fly the same
  double start_s = 0;
  for (std::size_t episode = 0; episode < agents.front().flights.size(); ++episode) {
    start_s = WriteEpisode(agents, aircraft, episode, start_s, &writer) + kPause_s;
  }
  return writer.Finish();
}

}  // namespace skein
