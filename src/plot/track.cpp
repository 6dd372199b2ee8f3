// SPDX-License-Identifier: Apache-2.0
#include "src/plot/track.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "src/files/csv_columns.h"

namespace skein {
namespace {

constexpr double kSameTime_s = 1e-6;
constexpr double kLeastLastGap = 0.4;  // of the interval, between the last two aircraft
constexpr double kSpacing = 1.2;       // of aircraft on the paper, in their lengths
constexpr double kFarthest_ft = 1e9;   // beyond, numbers along a map's sides would be the same

void RequireNear(const SpacePoint& point, const DrawnFlight& flight) {
  const double distance_ft = point.cwiseAbs().maxCoeff();
  if (distance_ft <= kFarthest_ft) return;
  throw Error(fmt::format("{}: episode {} or its target is {:g} ft away; up to {:g} can be drawn",
                          flight.source, flight.episode, distance_ft, kFarthest_ft));
}

/// What is asked for in a row of a flight: north, east, altitude, heading and pitch, each where the
/// task has it.
using AskedNumbers = std::array<std::optional<double>, 5>;

AskedNumbers AskedIn(const CsvColumns& table, std::size_t row) {
  constexpr std::array<const char*, 5> kColumns = {"target_north_ft", "target_east_ft",
                                                   "target_altitude_ft", "target_yaw_deg",
                                                   "target_pitch_deg"};
  AskedNumbers asked;
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    const std::vector<double>* const column = table.Find(kColumns[k]);
    if (column != nullptr && std::isfinite((*column)[row])) asked[k] = (*column)[row];
  }
  return asked;
}

/// The target that was asked for until the aircraft was at `last`.
TrackTarget TargetOf(const AskedNumbers& asked, const SpacePoint& last) {
  const auto& [north, east, altitude, yaw, pitch] = asked;
  TrackTarget target;
  target.is_in_space = north && east;
  target.place = {north.value_or(last.x()), east.value_or(last.y()), altitude.value_or(last.z())};
  if (yaw) target.axes = BodyAxesOf(0, pitch.value_or(0), *yaw);
  return target;
}

/// `rows` are those of the points.
std::vector<TrackTarget> TargetsOf(const CsvColumns& table, const std::vector<SpacePoint>& points,
                                   const std::vector<std::size_t>& rows) {
  std::vector<TrackTarget> targets;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const AskedNumbers asked = AskedIn(table, rows[k]);
    if (k + 1 < points.size() && AskedIn(table, rows[k + 1]) == asked) continue;
    targets.push_back(TargetOf(asked, points[k]));
  }
  return targets;
}

}  // namespace

std::vector<std::size_t> Track::Instants(double interval_s) const {
  std::vector<std::size_t> instants;
  double due = times.front();
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (times[row] < due - kSameTime_s) continue;
    instants.push_back(row);
    due += interval_s;
  }
  const std::size_t last = times.size() - 1;
  if (instants.back() == last) return instants;
  const double gap = times[last] - times[instants.back()];
  if (instants.size() > 1 && gap < kLeastLastGap * interval_s) instants.pop_back();
  instants.push_back(last);
  return instants;
}

std::optional<double> Track::Asked(const char* quantity) const {
  const std::vector<double>* const column = flight->table.Find(std::string("target_") + quantity);
  if (column == nullptr || !std::isfinite(column->back())) return std::nullopt;
  return column->back();
}

Track TrackOf(const DrawnEpisode::Entry& entry, bool is_first) {
  const DrawnFlight& flight = *entry.flight;
  std::vector<const std::vector<double>*> columns;
  for (const char* name :
       {"north_ft", "east_ft", "altitude_ft", "roll_deg", "pitch_deg", "yaw_deg", "time_s"}) {
    columns.push_back(&flight.Column(name));
  }
  Track track;
  track.flight = &flight;
  track.style = entry.agent->style;
  track.is_first = is_first;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < columns[0]->size(); ++row) {
    const auto at = [&](std::size_t column) { return (*columns[column])[row]; };
    const SpacePoint point(at(0), at(1), at(2)), attitude(at(3), at(4), at(5));
    if (!point.allFinite() || !attitude.allFinite()) continue;
    rows.push_back(row);
    track.points.push_back(point);
    track.attitudes.push_back(BodyAxesOf(attitude.x(), attitude.y(), attitude.z()));
    track.times.push_back(at(6));
  }
  if (track.points.empty()) {
    throw Error(fmt::format("{}: episode {} has no position", flight.source, flight.episode));
  }
  for (const SpacePoint& point : track.points) RequireNear(point, flight);
  track.targets = TargetsOf(flight.table, track.points, rows);
  for (const TrackTarget& target : track.targets) RequireNear(target.place, flight);
  return track;
}

std::vector<Track> TracksOf(const Recordings& recordings) {
  std::vector<Track> tracks;
  for (const DrawnEpisode& episode : EpisodesOf(recordings)) {
    for (const DrawnEpisode::Entry& entry : episode.flights) {
      tracks.push_back(TrackOf(entry, entry.agent == &recordings.agents.front()));
    }
  }
  return tracks;
}

double RoundInterval(const View& view, const std::vector<Track>& tracks, double glyph_length) {
  double length = 0, time_s = 0;
  for (const Track& track : tracks) {
    if (!track.is_first) continue;
    for (std::size_t row = 1; row < track.points.size(); ++row) {
      const PagePoint a = view.Place(track.points[row - 1]), b = view.Place(track.points[row]);
      length += std::hypot(b.x - a.x, b.y - a.y);
    }
    time_s += track.times.back() - track.times.front();
  }
  constexpr double kIntervals_s[] = {0.5, 1, 2, 3, 4, 5, 6, 8, 10, 15, 20, 30, 60, 120, 300};
  for (const double interval_s : kIntervals_s) {
    if (interval_s * length >= kSpacing * glyph_length * time_s) return interval_s;
  }
  return 600;
}

std::string TimeLabel(const DrawnFlight& flight) {
  const bool is_plain = flight.end.empty() || flight.end == "target reached";
  return fmt::format("{:.1f} s{}", flight.duration_s(),
                     is_plain ? "" : fmt::format(" ({})", flight.end));
}

}  // namespace skein
