// SPDX-License-Identifier: Apache-2.0
#include "src/plot/target_marks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein {
namespace {

constexpr double kArrowLength = 32, kHeadLength = 5.5, kRingRadius = 5;  // points
constexpr double kPageWidth = 518, kShortestArrow = 14;                  // points
constexpr double kEdge = 0.8;

double ToleranceOf(const Recordings& recordings, const char* column) {
  const auto found = recordings.tolerances.find(column);
  return found == recordings.tolerances.end() ? 0 : found->second;
}

/// The edges of a box, as seen through.
void DrawBox(const View& view, const SpacePoint& middle, const SpacePoint& half, Colour colour,
             std::vector<Shape>* shapes) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        SpacePoint corner;
        corner[(axis + 1) % 3] = a * half[(axis + 1) % 3];
        corner[(axis + 2) % 3] = b * half[(axis + 2) % 3];
        corner[axis] = -half[axis];
        const PagePoint begin = view.Place(middle + corner);
        corner[axis] = half[axis];
        const PagePoint end = view.Place(middle + corner);
        if (std::hypot(end.x - begin.x, end.y - begin.y) < 0.05) continue;
        shapes->emplace_back(Line({begin, end}, colour, kEdge));
      }
    }
  }
}

void DrawHeading(const View& view, const SpacePoint& target, const BodyAxes& axes,
                 const Recordings& recordings, double arrow_ft, Colour colour,
                 std::vector<Shape>* shapes) {
  constexpr double kSteps = 4, kRadians = 0.017453292519943295;
  const double yaw = ToleranceOf(recordings, "yaw_deg");
  if (yaw > 0) {
    std::vector<PagePoint> sector = {view.Place(target)};
    for (double k = -kSteps; k <= kSteps; ++k) {
      const double angle = kRadians * yaw * k / kSteps;
      const SpacePoint turned = std::cos(angle) * axes.forward + std::sin(angle) * axes.right;
      sector.push_back(view.Place(target + arrow_ft * turned));
    }
    shapes->emplace_back(Area(std::move(sector), colour, 0.3));
  }
  const SpacePoint up = ToleranceOf(recordings, "altitude_ft") * kUpward;
  shapes->emplace_back(Line({view.Place(target - up), view.Place(target + up)}, colour, 2));
  DrawArrow(view.Place(target), view.Place(target + arrow_ft * axes.forward), colour, shapes);
}

void DrawTarget(const View& view, const TrackTarget& target, const Recordings& recordings,
                double arrow_ft, Colour colour, std::vector<Shape>* shapes) {
  if (target.is_in_space) {
    shapes->emplace_back(Disc{view.Place(target.place), kRingRadius, std::nullopt, colour, kEdge});
    DrawBox(view, target.place,
            {ToleranceOf(recordings, "north_ft"), ToleranceOf(recordings, "east_ft"),
             ToleranceOf(recordings, "altitude_ft")},
            colour, shapes);
  } else if (target.axes) {
    DrawHeading(view, target.place, view.Shown(*target.axes), recordings, arrow_ft, colour, shapes);
  }
}

}  // namespace

void DrawArrow(PagePoint begin, PagePoint end, Colour colour, std::vector<Shape>* shapes) {
  const double length = std::hypot(end.x - begin.x, end.y - begin.y);
  if (length == 0) return;
  const double x = kHeadLength * (end.x - begin.x) / length;
  const double y = kHeadLength * (end.y - begin.y) / length;
  shapes->emplace_back(Line({begin, {end.x - 0.7 * x, end.y - 0.7 * y}}, colour, 1));
  shapes->emplace_back(Area(
      {end, {end.x - x - 0.4 * y, end.y - y + 0.4 * x}, {end.x - x + 0.4 * y, end.y - y - 0.4 * x}},
      colour));
}

double TargetArrow(double picture_width) {
  return std::clamp(kArrowLength * picture_width / kPageWidth, kShortestArrow, kArrowLength);
}

Colour TargetColour(const Track& track, const Recordings& recordings) {
  const bool is_own = track.targets.size() > 1 && recordings.agents.size() > 1;
  return is_own ? track.style.colour : kInk;
}

SpacePoint TargetTip(const View& view, const TrackTarget& target, double arrow_ft) {
  if (target.is_in_space || !target.axes) return target.place;
  return target.place + arrow_ft * view.Shown(*target.axes).forward;
}

std::vector<PagePoint> TargetArrowPoints(const View& view, const TrackTarget& target,
                                         double arrow_ft) {
  const PagePoint begin = view.Place(target.place);
  const PagePoint tip = view.Place(TargetTip(view, target, arrow_ft));
  std::vector<PagePoint> points;
  for (const double share : {0.3, 0.6, 1.0}) {
    points.push_back({begin.x + share * (tip.x - begin.x), begin.y + share * (tip.y - begin.y)});
  }
  return points;
}

void DrawTargets(const View& view, const Track& track, const Recordings& recordings,
                 double arrow_ft, std::vector<Shape>* shapes) {
  for (const TrackTarget& target : track.targets) {
    DrawTarget(view, target, recordings, arrow_ft, TargetColour(track, recordings), shapes);
  }
}

std::optional<LegendEntry> TargetEntry(const Track& track, const Recordings& recordings) {
  const double altitude = ToleranceOf(recordings, "altitude_ft");
  const TrackTarget& target = track.targets.front();
  const char* const in_colours =
      TargetColour(track, recordings) == kInk ? "" : "; in the agents' colours";
  if (target.is_in_space) {
    const std::string box = altitude > 0 ? fmt::format(", box ±{:g}\u00a0ft", altitude) : "";
    return LegendEntry{MarkerSample(Marker::kDisc, {{}, kRingRadius, std::nullopt, kInk, kEdge}),
                       "target" + box + in_colours};
  }
  if (!target.axes) return std::nullopt;
  std::string words = track.Asked("pitch_deg") ? "target heading and pitch" : "target heading";
  std::vector<std::string> known;
  if (const double yaw = ToleranceOf(recordings, "yaw_deg"); yaw > 0) {
    known.push_back(fmt::format("±{:g}°", yaw));
  }
  if (track.Asked("altitude_ft")) {
    words += " at target altitude";
    if (altitude > 0) known.push_back(fmt::format("±{:g}\u00a0ft", altitude));
  }
  if (!known.empty()) words += fmt::format(" ({})", fmt::join(known, ", "));
  words += in_colours;
  return LegendEntry{[](PagePoint left, std::vector<Shape>* shapes) {
                       DrawArrow(left, {left.x + kSampleWidth, left.y}, kInk, shapes);
                     },
                     words};
}

}  // namespace skein
