// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/range.h"
#include "src/evaluation/flight_table.h"
#include "src/files/csv_columns.h"
#include "src/plot/picture.h"

namespace skein {

/// One flown episode.
struct DrawnFlight {
  std::string source;   ///< the file or the agent, for errors
  std::string episode;  ///< its number
  std::string end;      ///< "target reached"; empty if it was flown as long as was asked for
  CsvColumns table;     ///< a row for every control step, columns as in files of flights

  /// Throws Error if there is no such column.
  const std::vector<double>& Column(const std::string& name) const;
  bool Has(const std::string& name) const { return table.Find(name) != nullptr; }
  /// Of its first row and its last.
  Range times_s() const { return {Column("time_s").front(), Column("time_s").back()}; }
  double duration_s() const { return times_s().max - times_s().min; }

  /// What was flown, and what the target asks for (empty without a target), as values over time,
  /// without what is no number. Angles go on beyond 180 degrees, and targets lie beside them.
  std::vector<PagePoint> Flown(const std::string& column) const;
  std::vector<PagePoint> Target(const std::string& column) const;
};

/// An agent's flights, and how they are drawn.
struct Recording {
  std::string name;
  CurveStyle style;
  std::vector<DrawnFlight> flights;
};

/// Flights of one task by one or more agents.
struct Recordings {
  std::vector<Recording> agents;
  std::vector<std::string> targets;          ///< columns that have a target
  std::map<std::string, double> tolerances;  ///< of them, as far as they are known
  std::vector<std::string> notes;            ///< what is damaged, for people
  std::optional<double> span_ft;             ///< of the aircraft; files do not hold it
};

/// Files that skein eval, compare or replay wrote, one for each agent, which has the file's name,
/// or its path where two have the same name. Throws Error on what is none and on files of several
/// tasks.
Recordings ReadRecordings(const std::vector<std::string>& files);
/// Flights that have just been flown, with the tolerances of their task.
Recordings RecordingsOf(const std::vector<AgentFlights>& agents);

/// The largest tolerance of targets in `column` that can be drawn, in the column's unit: half a
/// turn of an angle, 1e7 of all else.
double LargestTolerance(const std::string& column);

/// What is drawn beside what lies in the recordings.
struct RecordingChoice {
  std::vector<std::string> names;            ///< of the agents; empty: their own
  std::vector<int> episodes;                 ///< in this order; empty: all
  std::map<std::string, double> tolerances;  ///< of targets, beside the known ones
};

/// Throws Error on what is not there.
void Choose(const RecordingChoice& choice, Recordings* recordings);

/// Leaves out all but the first `count` episodes.
void KeepFirstEpisodes(int count, Recordings* recordings);

/// One episode by everybody who flew it.
struct DrawnEpisode {
  struct Entry {
    const Recording* agent;
    const DrawnFlight* flight;
  };
  std::vector<Entry> flights;
};

/// Flights that begin alike and have the same number are of the same episode.
std::vector<DrawnEpisode> EpisodesOf(const Recordings& recordings);

/// "target reached; 12.3 s flown", or "180.0 s flown" of a flight without an end; the time included
/// for which a reached target was held.
std::string EndOf(const DrawnFlight& flight);

}  // namespace skein
