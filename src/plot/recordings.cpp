// SPDX-License-Identifier: Apache-2.0
#include "src/plot/recordings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "base/ends_with.h"
#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/env_config.h"
#include "src/evaluation/flight_summary.h"
#include "src/files/column_words.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr const char* kTargetPrefix = "target_";

bool IsAngle(const std::string& column) { return EndsWith(column, "_deg"); }

/// The same angles without jumps of 360 degrees.
std::vector<double> Unwrapped(std::vector<double> degrees) {
  double last = std::nan("");
  for (double& angle : degrees) {
    if (std::isnan(angle)) continue;
    if (!std::isnan(last)) angle = last + std::remainder(angle - last, 360.0);
    last = angle;
  }
  return degrees;
}

std::vector<PagePoint> OverTime(const std::vector<double>& times,
                                const std::vector<double>& values) {
  std::vector<PagePoint> points;
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (std::isfinite(values[row])) points.push_back({times[row], values[row]});
  }
  return points;
}

std::vector<std::string> TargetsIn(const CsvColumns& table) {
  const std::string prefix(kTargetPrefix);
  std::vector<std::string> targets;
  for (const std::string& name : table.names) {
    if (name.rfind(prefix, 0) == 0) targets.push_back(name.substr(prefix.size()));
  }
  return targets;
}

/// The agent's name in FILE.AGENT.csv, as skein compare names files; else FILE.
std::string AgentOf(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const std::size_t dot = stem.find('.');
  return dot == std::string::npos || dot + 1 == stem.size() ? stem : stem.substr(dot + 1);
}

/// The agents' names; of those that have the same the files.
std::vector<std::string> AgentsOf(const std::vector<std::string>& files) {
  std::vector<std::string> agents;
  for (const std::string& file : files) agents.push_back(AgentOf(file));
  const std::vector<bool> are_twice = AreTwice(agents);
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (are_twice[k]) agents[k] = files[k];
  }
  return agents;
}

const char* NameOf(Termination end) { return kTerminationNames[static_cast<std::size_t>(end)]; }

/// None of a mission that was flown to its end.
std::string EndWords(const std::string& termination, bool is_mission) {
  return IsMissionFlown(is_mission, termination) ? "" : WithBlanks(termination);
}

/// Whether a target gives way to another one, as in missions alone.
bool HasNewTarget(const CsvColumns& flight) {
  for (const std::string& target : TargetsIn(flight)) {
    const std::vector<double>& column = *flight.Find(kTargetPrefix + target);
    const auto is_new = [](double a, double b) { return a < b || a > b; };
    if (std::adjacent_find(column.begin(), column.end(), is_new) != column.end()) return true;
  }
  return false;
}

/// The rows [begin, end) of a file as one flight.
DrawnFlight FlightOf(const std::string& file, const CsvColumns& all, std::size_t begin,
                     std::size_t end) {
  DrawnFlight flight;
  flight.source = file;
  flight.episode = fmt::format("{:g}", all.Find("episode")->at(begin));
  flight.table.names = all.names;
  for (const std::vector<double>& column : all.values) {
    flight.table.values.emplace_back(column.begin() + static_cast<std::ptrdiff_t>(begin),
                                     column.begin() + static_cast<std::ptrdiff_t>(end));
  }
  flight.end = EndWords(all.words[end - 1], HasNewTarget(flight.table));
  return flight;
}

CsvColumns ReadTable(const std::string& file, std::vector<std::string>* notes) {
  CsvColumns table = ParseCsv(ReadFile(file), "termination");
  for (const char* column : {"episode", "time_s", "termination"}) {
    if (table.Find(column) != nullptr) continue;
    throw Error(fmt::format(
        "{}: no column {}; is it a file of flights (skein replay --format csv)?", file, column));
  }
  if (table.rows() == 0) throw Error(file + ": holds no flights");
  for (const char* column : {"episode", "time_s"}) {
    for (const double value : *table.Find(column)) {
      if (std::isfinite(value)) continue;
      throw Error(fmt::format("{}: a cell of column {} holds no number", file, column));
    }
  }
  if (table.rows_left_out > 0) {
    notes->push_back(
        fmt::format("{}: {} cut short and left out", file, Counted(table.rows_left_out, "row")));
  }
  return table;
}

