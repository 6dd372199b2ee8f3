// SPDX-License-Identifier: Apache-2.0
#include "src/plot/space_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "src/plot/aircraft_glyph.h"
#include "src/plot/axes.h"
#include "src/plot/ground.h"
#include "src/plot/label_places.h"
#include "src/plot/target_marks.h"

namespace skein {
namespace {

constexpr double kLeft = 34, kRight = 50, kTop = 22;  // around the scene, points
constexpr double kGlyphPerWidth = 1 / 32.0, kMostGlyph = 20, kLeastGlyph = 10;
constexpr double kMostHeight = 0.75;  // of the scene, of the width
constexpr double kOthersSize = 0.75;  // of the other agents' aircraft
constexpr double kRibbonSpan = 0.5;   // of the ribbon, in wing spans
constexpr double kRibbonInterval_s = 0.1;
constexpr double kFrontOfRibbon = 1.2;  // lengths by which aircraft are nearer than the ribbon
constexpr double kShadowOpacity = 0.5;
constexpr Colour kShadow = 0x8C8C8C;
constexpr std::size_t kRowsPerObstacle = 20;
constexpr std::size_t kPathParts = 12;
constexpr double kDashesRepeat = 52.5;  // points, after which both kinds of dashes begin anew

/// Where "start" may be, from the dot: below, to the right, to the left, above.
const std::vector<Words> kBesideStart = {{{0, 14}, "", kTextSize, Anchor::kMiddle},
                                         {{7, 3}, "", kTextSize, Anchor::kStart},
                                         {{-7, 3}, "", kTextSize, Anchor::kEnd},
                                         {{0, -7}, "", kTextSize, Anchor::kMiddle}};

constexpr double kFlat = 0.1, kLegible = 0.2;  // altitudes over the horizontal extent
constexpr double kMostDefaultScale = 32;

SpacePoint ExtentOf(const std::vector<SpacePoint>& points) {
  SpacePoint low = points.front(), high = low;
  for (const SpacePoint& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return high - low;
}

/// What is drawn together: what is nearer to the viewer covers what is farther.
struct Piece {
  double nearness;
  std::vector<Shape> shapes;
};

class SpaceDrawing {
 public:
  SpaceDrawing(const Recordings& recordings, const SpaceOptions& options)
      : recordings_(recordings),
        options_(options),
        tracks_(TracksOf(recordings)),
        vertical_scale_(VerticalScale(tracks_, options)),
        view_(options.azimuth_deg, options.elevation_deg, vertical_scale_),
        ground_(PointsOf(tracks_)),
        glyph_(std::clamp(options.width * kGlyphPerWidth, kLeastGlyph, kMostGlyph)) {}

  Picture Draw() {
    top_ = DrawTitle(options_.title, options_.width, &shapes_) + kTop;
    std::vector<SpacePoint> corners = ground_.Outline(view_);
    for (const SpacePoint& point : PointsOf(tracks_)) corners.push_back(point);
    const double height = view_.FitWithin(corners, {kLeft, top_}, options_.width - kLeft - kRight,
                                          kMostHeight * options_.width);
    enlarged_ = glyph_ / kGlyphLength_ft / view_.scale();
    interval_s_ = options_.interval_s.value_or(RoundInterval(view_, tracks_, glyph_));
    for (Shape& shape : ground_.Draw(view_)) shapes_.push_back(std::move(shape));
    for (const Track& track : tracks_) DrawShadow(track);
    for (const Track& track : tracks_) DrawTargetsOf(track);
    DrawFlights();
    DrawStarts(top_ + height + 24);
    DrawTimes(top_ + height + 24);
    const double bottom = DrawLegend({kMargin, top_ + height + 48}, options_.width - kMargin,
                                     LegendEntries(), &shapes_);
    return FinishedPicture(options_.width, bottom,
                           options_.title.empty() ? "Flights in space" : options_.title,
                           std::move(shapes_));
  }

 private:
  static std::vector<SpacePoint> PointsOf(const std::vector<Track>& tracks) {
    std::vector<SpacePoint> points;
    for (const Track& track : tracks) {
      for (const TrackTarget& target : track.targets) points.push_back(target.place);
      for (std::size_t row = 0; row < track.points.size(); row += 10) {
        points.push_back(track.points[row]);
      }
      points.push_back(track.points.back());
    }
    return points;
  }

  static double VerticalScale(const std::vector<Track>& tracks, const SpaceOptions& options) {
    const SpacePoint extent = ExtentOf(PointsOf(tracks));
    return options.vertical_scale.value_or(
        DefaultVerticalScale(extent.z(), std::max(extent.x(), extent.y())));
  }

  void DrawShadow(const Track& track) {
    std::vector<PagePoint> points;
    for (const SpacePoint& point : track.points) {
      points.push_back(view_.Place(ground_.Below(point)));
    }
    Path shadow = Line(Simplified(points), track.is_first ? kShadow : track.style.colour, 0.8);
    shadow.opacity = kShadowOpacity;
    shapes_.emplace_back(std::move(shadow));
  }

  void DrawPost(const SpacePoint& point, Colour colour) {
    Path post = Line({view_.Place(point), view_.Place(ground_.Below(point))}, colour, 0.6);
    post.opacity = kShadowOpacity;
    shapes_.emplace_back(std::move(post));
  }

  double arrow_ft() const { return TargetArrow(options_.width) / view_.scale(); }

  void DrawTargetsOf(const Track& track) {
    for (const TrackTarget& target : track.targets) {
      if (target.is_in_space) DrawPost(target.place, TargetColour(track, recordings_));
    }
    if (!track.targets.back().is_in_space) DrawPost(track.points.back(), track.style.colour);
    DrawTargets(view_, track, recordings_, arrow_ft(), &shapes_);
  }

  /// The area that the wings sweep, darker from above and paler from below.
  void AddRibbon(const Track& track, std::vector<Piece>* pieces) const {
    const double half = kRibbonSpan * kGlyphHalfSpan_ft * enlarged_;
    const std::vector<std::size_t> rows = track.Instants(kRibbonInterval_s);
    const auto side = [&](std::size_t row, double sign) {
      return SpacePoint(track.points[row] + sign * half * view_.Shown(track.attitudes[row]).right);
    };
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
      const bool from_above = view_.Nearness(view_.Shown(track.attitudes[rows[k]]).up) > 0;
      const Colour fill = Mixed(track.style.colour, kWhite, from_above ? 0.5 : 0.78);
      const SpacePoint corners[] = {side(rows[k], -1), side(rows[k], 1), side(rows[k + 1], 1),
                                    side(rows[k + 1], -1)};
      std::vector<PagePoint> placed;
      for (const SpacePoint& corner : corners) placed.push_back(view_.Place(corner));
      Path area = Area(std::move(placed), fill);
      area.stroke = fill;  // closes the seams between the areas
      area.width = 0.4;
      pieces->push_back(
          {(view_.Nearness(corners[0]) + view_.Nearness(corners[2])) / 2, {std::move(area)}});
    }
  }

  void AddAircraft(const Track& track, std::size_t row, double enlarged,
                   std::vector<Piece>* pieces) const {
    const double front = kFrontOfRibbon * kGlyphLength_ft * enlarged;
    pieces->push_back({view_.Nearness(track.points[row]) + front,
                       AircraftGlyph(view_, track.points[row], track.attitudes[row],
                                     track.style.colour, enlarged)});
  }

  /// A plain line, cut so that what is nearer covers it.
  void AddPath(const Track& track, std::vector<Piece>* pieces) const {
    const std::size_t length = std::max<std::size_t>(1, track.points.size() / kPathParts);
    std::size_t begin = 0;
    double drawn = 0;  // of the part, points
    std::vector<PagePoint> placed = {view_.Place(track.points[0])};
    for (std::size_t row = 1; row < track.points.size(); ++row) {
      placed.push_back(view_.Place(track.points[row]));
      const PagePoint &a = placed[placed.size() - 2], &b = placed.back();
      drawn += std::hypot(b.x - a.x, b.y - a.y);
      const bool is_long =
          track.style.dash == Dash::kNone ? row - begin >= length : drawn >= kDashesRepeat;
      if (!is_long && row + 1 < track.points.size()) continue;
      pieces->push_back({view_.Nearness(track.points[(begin + row) / 2]),
                         {Line(Simplified(placed), track.style.colour, 1.3, track.style.dash)}});
      begin = row;
      drawn = 0;
      placed = {placed.back()};
    }
  }

  /// Where an aircraft is drawn: of the first agent every interval, of others at the end.
  std::vector<std::size_t> AircraftRowsOf(const Track& track) const {
    if (!track.is_first) return {track.points.size() - 1};
    std::vector<std::size_t> rows = track.Instants(interval_s_);
    if (rows.size() > 1) rows.erase(rows.begin());
    return rows;
  }

  void DrawFlights() {
    std::vector<Piece> pieces;
    for (const Track& track : tracks_) {
      if (track.is_first) {
        AddRibbon(track, &pieces);
      } else {
        AddPath(track, &pieces);
      }
      for (const std::size_t row : AircraftRowsOf(track)) {
        AddAircraft(track, row, track.is_first ? enlarged_ : kOthersSize * enlarged_, &pieces);
      }
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const Piece& a, const Piece& b) { return a.nearness < b.nearness; });
    for (Piece& piece : pieces) {
      std::move(piece.shapes.begin(), piece.shapes.end(), std::back_inserter(shapes_));
    }
  }

