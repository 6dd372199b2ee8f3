// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/commanded_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/number_text.h"
#include "envs/aircraft/engine.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"
#include "src/evaluation/state_readings.h"
#include "src/files/csv_columns.h"
#include "src/files/output_file.h"
#include "src/files/plain_line.h"

namespace skein {
namespace {

constexpr int kDigits = 7;  // as in other files of flights

struct StickColumn {
  const char* name;
  double PilotCommands::*stick;
  double least;
};
constexpr std::array<StickColumn, 4> kStickColumns = {{{"throttle", &PilotCommands::throttle, 0},
                                                       {"pitch", &PilotCommands::pitch, -1},
                                                       {"roll", &PilotCommands::roll, -1},
                                                       {"yaw", &PilotCommands::yaw, -1}}};

/// Other programs, and people, leave a last line without its end.
std::string WithLastLineEnded(std::string text) {
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text;
}

void CheckColumns(const CsvColumns& table, const std::string& path) {
  if (table.rows() == 0 || table.rows_left_out > 0) {
    throw Error(path + ": expected a header and rows of as many numbers, with commas between them");
  }
  if (table.Find("time_s") == nullptr) throw Error(path + ": no column time_s");
  for (const std::string& name : table.names) {
    bool is_known = name == "time_s";
    for (const StickColumn& column : kStickColumns) is_known = is_known || name == column.name;
    if (!is_known) {
      throw Error(fmt::format("{}: column {}: time_s, throttle, pitch, roll and yaw are known",
                              path, PlainLine(name)));
    }
    if (std::count(table.names.begin(), table.names.end(), name) > 1) {
      throw Error(fmt::format("{}: column {} is there twice", path, name));
    }
  }
}

/// Of the aircraft, body axes, ft/s.
Eigen::Vector3d VelocityThrough(const ClosedLoop& loop, const Eigen::Vector3d& wind) {
  const RigidBodyState& state = loop.state();
  return state.segment<3>(kU) - BodyFromNed(state.segment<4>(kQ0)) * wind;
}

std::vector<Reading> Readings(const ClosedLoop& loop, const Eigen::Vector3d& wind) {
  return StateReadings(
      {loop.state(), wind, loop.air(), loop.nz(), loop.ny(), loop.power(), loop.surfaces()});
}

std::string Header(const std::vector<Reading>& readings) {
  std::string header = "episode,time_s";
  for (const Reading& reading : readings) header += std::string(",") + reading.first;
  for (const StickColumn& column : kStickColumns) header += std::string(",action_") + column.name;
  return header + ",termination\n";
}

std::string Row(double time, const std::vector<Reading>& readings, const PilotCommands* sticks) {
  std::string row = "0," + RoundedText(time, kDigits);
  for (const Reading& reading : readings) row += "," + RoundedText(reading.second, kDigits);
  for (const StickColumn& column : kStickColumns) {
    row += "," + (sticks == nullptr ? "" : RoundedText(sticks->*column.stick, kDigits));
  }
  return row + ",\n";
}

}  // namespace

std::vector<StickCommand> ReadStickCommands(const std::string& path, const PilotCommands& trimmed) {
  const CsvColumns table = ParseCsv(WithLastLineEnded(ReadFile(path)));
  CheckColumns(table, path);
  std::vector<StickCommand> commands;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    StickCommand command{(*table.Find("time_s"))[row], trimmed};
    if (!(command.time_s >= 0) || !(commands.empty() || command.time_s > commands.back().time_s)) {
      throw Error(fmt::format("{}: row {}: times are from 0 on and increase", path, row + 1));
    }
    for (const StickColumn& column : kStickColumns) {
      const std::vector<double>* values = table.Find(column.name);
      if (values == nullptr) continue;
      const double value = (*values)[row];
      if (!(value >= column.least && value <= 1)) {
        throw Error(fmt::format("{}: row {}: {} is not a number from {} to 1", path, row + 1,
                                column.name, column.least));
      }
      command.sticks.*column.stick = value;
    }
    commands.push_back(command);
  }
  return commands;
}

long CommandedFlight::Steps() const { return std::lround(seconds / step_s); }

std::string FlyCommands(const Plant& plant, const TrimPoint& trim, const CommandedFlight& flight) {
  constexpr double kBound = 1e9;      // of every state, ft, ft/s, rad/s
  constexpr double kRounding = 1e-9;  // s: a time that is a multiple of the step but for rounding
  ClosedLoop loop(plant, trim, flight.mode, flight.step_s, flight.substeps);
  // What moves with the air is at rest as in still air.
  loop.mutable_state().segment<3>(kU) += BodyFromNed(trim.state.segment<4>(kQ0)) * flight.wind_ft_s;
  Gusts gusts(flight.gusts, plant.aircraft().airframe.span_ft);
  Eigen::Vector3d wind;
  const auto meet = [&](const Gust& gust) {
    wind = flight.wind_ft_s + gust.wind_ft_s;
    loop.set_wind(wind, gust.air_rates_rad_s);
  };
  meet(gusts.Start(loop.state()));
  PilotCommands sticks;
  sticks.throttle = ThrottleForPower(plant.aircraft().throttle_gearing, trim.power);
  const std::vector<Reading> at_start = Readings(loop, wind);
  std::string text = Header(at_start) + Row(0, at_start, nullptr);
  std::size_t next = 0;
  const long steps = flight.Steps();
  for (long i = 0; i < steps; ++i) {
    const double time = static_cast<double>(i) * flight.step_s;
    for (; next < flight.commands.size() && flight.commands[next].time_s <= time + kRounding;
         ++next) {
      sticks = flight.commands[next].sticks;
    }
    loop.Step(sticks);
    const double end = static_cast<double>(i + 1) * flight.step_s;
    if (!(loop.state().cwiseAbs().maxCoeff() < kBound)) {
      throw Error(
          fmt::format("after {} s the flight is beyond all numbers: is a step of {} s short "
                      "enough?",
                      RoundedText(end, kDigits), flight.step_s));
    }
    meet(gusts.Advance(loop.state(), VelocityThrough(loop, wind), flight.step_s));
    text += Row(end, Readings(loop, wind), &sticks);
  }
  return text;
}

}  // namespace skein
