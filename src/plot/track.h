// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "src/plot/projection.h"
#include "src/plot/recordings.h"

namespace skein {

/// What a flight was to reach until there was another target, or the flight ended.
struct TrackTarget {
  /// A target in space, or else the target's altitude, if any, where the aircraft was at last.
  SpacePoint place;
  bool is_in_space = false;
  std::optional<BodyAxes> axes;  ///< of its heading and pitch; nothing if there is no heading
};

/// A flight in space.
struct Track {
  const DrawnFlight* flight = nullptr;
  CurveStyle style;
  bool is_first = false;  ///< of the first agent, which is drawn with aircraft
  std::vector<SpacePoint> points;
  std::vector<BodyAxes> attitudes;
  std::vector<double> times;         ///< s
  std::vector<TrackTarget> targets;  ///< one, but for missions

  /// Row numbers `interval_s` apart, and the last one.
  std::vector<std::size_t> Instants(double interval_s) const;
  /// The last target of a quantity, if the task has one.
  std::optional<double> Asked(const char* quantity) const;
};

/// Throws Error if the flight has no positions or attitudes, or is too far away to be drawn.
Track TrackOf(const DrawnEpisode::Entry& entry, bool is_first);

/// Of all agents' episodes, episode by episode.
std::vector<Track> TracksOf(const Recordings& recordings);

/// How many seconds lie between two aircraft of a length on the paper that do not touch: a round
/// number.
double RoundInterval(const View& view, const std::vector<Track>& tracks, double glyph_length);

/// "12.3 s", and how it ended if neither at the target nor as asked for.
std::string TimeLabel(const DrawnFlight& flight);

}  // namespace skein