  /// Dots, and one word for all of them, as episodes begin near each other.
  void DrawStarts(double bottom) {
    const auto lower = [this](const Track& a, const Track& b) {
      return view_.Place(a.points[0]).y < view_.Place(b.points[0]).y;
    };
    const Track& lowest = *std::max_element(tracks_.begin(), tracks_.end(), lower);
    DrawPost(lowest.points[0], kInk);
    for (const Track& track : tracks_) {
      shapes_.emplace_back(Disc{view_.Place(track.points[0]), 2, kInk, std::nullopt});
    }
    const PagePoint at = view_.Place(lowest.points[0]);
    Words words{{at.x, at.y + 14}, "start", kTextSize, Anchor::kMiddle};
    words.has_halo = true;
    // At a corner of the ground a number may be there.
    LabelPlaces places = PlacesBesideWords(bottom);
    shapes_.emplace_back(places.Put(words, at, kBesideStart).value_or(words));
  }

  /// Of the paper down to `bottom` what no words are on.
  LabelPlaces PlacesBesideWords(double bottom) const {
    LabelPlaces places({kMargin, top_ - kTop, options_.width - kMargin, bottom});
    for (const Shape& shape : shapes_) {
      if (const auto* const words = std::get_if<Words>(&shape)) places.Forbid(BoxOf(*words));
    }
    return places;
  }

