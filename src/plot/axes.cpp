// SPDX-License-Identifier: Apache-2.0
#include "src/plot/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/ends_with.h"
#include "src/files/column_words.h"

namespace skein {
namespace {

constexpr double kPadding = 0.06;        // of a range
constexpr double kLabelGap = 4;          // between an axis and its numbers, points
constexpr double kNameLeft = 36;         // between an axis and the base line of its name, points
constexpr double kNameBottom = 22;       // as well, below
constexpr double kHeadGap = 4;           // between a panel and the base line of its head, points
constexpr double kRoundingGuard = 1e-9;  // of a step, so that ends that are multiples count
constexpr double kCountWithTwo = 5;      // steps are at most half the range from here on
constexpr double kPointsPerTick = 46, kHeightPerTick = 24;
constexpr int kLeastDigits = 5, kMostDigits = 15;  // of a tick, significant

/// A thousands separator for every three digits of the whole part.
std::string WithCommas(const std::string& number) {
  const std::size_t begin = number[0] == '-' ? 1 : 0;
  std::size_t at = std::min(number.find('.'), number.size());
  std::string text = number;
  while (at > begin + 3) text.insert(at -= 3, ",");
  return text;
}

/// With separators, to so many significant digits.
std::string InLetters(double value, int digits) {
  const std::string text = fmt::format("{:.{}g}", value, digits);
  return text.find('e') == std::string::npos ? WithCommas(text) : text;
}

/// From the first digit of the largest tick to that of the step.
int TickDigits(const std::vector<double>& ticks) {
  if (ticks.size() < 2) return kLeastDigits;
  const double step = (ticks.back() - ticks.front()) / static_cast<double>(ticks.size() - 1);
  const double largest = std::max(std::abs(ticks.front()), std::abs(ticks.back()));
  const double digits =
      std::floor(std::log10(largest)) - std::floor(std::log10(step) + kRoundingGuard) + 1;
  return static_cast<int>(std::clamp<double>(digits, kLeastDigits, kMostDigits));
}

/// Round numbers within the range, about `count` of them.
std::vector<double> TicksNear(const Range& range, double count) {
  const double share = (range.max - range.min) / std::max(count, 1.0);
  const double rough = share > std::numeric_limits<double>::min() ? share : 1;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double multiple : {5.0, 2.0, 1.0}) {
    if (multiple * power >= rough * 0.999) step = multiple * power;
  }
  std::vector<double> ticks;
  const double first = std::ceil(range.min / step - kRoundingGuard);
  const double last = std::floor(range.max / step + kRoundingGuard);
  // Counted from 0, as a number beyond 2^53 is the same after 1 was added.
  for (double k = 0; k <= last - first; ++k) {
    const double multiple = first + k;
    ticks.push_back(multiple == 0 ? 0 : multiple * step);
  }
  return ticks;
}

}  // namespace

bool IsShare(const std::string& column) { return EndsWith(column, "success_rate"); }

std::string InWords(const std::string& column) {
  if (IsShare(column)) return WithBlanks(column) + ", %";
  const ColumnWords words = ColumnWordsOf(column);
  return words.unit.empty() ? words.quantity : words.quantity + ", " + words.unit;
}

std::vector<double> Ticks(const Range& range, double count) {
  std::vector<double> ticks = TicksNear(range, count);
  for (double more = std::max(count, 1.0); ticks.size() < 2 && more < kCountWithTwo;) {
    ticks = TicksNear(range, more *= 2);
  }
  return ticks;
}

std::vector<double> TicksAcross(const Range& range, double width) {
  return Ticks(range, width / kPointsPerTick);
}

std::vector<double> TicksUp(const Range& range, double height) {
  return Ticks(range, height / kHeightPerTick);
}

std::string TickText(double value) { return InLetters(value, kLeastDigits); }

std::vector<std::string> TickTexts(const std::vector<double>& ticks) {
  const int digits = TickDigits(ticks);
  std::vector<std::string> texts;
  for (const double tick : ticks) texts.push_back(InLetters(tick, digits));
  return texts;
}

Range SpanOf(const std::vector<double>& values) {
  Range span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    span = {std::min(span.min, value), std::max(span.max, value)};
  }
  return span.min <= span.max ? span : Range{0, 1};
}

