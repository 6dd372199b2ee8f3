// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/range.h"
#include "src/plot/picture.h"

namespace skein {

/// Whether a column holds shares, which are shown in percent.
bool IsShare(const std::string& column);

/// "true airspeed, ft/s" of the column true_airspeed_fps; of success_rate, which holds shares,
/// "success rate, %".
std::string InWords(const std::string& column);

/// Round numbers (1, 2 or 5 times a power of ten apart) within the range, about `count` of them;
/// more where one number would be all, as that is no scale.
std::vector<double> Ticks(const Range& range, double count);

/// Ticks of a lower axis of that width, and of a left axis of that height, in points: about as many
/// as there is room for.
std::vector<double> TicksAcross(const Range& range, double width);
std::vector<double> TicksUp(const Range& range, double height);

/// A number in letters, to five digits: "12,500", "-0.02".
std::string TickText(double value);
/// The ticks of an axis, evenly spaced, in letters: as TickText, but to as many digits as their
/// step has, up to 15: "15,000", "15,000.2".
std::vector<std::string> TickTexts(const std::vector<double>& ticks);

/// Of the numbers among `values`, with some room around; 0 to 1 of none.
Range Padded(const std::vector<double>& values);
/// Of the numbers among `values`; 0 to 1 of none.
Range SpanOf(const std::vector<double>& values);

/// Between the paper's edge, or another panel, and a panel with NameLeft, points.
inline constexpr double kLeftOfPanel = 48;
/// Above a panel with DrawHead, points.
inline constexpr double kAbovePanel = 16;

/// A rectangle on which values of two ranges are drawn.
class Panel {
 public:
  Panel(PagePoint left_top, double width, double height, Range x_range, Range y_range)
      : left_top_(left_top), width_(width), height_(height), x_range_(x_range), y_range_(y_range) {}

  double left() const { return left_top_.x; }
  double top() const { return left_top_.y; }
  double right() const { return left_top_.x + width_; }
  double bottom() const { return left_top_.y + height_; }
  double width() const { return width_; }
  double height() const { return height_; }
  const Range& x_range() const { return x_range_; }
  const Range& y_range() const { return y_range_; }

  PagePoint Place(double x, double y) const;
  /// `points` hold values.
  std::vector<PagePoint> Placed(const std::vector<PagePoint>& points) const;

  /// The grid and its numbers, at ticks for which there is room.
  void DrawAxes(std::vector<Shape>* shapes) const;
  /// Grey lines at the ticks, and the panel's left and lower edge.
  void DrawGrid(const std::vector<double>& x_ticks, const std::vector<double>& y_ticks,
                std::vector<Shape>* shapes) const;
  void LabelLeft(const std::vector<double>& ticks, std::vector<Shape>* shapes) const;
  void LabelBottom(const std::vector<double>& ticks, std::vector<Shape>* shapes) const;
  /// What the left axis shows: read from below, beside numbers of up to seven letters.
  void NameLeft(const std::string& words, std::vector<Shape>* shapes) const;
  /// What the lower axis shows, below its numbers.
  void NameBottom(const std::string& words, std::vector<Shape>* shapes) const;
  /// What the panel shows, above it.
  void DrawHead(const std::string& words, std::vector<Shape>* shapes) const;
  /// A curve through values, simplified; of one alone a dot.
  void DrawCurve(const std::vector<PagePoint>& points, Colour colour, double width, Dash dash,
                 std::vector<Shape>* shapes) const;
  /// The area between two curves over the same x.
  void DrawBand(const std::vector<PagePoint>& low, const std::vector<PagePoint>& high,
                Colour colour, double opacity, std::vector<Shape>* shapes) const;

 private:
  PagePoint left_top_;
  double width_, height_;
  Range x_range_, y_range_;
};

}  // namespace skein