  /// How long each flight was, beside its end, where little is covered.
  void DrawTimes(double bottom) {
    LabelPlaces places = PlacesBesideWords(bottom);
    constexpr double kHeavy = 10;
    for (const Track& track : tracks_) {
      for (std::size_t row = 0; row < track.points.size(); row += kRowsPerObstacle) {
        places.Avoid(view_.Place(track.points[row]), track.is_first ? glyph_ / 4 : 2.5, 1);
      }
      for (const std::size_t row : AircraftRowsOf(track)) {
        places.Avoid(view_.Place(track.points[row]), glyph_ / 2, kHeavy);
      }
      for (const TrackTarget& target : track.targets) {
        for (const PagePoint& point : TargetArrowPoints(view_, target, arrow_ft())) {
          places.Avoid(point, 4, kHeavy);
        }
      }
    }
    for (const Track& track : tracks_) {
      Words words{{},
                  TimeLabel(*track.flight),
                  kTextSize,
                  Anchor::kStart,
                  Mixed(track.style.colour, 0, 0.15)};
      words.has_halo = true;
      const std::optional<Words> put = places.PutAround(words, view_.Place(track.points.back()));
      if (put) shapes_.emplace_back(*put);
    }
  }

  /// As it is drawn, in words.
  std::string SizeOfAircraft() const {
    const std::optional<double>& span_ft = recordings_.span_ft;
    if (!span_ft) return TickText(std::round(enlarged_)) + " times the size of an F-16";
    return TickText(std::round(enlarged_ * kGlyphWingSpan_ft / *span_ft)) + " times its true size";
  }