/// Throws Error unless the rows of an episode are together and their time goes on.
void RequireInOrder(const std::string& file, const CsvColumns& table) {
  const std::vector<double>& episodes = *table.Find("episode");
  const std::vector<double>& times = *table.Find("time_s");
  std::set<double> ended;
  for (std::size_t row = 1; row < episodes.size(); ++row) {
    const bool goes_on = episodes[row] == episodes[row - 1];
    if (!goes_on) ended.insert(episodes[row - 1]);
    if (goes_on ? times[row] > times[row - 1] : ended.count(episodes[row]) == 0) continue;
    throw Error(
        fmt::format("{}: rows of episode {:g} are not together, or their time does not go on; a "
                    "file holds the flights of one agent, one after the other",
                    file, episodes[row]));
  }
}

std::vector<DrawnFlight> ReadFlights(const std::string& file, std::vector<std::string>* notes) {
  const CsvColumns table = ReadTable(file, notes);
  RequireInOrder(file, table);
  const std::vector<double>& episodes = *table.Find("episode");
  std::vector<DrawnFlight> flights;
  for (std::size_t begin = 0, row = 1; row <= episodes.size(); ++row) {
    if (row < episodes.size() && episodes[row] == episodes[begin]) continue;
    flights.push_back(FlightOf(file, table, begin, row));
    begin = row;
  }
  return flights;
}

std::vector<DrawnFlight> FlightsOf(const AgentFlights& flown) {
  std::vector<DrawnFlight> flights;
  const bool is_mission = EvaluationConfig(flown.env).mission.enabled();
  for (std::size_t k = 0; k < flown.flights.size(); ++k) {
    FlightTable table = TableOf(flown.env, flown.flights[k]);
    DrawnFlight flight;
    flight.source = flown.agent;
    flight.episode = std::to_string(k);
    const Termination end = table.terminations.back();
    if (end != Termination::kNone) flight.end = EndWords(NameOf(end), is_mission);
    flight.table.names = std::move(table.names);
    flight.table.values = std::move(table.columns);
    flights.push_back(std::move(flight));
  }
  return flights;
}

/// Equal for flights of the same episode by different agents.
std::string IdentityOf(const DrawnFlight& flight) {
  std::vector<double> start;
  for (const char* column : {"north_ft", "east_ft", "altitude_ft"}) {
    if (flight.Has(column)) start.push_back(flight.Column(column).front());
  }
  for (const std::string& target : TargetsIn(flight.table)) {
    start.push_back(flight.Column(kTargetPrefix + target).front());
  }
  return fmt::format("{}: {:.6g}", flight.episode, fmt::join(start, " "));
}

void ChooseEpisodes(const std::vector<int>& episodes, Recording* agent) {
  std::vector<DrawnFlight> chosen;
  std::vector<std::string> known;
  for (const DrawnFlight& flight : agent->flights) known.push_back(flight.episode);
  for (const int episode : episodes) {
    const auto found = std::find(known.begin(), known.end(), std::to_string(episode));
    if (found == known.end()) {
      throw Error(fmt::format("{}: no episode {}; known: {}", agent->flights.front().source,
                              episode, fmt::join(known, ", ")));
    }
    chosen.push_back(agent->flights[static_cast<std::size_t>(found - known.begin())]);
  }
  agent->flights = std::move(chosen);
}

}  // namespace

const std::vector<double>& DrawnFlight::Column(const std::string& name) const {
  const std::vector<double>* const column = table.Find(name);
  if (column != nullptr) return *column;
  throw Error(
      fmt::format("{}: no column {}; there are {}", source, name, fmt::join(table.names, ", ")));
}

std::vector<PagePoint> DrawnFlight::Flown(const std::string& column) const {
  const std::vector<double>& values = Column(column);
  return OverTime(Column("time_s"), IsAngle(column) ? Unwrapped(values) : values);
}

std::vector<PagePoint> DrawnFlight::Target(const std::string& column) const {
  if (!Has(kTargetPrefix + column)) return {};
  if (!IsAngle(column)) return OverTime(Column("time_s"), Column(kTargetPrefix + column));
  const std::vector<double> flown = Unwrapped(Column(column));
  std::vector<double> targets = Column("error_" + column);
  for (std::size_t row = 0; row < targets.size(); ++row) targets[row] += flown[row];
  return OverTime(Column("time_s"), Unwrapped(std::move(targets)));
}