Range Padded(const std::vector<double>& values) {
  const Range span = SpanOf(values);
  const double pad = span.max > span.min ? kPadding * (span.max - span.min)
                                         : std::max(1.0, 1e-3 * std::abs(span.max));
  return {span.min - pad, span.max + pad};
}

PagePoint Panel::Place(double x, double y) const {
  const auto share = [](double value, const Range& range) {
    return range.max > range.min ? (value - range.min) / (range.max - range.min) : 0.5;
  };
  return {left() + width_ * share(x, x_range_), bottom() - height_ * share(y, y_range_)};
}

std::vector<PagePoint> Panel::Placed(const std::vector<PagePoint>& points) const {
  std::vector<PagePoint> placed;
  placed.reserve(points.size());
  for (const PagePoint& point : points) placed.push_back(Place(point.x, point.y));
  return placed;
}

void Panel::DrawAxes(std::vector<Shape>* shapes) const {
  const std::vector<double> across = TicksAcross(x_range_, width_);
  const std::vector<double> up = TicksUp(y_range_, height_);
  DrawGrid(across, up, shapes);
  LabelLeft(up, shapes);
  LabelBottom(across, shapes);
}

void Panel::DrawGrid(const std::vector<double>& x_ticks, const std::vector<double>& y_ticks,
                     std::vector<Shape>* shapes) const {
  constexpr double kHair = 0.5;
  for (const double y : y_ticks) {
    const double height = Place(0, y).y;
    shapes->emplace_back(Line({{left(), height}, {right(), height}}, kGridGrey, kHair));
  }
  for (const double x : x_ticks) {
    const double across = Place(x, 0).x;
    shapes->emplace_back(Line({{across, top()}, {across, bottom()}}, kGridGrey, kHair));
  }
  shapes->emplace_back(
      Line({{left(), top()}, {left(), bottom()}, {right(), bottom()}}, kGrey, 1.2 * kHair));
}

void Panel::LabelLeft(const std::vector<double>& ticks, std::vector<Shape>* shapes) const {
  const std::vector<std::string> texts = TickTexts(ticks);
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const PagePoint at{left() - kLabelGap, Place(0, ticks[k]).y + 0.35 * kSmallSize};
    shapes->emplace_back(Words{at, texts[k], kSmallSize, Anchor::kEnd});
  }
}

void Panel::LabelBottom(const std::vector<double>& ticks, std::vector<Shape>* shapes) const {
  const std::vector<std::string> texts = TickTexts(ticks);
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const PagePoint at{Place(ticks[k], 0).x, bottom() + kLabelGap + kSmallSize};
    shapes->emplace_back(Words{at, texts[k], kSmallSize, Anchor::kMiddle});
  }
}

void Panel::NameLeft(const std::string& words, std::vector<Shape>* shapes) const {
  Words name{{left() - kNameLeft, (top() + bottom()) / 2}, words, kTextSize, Anchor::kMiddle};
  name.runs_upwards = true;
  shapes->emplace_back(std::move(name));
}

void Panel::NameBottom(const std::string& words, std::vector<Shape>* shapes) const {
  const PagePoint at{(left() + right()) / 2, bottom() + kNameBottom};
  shapes->emplace_back(Words{at, words, kTextSize, Anchor::kMiddle});
}

void Panel::DrawHead(const std::string& words, std::vector<Shape>* shapes) const {
  Words head{{left(), top() - kHeadGap}, words};
  head.is_bold = true;
  shapes->emplace_back(std::move(head));
}

void Panel::DrawCurve(const std::vector<PagePoint>& points, Colour colour, double width, Dash dash,
                      std::vector<Shape>* shapes) const {
  if (points.empty()) return;
  if (points.size() == 1) {
    shapes->emplace_back(Disc{Place(points[0].x, points[0].y), 1.5, colour, std::nullopt});
    return;
  }
  shapes->emplace_back(Line(Simplified(Placed(points)), colour, width, dash));
}

void Panel::DrawBand(const std::vector<PagePoint>& low, const std::vector<PagePoint>& high,
                     Colour colour, double opacity, std::vector<Shape>* shapes) const {
  if (low.empty()) return;
  std::vector<PagePoint> outline = Simplified(Placed(low));
  const std::vector<PagePoint> above = Simplified(Placed(high));
  outline.insert(outline.end(), above.rbegin(), above.rend());
  shapes->emplace_back(Area(std::move(outline), colour, opacity));
}

}  // namespace skein
