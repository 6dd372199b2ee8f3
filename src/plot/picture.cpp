// SPDX-License-Identifier: Apache-2.0
#include "src/plot/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace skein {
namespace {

constexpr std::array<Dash, 3> kDashes = {Dash::kNone, Dash::kDashed, Dash::kShort};
constexpr double kToleratedPoints = 0.15;
constexpr double kWidthPerSize = 0.58;  // of a letter in font sizes, in the mean over wide fonts

double DistanceFromChord(const PagePoint& point, const PagePoint& begin, const PagePoint& end) {
  const double dx = end.x - begin.x, dy = end.y - begin.y, length = std::hypot(dx, dy);
  if (length == 0) return std::hypot(point.x - begin.x, point.y - begin.y);
  return std::abs((point.x - begin.x) * dy - (point.y - begin.y) * dx) / length;
}

/// The inner point that is farthest from the chord, if it is too far from it; else `begin`.
std::size_t FarthestFromChord(const std::vector<PagePoint>& points, std::size_t begin,
                              std::size_t end) {
  std::size_t far = begin;
  double distance = kToleratedPoints;
  for (std::size_t i = begin + 1; i < end; ++i) {
    const double own = DistanceFromChord(points[i], points[begin], points[end]);
    if (own <= distance) continue;
    far = i;
    distance = own;
  }
  return far;
}

std::size_t LettersIn(const std::string& utf8) {
  return static_cast<std::size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char byte) { return (byte & 0xC0) != 0x80; }));
}

}  // namespace

Colour Mixed(Colour colour, Colour other, double share) {
  Colour mixed = 0;
  for (const int shift : {16, 8, 0}) {
    const double a = (colour >> shift) & 0xFF, b = (other >> shift) & 0xFF;
    mixed |= static_cast<Colour>(std::lround(a + (b - a) * share)) << shift;
  }
  return mixed;
}

CurveStyle StyleOf(std::size_t number) {
  const std::size_t round = number / kAgentColours.size();
  return {ColourOf(number), kDashes[round % kDashes.size()], kMarkers[round % kMarkers.size()]};
}

Path Line(std::vector<PagePoint> points, Colour colour, double width, Dash dash) {
  Path path;
  path.points = std::move(points);
  path.stroke = colour;
  path.width = width;
  path.dash = dash;
  return path;
}

Path Area(std::vector<PagePoint> corners, Colour fill, double opacity) {
  Path path;
  path.points = std::move(corners);
  path.fill = fill;
  path.is_closed = true;
  path.opacity = opacity;
  return path;
}

Shape MarkerAt(PagePoint middle, Marker marker, const Disc& look) {
  constexpr double kHalfSquare = 0.89, kTriangle = 1.55;  // of the radius, for the same area
  Path path;
  if (marker == Marker::kSquare) {
    const double half = kHalfSquare * look.radius;
    path.points = {{middle.x - half, middle.y - half},
                   {middle.x + half, middle.y - half},
                   {middle.x + half, middle.y + half},
                   {middle.x - half, middle.y + half}};
  } else if (marker == Marker::kTriangle) {
    const double side = kTriangle * look.radius;
    path.points = {{middle.x, middle.y - side},
                   {middle.x + 0.866 * side, middle.y + side / 2},
                   {middle.x - 0.866 * side, middle.y + side / 2}};
  } else {
    return Disc{middle, look.radius, look.fill, look.stroke, look.width};
  }
  path.fill = look.fill;
  path.stroke = look.stroke;
  path.width = look.width;
  path.is_closed = true;
  return path;
}

double TextWidth(const std::string& text, double size) {
  return kWidthPerSize * size * static_cast<double>(LettersIn(text));
}

std::vector<std::string> Wrapped(const std::string& text, double width, double size) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool fits = !lines.empty() && TextWidth(lines.back() + " " + word, size) <= width;
    if (fits) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

std::vector<PagePoint> Simplified(const std::vector<PagePoint>& points) {
  if (points.size() < 3) return points;
  std::vector<bool> keeps(points.size(), false);
  keeps.front() = keeps.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans = {{0, points.size() - 1}};
  while (!spans.empty()) {
    const auto [begin, end] = spans.back();
    spans.pop_back();
    const std::size_t far = FarthestFromChord(points, begin, end);
    if (far == begin) continue;
    keeps[far] = true;
    spans.emplace_back(begin, far);
    spans.emplace_back(far, end);
  }
  std::vector<PagePoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keeps[i]) kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace skein