Recordings ReadRecordings(const std::vector<std::string>& files) {
  Recordings recordings;
  const std::vector<std::string> agents = AgentsOf(files);
  for (std::size_t k = 0; k < files.size(); ++k) {
    const std::string& file = files[k];
    recordings.agents.push_back({agents[k], StyleOf(k), ReadFlights(file, &recordings.notes)});
    const std::vector<std::string> own = TargetsIn(recordings.agents.back().flights[0].table);
    if (file == files.front()) recordings.targets = own;
    if (own != recordings.targets) {
      throw Error(fmt::format("{}: flights of another task than in {}; draw them apart", file,
                              files.front()));
    }
  }
  return recordings;
}

Recordings RecordingsOf(const std::vector<AgentFlights>& agents) {
  Recordings recordings;
  recordings.span_ft = LoadAircraft(agents.front().env.aircraft).airframe.span_ft;
  for (const AgentFlights& flown : agents) {
    recordings.agents.push_back({flown.agent, StyleOf(recordings.agents.size()), FlightsOf(flown)});
  }
  for (const TargetQuantity& target : agents.front().targets) {
    recordings.targets.emplace_back(target.column);
    if (target.tolerance > 0) recordings.tolerances[target.column] = target.tolerance;
  }
  return recordings;
}

double LargestTolerance(const std::string& column) {
  constexpr double kHalfTurn_deg = 180;
  constexpr double kLargest = 1e7;  // of --target, too: float32 still holds single feet there
  return IsAngle(column) ? kHalfTurn_deg : kLargest;
}

void Choose(const RecordingChoice& choice, Recordings* recordings) {
  const std::vector<std::string>& names = choice.names;
  if (!names.empty() && names.size() != recordings->agents.size()) {
    throw Error(fmt::format("--names: {} for {}", Counted(static_cast<int>(names.size()), "name"),
                            Counted(static_cast<int>(recordings->agents.size()), "agent")));
  }
  for (std::size_t k = 0; k < recordings->agents.size(); ++k) {
    Recording& agent = recordings->agents[k];
    if (!names.empty()) {
      recordings->notes.push_back(fmt::format("{}: {}", names[k], agent.flights.front().source));
      agent.name = names[k];
    }
    if (!choice.episodes.empty()) ChooseEpisodes(choice.episodes, &agent);
  }
  for (const auto& [column, tolerance] : choice.tolerances) {
    const std::vector<std::string>& known = recordings->targets;
    if (std::find(known.begin(), known.end(), column) == known.end()) {
      throw Error(fmt::format("--tolerance: {} has no target; these have: {}", column,
                              known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
    }
    recordings->tolerances[column] = tolerance;
  }
}

std::vector<DrawnEpisode> EpisodesOf(const Recordings& recordings) {
  std::vector<DrawnEpisode> episodes;
  std::vector<std::string> identities;
  for (const Recording& agent : recordings.agents) {
    for (const DrawnFlight& flight : agent.flights) {
      const std::string identity = IdentityOf(flight);
      const auto found = std::find(identities.begin(), identities.end(), identity);
      const auto index = static_cast<std::size_t>(found - identities.begin());
      if (found == identities.end()) {
        identities.push_back(identity);
        episodes.emplace_back();
      }
      episodes[index].flights.push_back({&agent, &flight});
    }
  }
  return episodes;
}

void KeepFirstEpisodes(int count, Recordings* recordings) {
  std::set<const DrawnFlight*> kept;
  const std::vector<DrawnEpisode> episodes = EpisodesOf(*recordings);
  for (std::size_t k = 0; k < std::min<std::size_t>(count, episodes.size()); ++k) {
    for (const DrawnEpisode::Entry& entry : episodes[k].flights) kept.insert(entry.flight);
  }
  for (Recording& agent : recordings->agents) {
    std::vector<DrawnFlight> flights;
    for (DrawnFlight& flight : agent.flights) {
      if (kept.count(&flight) > 0) flights.push_back(std::move(flight));
    }
    agent.flights = std::move(flights);
  }
  std::vector<Recording>& agents = recordings->agents;
  agents.erase(std::remove_if(agents.begin(), agents.end(),
                              [](const Recording& agent) { return agent.flights.empty(); }),
               agents.end());
}

std::string EndOf(const DrawnFlight& flight) {
  return fmt::format("{}{:.1f}\u00a0s flown", flight.end.empty() ? "" : flight.end + "; ",
                     flight.duration_s());
}

}  // namespace skein
