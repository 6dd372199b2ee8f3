// SPDX-License-Identifier: Apache-2.0
#include "src/plot/tracks_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/plot/aircraft_glyph.h"
#include "src/plot/axes.h"
#include "src/plot/ground.h"
#include "src/plot/label_places.h"
#include "src/plot/target_marks.h"

namespace skein {
namespace {

constexpr double kLeft = 44, kGap = 40, kAltitudeHeight = 84, kMostMapHeight = 0.85;
constexpr double kGlyph = 12;        // length of an aircraft, points
constexpr double kMapMargin = 0.08;  // of the larger span, around what was flown
constexpr double kPointsPerTick = 52;
constexpr double kThousand = 1000;
constexpr std::size_t kRowsPerObstacle = 20;

class TracksDrawing {
 public:
  TracksDrawing(const Recordings& recordings, const TracksOptions& options)
      : recordings_(recordings), options_(options), tracks_(TracksOf(recordings)) {}

  Picture Draw() {
    const double top = DrawTitle(options_.title, options_.width, &shapes_) + 12;
    const Panel map = MapPanel(top);
    DrawMap(map);
    const Panel altitudes = AltitudePanel(map.bottom() + kGap);
    DrawAltitudes(altitudes);
    const double bottom = DrawLegend({kLeft, altitudes.bottom() + 40}, options_.width - kMargin,
                                     LegendEntries(), &shapes_);
    return FinishedPicture(options_.width, bottom,
                           options_.title.empty() ? "Ground tracks" : options_.title,
                           std::move(shapes_));
  }

 private:
  double width() const { return options_.width - kLeft - kMargin; }

  double arrow_ft() const { return TargetArrow(options_.width) / view_.scale(); }

  /// The map in thousands of feet, as wide as the paper or as high as is allowed.
  Panel MapPanel(double top) const {
    // How long the arrows into target headings are is known with the scale alone.
    const Panel without = MapPanel(top, 0);
    const double scale =
        without.width() / (without.x_range().max - without.x_range().min) / kThousand;
    return MapPanel(top, TargetArrow(options_.width) / scale);
  }

  Panel MapPanel(double top, double arrow_ft) const {
    SpacePoint low = tracks_[0].points[0], high = low;
    for (const Track& track : tracks_) {
      for (const SpacePoint& point : track.points) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
      }
      for (const TrackTarget& target : track.targets) {
        for (const double arrow : {0.0, arrow_ft}) {
          low = low.cwiseMin(TargetTip(view_, target, arrow));
          high = high.cwiseMax(TargetTip(view_, target, arrow));
        }
      }
    }
    const double margin = kMapMargin * std::max({(high - low).x(), (high - low).y(), 100.0});
    const double north = (high - low).x() + 2 * margin, east = (high - low).y() + 2 * margin;
    // What is narrow gets room at its sides.
    const double height =
        std::clamp(width() * north / east, 0.3 * width(), kMostMapHeight * width());
    const double scale = std::min(width() / east, height / north);
    const auto around = [scale](double a, double b, double room) {
      const double middle = (a + b) / 2, half = room / scale / 2;
      return Range{(middle - half) / kThousand, (middle + half) / kThousand};
    };
    return Panel({kLeft, top}, width(), height, around(low.y(), high.y(), width()),
                 around(low.x(), high.x(), height));
  }

  Panel AltitudePanel(double top) const {
    std::vector<double> altitudes, times;
    for (const Track& track : tracks_) {
      for (const SpacePoint& point : track.points) altitudes.push_back(point.z());
      for (const PagePoint& point : track.flight->Target("altitude_ft")) {
        altitudes.push_back(point.y);
      }
      times.insert(times.end(), {track.flight->times_s().min, track.times.back()});
    }
    Range range = Padded(altitudes);
    return Panel({kLeft, top}, width(), kAltitudeHeight, SpanOf(times),
                 {range.min / kThousand, range.max / kThousand});
  }

  static PagePoint Onto(const Panel& map, const SpacePoint& point) {
    return map.Place(point.y() / kThousand, point.x() / kThousand);
  }

  void DrawMap(const Panel& map) {
    const std::vector<double> across = Ticks(map.x_range(), map.width() / kPointsPerTick);
    const double step = across[1] - across[0];
    const std::vector<double> up =
        Ticks(map.y_range(), (map.y_range().max - map.y_range().min) / step);
    map.DrawGrid(across, up, &shapes_);
    map.LabelLeft(up, &shapes_);
    map.LabelBottom(across, &shapes_);
    map.NameBottom("east, 1000 ft", &shapes_);
    shapes_.emplace_back(Words{{map.left(), map.top() - 4}, "north, 1000 ft", kTextSize});
    view_.PutOrigin(Onto(map, SpacePoint::Zero()),
                    map.width() / (map.x_range().max - map.x_range().min) / kThousand);
    for (const Track& track : tracks_) {
      DrawTargets(view_, track, recordings_, arrow_ft(), &shapes_);
    }
    interval_s_ = options_.interval_s.value_or(RoundInterval(view_, tracks_, 2 * kGlyph));
    for (auto track = tracks_.rbegin(); track != tracks_.rend(); ++track) DrawTrack(*track);
    for (const Track& track : tracks_) {
      shapes_.emplace_back(Disc{view_.Place(track.points[0]), 2, kInk, std::nullopt});
    }
    DrawLabels(map);
  }