  std::vector<LegendEntry> LegendEntries() const {
    std::vector<LegendEntry> entries;
    for (const Recording& agent : recordings_.agents) {
      if (&agent != &recordings_.agents.front()) {
        entries.push_back({LineSample(agent.style.colour, 1.3, agent.style.dash), agent.name});
        continue;
      }
      entries.push_back(
          {[colour = agent.style.colour](PagePoint left, std::vector<Shape>* shapes) {
             View above(0, 90);
             above.PutOrigin({left.x + kSampleWidth / 2, left.y}, kSampleWidth / kGlyphLength_ft);
             for (Shape& shape :
                  AircraftGlyph(above, SpacePoint::Zero(), BodyAxesOf(0, 0, 90), colour, 1)) {
               shapes->push_back(std::move(shape));
             }
           },
           fmt::format("{}: an aircraft every {:g}\u00a0s, {}, underside drawn lighter", agent.name,
                       interval_s_, SizeOfAircraft())});
    }
    if (const auto target = TargetEntry(tracks_.front(), recordings_)) {
      entries.push_back(*target);
    }
    entries.push_back({[](PagePoint left, std::vector<Shape>* shapes) {
                         shapes->emplace_back(
                             Words{{left.x + kSampleWidth, left.y + 0.35 * kTextSize},
                                   "12 s",
                                   kTextSize,
                                   Anchor::kEnd});
                       },
                       "time flown, beside a flight's end where there is room"});
    entries.push_back({LineSample(kShadow, 0.8), fmt::format("shadow on the grid at {}\u00a0ft",
                                                             TickText(ground_.floor_ft()))});
    if (vertical_scale_ != 1) {
      entries.push_back(
          {[](PagePoint left, std::vector<Shape>* shapes) {
             const double x = left.x + kSampleWidth / 2;
             shapes->emplace_back(Line({{x, left.y - 5}, {x, left.y + 5}}, kGrey, 0.8));
           },
           fmt::format("altitude enlarged {:g} times", vertical_scale_)});
    }
    return entries;
  }

  const Recordings& recordings_;
  const SpaceOptions& options_;
  std::vector<Track> tracks_;
  double vertical_scale_;
  View view_;
  Ground ground_;
  double glyph_, enlarged_ = 1, interval_s_ = 1, top_ = 0;
  std::vector<Shape> shapes_;
};

}  // namespace

double DefaultVerticalScale(double altitude_extent_ft, double horizontal_extent_ft) {
  if (altitude_extent_ft >= kFlat * horizontal_extent_ft || altitude_extent_ft == 0) return 1;
  const auto miss = [&](double scale) {
    return std::abs(scale * altitude_extent_ft - kLegible * horizontal_extent_ft);
  };
  double best = 2;
  for (double scale = 4; scale <= kMostDefaultScale; scale *= 2) {
    if (miss(scale) < miss(best)) best = scale;
  }
  return best;
}

Picture SpacePicture(const Recordings& recordings, const SpaceOptions& options) {
  return SpaceDrawing(recordings, options).Draw();
}

}  // namespace skein
