// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/range.h"
#include "src/plot/projection.h"

namespace skein {

/// A level rectangle under flights in space on which their shadows fall, and the altitudes up to
/// the highest.
class Ground {
 public:
  /// Under all `points`, of which there is one at least.
  explicit Ground(const std::vector<SpacePoint>& points);

  const Range& north() const { return north_; }
  const Range& east() const { return east_; }
  double floor_ft() const { return altitude_.min; }
  double ceiling_ft() const { return altitude_.max; }
  SpacePoint Below(const SpacePoint& point) const { return {point.x(), point.y(), floor_ft()}; }

  /// Its corners, and the top of the post of altitudes at the leftmost of them.
  std::vector<SpacePoint> Outline(const View& view) const;

  /// The grid with numbers, the post of altitudes, and an arrow to the north.
  std::vector<Shape> Draw(const View& view) const;

 private:
  std::vector<SpacePoint> Corners() const;
  SpacePoint LeftmostCorner(const View& view) const;
  void DrawGrid(const View& view, std::vector<Shape>* shapes) const;
  void DrawNumbers(const View& view, std::vector<Shape>* shapes) const;
  void DrawEdge(const View& view, bool is_along_north, double across,
                std::vector<Shape>* shapes) const;
  void DrawAltitudes(const View& view, std::vector<Shape>* shapes) const;
  void DrawNorthArrow(const View& view, std::vector<Shape>* shapes) const;

  std::vector<SpacePoint> points_;
  double step_ft_;
  Range north_, east_, altitude_;
};

/// An arrow to the north that lies flat in space, with its letter, `length` on the paper if it were
/// seen from above.
std::vector<Shape> NorthArrow(const View& view, const SpacePoint& middle, double length);

}  // namespace skein
