// SPDX-License-Identifier: Apache-2.0
#include "src/plot/ground.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/plot/axes.h"

namespace skein {
namespace {

constexpr Colour kSheet = 0xF4F2EC, kSheetGrid = 0xD5D0C2;
constexpr double kArrowPerStep = 0.6, kLeastArrow = 16, kMostArrow = 36;
constexpr double kHair = 0.6;
constexpr double kBelow = 0.15;  // the lowest flight, of the altitudes flown, lies the ground
constexpr double kMostLevels = 6;
constexpr double kThousand = 1000;

/// The round step that cuts a span into about `count` parts.
double RoundStep(double span, double count) {
  const std::vector<double> ticks = Ticks({0, span > 0 ? span : 1}, count);
  return ticks.size() > 1 ? ticks[1] : 1;
}

/// From the multiple of step below `low` to the one above `high`.
Range Widened(double low, double high, double step) {
  const double first = std::floor(low / step);
  return {first * step, std::max(std::ceil(high / step), first + 1) * step};
}

std::vector<double> Multiples(const Range& range, double step) {
  std::vector<double> multiples;
  const double count = std::round((range.max - range.min) / step);
  for (double k = 0; k <= count; ++k) multiples.push_back(range.min + k * step);
  return multiples;
}

/// The sign of the way from an end of a range into it.
double Inward(double end, const Range& range) { return end == range.min ? 1 : -1; }

/// Words that lie `distance` away from a point of space into a direction of it.
Words Outside(const View& view, const SpacePoint& point, const SpacePoint& direction,
              double distance, const std::string& text) {
  const PagePoint foot = view.Place(point), beyond = view.Place(point + direction);
  const double x = beyond.x - foot.x, y = beyond.y - foot.y;
  const double length = std::max(std::hypot(x, y), std::numeric_limits<double>::min());
  Words words{
      {foot.x + distance * x / length, foot.y + distance * y / length + 3}, text, kSmallSize};
  words.anchor = x > 0.4 * length    ? Anchor::kStart
                 : x < -0.4 * length ? Anchor::kEnd
                                     : Anchor::kMiddle;
  return words;
}

/// Every so many numbers are shown that those (dx, dy) apart, of a width, do not touch.
int EveryNth(double dx, double dy, double width) {
  constexpr double kGap = 5;
  for (const int every : {1, 2, 5, 10}) {
    if (every * std::abs(dx) >= width + kGap || every * std::abs(dy) >= kSmallSize + 1) {
      return every;
    }
  }
  return 20;
}

/// Evenly spaced numbers in thousands.
std::vector<std::string> ThousandsOf(std::vector<double> values) {
  for (double& value : values) value /= kThousand;
  return TickTexts(values);
}

double WidestOf(const std::vector<std::string>& lines) {
  double widest = 0;
  for (const std::string& line : lines) widest = std::max(widest, TextWidth(line, kSmallSize));
  return widest;
}

}  // namespace

Ground::Ground(const std::vector<SpacePoint>& points) : points_(points) {
  SpacePoint low = points.front(), high = low;
  for (const SpacePoint& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const SpacePoint span = high - low;
  step_ft_ = RoundStep(std::max(span.x(), span.y()), 7);
  north_ = Widened(low.x(), high.x(), step_ft_);
  east_ = Widened(low.y(), high.y(), step_ft_);
  altitude_ = Widened(low.z() - kBelow * span.z(), high.z(), RoundStep(span.z(), 12));
}

std::vector<SpacePoint> Ground::Corners() const {
  const double floor = floor_ft();
  return {{north_.min, east_.min, floor},
          {north_.max, east_.min, floor},
          {north_.max, east_.max, floor},
          {north_.min, east_.max, floor}};
}

SpacePoint Ground::LeftmostCorner(const View& view) const {
  const std::vector<SpacePoint> corners = Corners();
  return *std::min_element(corners.begin(), corners.end(), [&](const auto& a, const auto& b) {
    return view.Place(a).x < view.Place(b).x;
  });
}

std::vector<SpacePoint> Ground::Outline(const View& view) const {
  std::vector<SpacePoint> outline = Corners();
  SpacePoint top = LeftmostCorner(view);
  top.z() = ceiling_ft();
  outline.push_back(top);
  return outline;
}

std::vector<Shape> Ground::Draw(const View& view) const {
  std::vector<Shape> shapes;
  DrawGrid(view, &shapes);
  DrawNumbers(view, &shapes);
  DrawAltitudes(view, &shapes);
  DrawNorthArrow(view, &shapes);
  return shapes;
}

void Ground::DrawGrid(const View& view, std::vector<Shape>* shapes) const {
  std::vector<PagePoint> sheet;
  for (const SpacePoint& corner : Corners()) sheet.push_back(view.Place(corner));
  shapes->emplace_back(Area(sheet, kSheet));
  const auto line = [&](const SpacePoint& a, const SpacePoint& b) {
    shapes->emplace_back(Line({view.Place(a), view.Place(b)}, kSheetGrid, kHair));
  };
  for (const double n : Multiples(north_, step_ft_)) {
    line({n, east_.min, floor_ft()}, {n, east_.max, floor_ft()});
  }
  for (const double e : Multiples(east_, step_ft_)) {
    line({north_.min, e, floor_ft()}, {north_.max, e, floor_ft()});
  }
}

void Ground::DrawNumbers(const View& view, std::vector<Shape>* shapes) const {
  const auto nearest = [&](const Range& range, const SpacePoint& direction) {
    return view.Nearness(range.min * direction) > view.Nearness(range.max * direction) ? range.min
                                                                                       : range.max;
  };
  DrawEdge(view, true, nearest(east_, kEastward), shapes);
  DrawEdge(view, false, nearest(north_, kNorthward), shapes);
}

/// Numbers along an edge, and beyond its middle what they are; none at the foot of the post of
/// altitudes.
void Ground::DrawEdge(const View& view, bool is_along_north, double across,
                      std::vector<Shape>* shapes) const {
  const Range& along = is_along_north ? north_ : east_;
  const SpacePoint outward = is_along_north ? -Inward(across, east_) * kEastward
                                            : SpacePoint(-Inward(across, north_) * kNorthward);
  const auto point = [&](double value) {
    return is_along_north ? SpacePoint(value, across, floor_ft())
                          : SpacePoint(across, value, floor_ft());
  };
  const std::vector<double> values = Multiples(along, step_ft_);
  const std::vector<std::string> numbers = ThousandsOf(values);
  const double widest = WidestOf(numbers);
  const PagePoint first = view.Place(point(0)), next = view.Place(point(step_ft_));
  const int every = EveryNth(next.x - first.x, next.y - first.y, widest);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const SpacePoint place = point(values[k]);
    const bool is_shown = std::lround(values[k] / step_ft_) % every == 0;
    if (!is_shown || place == LeftmostCorner(view)) continue;
    Words words = Outside(view, place, outward, 7, numbers[k]);
    words.at.y += 3;
    shapes->emplace_back(words);
  }
  const SpacePoint middle = point((along.min + along.max) / 2);
  Words name = Outside(view, middle, outward, 19 + 0.5 * widest, "");
  name.at.y += 3;
  name.colour = kGrey;
  const std::string direction = is_along_north ? "north" : "east";
  // Beside the ground there is less room than below it.
  const bool is_beside = name.anchor != Anchor::kMiddle;
  const std::vector<std::string> lines =
      Wrapped(direction + ", 1000\u00a0ft", is_beside ? 1 : 1000, kSmallSize);
  if (name.anchor == Anchor::kEnd) name.at.x = std::max(name.at.x, 2 + WidestOf(lines));
  for (const std::string& line : lines) {
    name.text = line;
    shapes->emplace_back(name);
    name.at.y += 1.2 * kSmallSize;
  }
}

void Ground::DrawAltitudes(const View& view, std::vector<Shape>* shapes) const {
  const SpacePoint foot = LeftmostCorner(view);
  const PagePoint bottom = view.Place(foot);
  const auto height = [&](double level) { return view.Place({foot.x(), foot.y(), level}).y; };
  const double top = height(ceiling_ft());
  shapes->emplace_back(Line({bottom, {bottom.x, top}}, kGrey, 0.8));
  const double room = (bottom.y - top) / (1.5 * kSmallSize);
  double last = std::numeric_limits<double>::infinity();
  const std::vector<double> levels = Ticks(altitude_, std::min(room, kMostLevels));
  const std::vector<std::string> numbers = ThousandsOf(levels);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double y = height(levels[k]);
    shapes->emplace_back(Line({{bottom.x - 3, y}, {bottom.x, y}}, kGrey, 0.8));
    if (last - y < kSmallSize + 1) continue;  // seen from above, the post is short
    last = y;
    shapes->emplace_back(
        Words{{bottom.x - 5, y + 0.35 * kSmallSize}, numbers[k], kSmallSize, Anchor::kEnd});
  }
  double y = top - 7 - 1.2 * kSmallSize;
  for (const char* line : {"altitude,", "1000\u00a0ft"}) {
    shapes->emplace_back(Words{{bottom.x - 20, y}, line, kSmallSize, Anchor::kStart, kGrey});
    y += 1.2 * kSmallSize;
  }
}