  void DrawTrack(const Track& track) {
    std::vector<PagePoint> points;
    for (const SpacePoint& point : track.points) points.push_back(view_.Place(point));
    shapes_.emplace_back(Line(Simplified(points), track.style.colour, 1.2, track.style.dash));
    const double enlarged = kGlyph / kGlyphLength_ft / view_.scale();
    const std::vector<std::size_t> rows = track.Instants(interval_s_);
    for (std::size_t k = rows.size() > 1 ? 1 : 0; k < rows.size(); ++k) {
      for (Shape& shape : AircraftGlyph(view_, track.points[rows[k]], track.attitudes[rows[k]],
                                        track.style.colour, enlarged)) {
        shapes_.push_back(std::move(shape));
      }
    }
  }

  /// Episodes at their ends, the start, and the arrow to the north where nothing was flown.
  void DrawLabels(const Panel& map) {
    LabelPlaces places({map.left(), map.top(), map.right(), map.bottom()});
    std::vector<PagePoint> flown;
    for (const Track& track : tracks_) {
      for (std::size_t row = 0; row < track.points.size(); row += kRowsPerObstacle) {
        flown.push_back(view_.Place(track.points[row]));
        places.Avoid(flown.back(), kGlyph / 3, 1);
      }
      places.Avoid(view_.Place(track.points.back()), kGlyph / 2, 5);
      for (const TrackTarget& target : track.targets) {
        for (const PagePoint& point : TargetArrowPoints(view_, target, arrow_ft())) {
          flown.push_back(point);
          places.Avoid(point, 5, 5);
        }
      }
    }
    DrawNorthArrow(map, flown, &places);
    for (const Track& track : tracks_) {
      Words words{{},
                  track.flight->episode + ": " + TimeLabel(*track.flight),
                  kSmallSize,
                  Anchor::kStart,
                  Mixed(track.style.colour, 0, 0.15)};
      words.has_halo = true;
      Put(places.PutAround(words, view_.Place(track.points.back())));
    }
    Words start{{}, "start", kSmallSize};
    start.has_halo = true;
    Put(places.PutAround(start, view_.Place(tracks_[0].points[0])));
  }

  void Put(const std::optional<Words>& words) {
    if (words) shapes_.emplace_back(*words);
  }

  /// In the corner that is farthest from all flights.
  void DrawNorthArrow(const Panel& map, const std::vector<PagePoint>& flown, LabelPlaces* places) {
    constexpr double kLength = 26, kInset = 20;
    PagePoint best;
    double farthest = -1;
    for (const double x : {map.right() - kInset, map.left() + kInset}) {
      for (const double y : {map.top() + kInset + 8, map.bottom() - kInset}) {
        double nearest = 1e9;
        for (const PagePoint& point : flown) {
          nearest = std::min(nearest, std::hypot(point.x - x, point.y - y));
        }
        if (nearest <= farthest) continue;
        farthest = nearest;
        best = {x, y};
      }
    }
    View paper(0, 90);
    paper.PutOrigin(best, 1);
    for (Shape& shape : NorthArrow(paper, SpacePoint::Zero(), kLength)) {
      shapes_.push_back(std::move(shape));
    }
    // With its letter, which stands beyond the tip.
    places->Forbid({best.x - kLength / 3, best.y - kLength - kTextSize, best.x + kLength / 3,
                    best.y + kLength / 2 + 2});
  }

  void DrawAltitudes(const Panel& panel) {
    const std::vector<double> across = Ticks(panel.x_range(), panel.width() / kPointsPerTick);
    const std::vector<double> up = Ticks(panel.y_range(), kAltitudeHeight / 18);
    panel.DrawGrid(across, up, &shapes_);
    panel.LabelLeft(up, &shapes_);
    panel.LabelBottom(across, &shapes_);
    shapes_.emplace_back(Words{{panel.left(), panel.top() - 4}, "altitude, 1000 ft", kTextSize});
    panel.NameBottom("time, s", &shapes_);
    for (auto track = tracks_.rbegin(); track != tracks_.rend(); ++track) {
      panel.DrawCurve(InThousands(track->flight->Target("altitude_ft")), kInk, 0.8, Dash::kShort,
                      &shapes_);
      const std::vector<PagePoint> flown = InThousands(track->flight->Flown("altitude_ft"));
      panel.DrawCurve(flown, track->style.colour, 1.2, track->style.dash, &shapes_);
      shapes_.emplace_back(Disc{panel.Place(flown.back().x, flown.back().y), 1.8,
                                track->style.colour, std::nullopt});
    }
  }

  static std::vector<PagePoint> InThousands(std::vector<PagePoint> points) {
    for (PagePoint& point : points) point.y /= kThousand;
    return points;
  }

  std::vector<LegendEntry> LegendEntries() const {
    std::vector<LegendEntry> entries;
    for (const Recording& agent : recordings_.agents) {
      entries.push_back({LineSample(agent.style.colour, 1.2, agent.style.dash), agent.name});
    }
    entries.front().words += fmt::format(" (an aircraft every {:g}\u00a0s)", interval_s_);
    if (const auto target = TargetEntry(tracks_.front(), recordings_)) {
      entries.push_back(*target);
    }
    if (tracks_.front().Asked("altitude_ft")) {
      entries.push_back({LineSample(kInk, 0.8, Dash::kShort), "target altitude"});
    }
    entries.push_back({[](PagePoint left, std::vector<Shape>* shapes) {
                         shapes->emplace_back(
                             Words{{left.x + kSampleWidth / 2, left.y + 0.35 * kTextSize},
                                   "0: 9 s",
                                   kSmallSize,
                                   Anchor::kMiddle});
                       },
                       "episode and time flown, where there is room"});
    return entries;
  }

  const Recordings& recordings_;
  const TracksOptions& options_;
  std::vector<Track> tracks_;
  View view_ = View(0, 90);
  double interval_s_ = 1;
  std::vector<Shape> shapes_;
};

}  // namespace

Picture TracksPicture(const Recordings& recordings, const TracksOptions& options) {
  return TracksDrawing(recordings, options).Draw();
}

}  // namespace skein