/// In the corner that is farthest from all shadows.
void Ground::DrawNorthArrow(const View& view, std::vector<Shape>* shapes) const {
  // In steps of the grid.
  const double length =
      std::clamp(kArrowPerStep * step_ft_ * view.scale(), kLeastArrow, kMostArrow);
  const double size = length / 2 / view.scale();
  SpacePoint best = points_.front();
  double farthest = -1;
  for (const SpacePoint& corner : Corners()) {
    const SpacePoint middle = corner + 2 * size * Inward(corner.x(), north_) * kNorthward +
                              1.5 * size * Inward(corner.y(), east_) * kEastward;
    double nearest = std::numeric_limits<double>::infinity();
    for (const SpacePoint& point : points_) {
      nearest = std::min(nearest, (point - middle).head<2>().norm());
    }
    if (nearest <= farthest) continue;
    farthest = nearest;
    best = middle;
  }
  for (Shape& shape : NorthArrow(view, best, length)) shapes->push_back(std::move(shape));
}

std::vector<Shape> NorthArrow(const View& view, const SpacePoint& middle, double length) {
  const double size = length / 2 / view.scale();
  const auto place = [&](double north, double east) {
    return view.Place(middle + size * (north * kNorthward + east * kEastward));
  };
  Words letter{place(1.8, 0), "N", kTextSize, Anchor::kMiddle, kGrey};
  letter.at.y += 0.35 * kTextSize;
  letter.is_bold = true;
  return {Area({place(1, 0), place(-0.9, 0.42), place(-0.5, 0), place(-0.9, -0.42)}, kGrey),
          letter};
}

}  // namespace skein
