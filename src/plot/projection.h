// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "src/plot/picture.h"

namespace skein {

/// A place in space: feet to the north, to the east and up.
using SpacePoint = Eigen::Vector3d;

inline const SpacePoint kNorthward(1, 0, 0), kEastward(0, 1, 0), kUpward(0, 0, 1);

/// The body's forward, right and up directions.
struct BodyAxes {
  SpacePoint forward, right, up;
};

BodyAxes BodyAxesOf(double roll_deg, double pitch_deg, double yaw_deg);

/// A parallel projection, seen from afar: equal scales on all three axes, or the vertical one
/// stretched.
class View {
 public:
  /// Looks towards a compass direction, and down by an elevation; 90 is a map. A height is drawn
  /// `vertical_scale` times as high as at equal scales.
  View(double azimuth_deg, double elevation_deg, double vertical_scale = 1);

  /// Lets the corners fill a width from (left, top) on; returns the height that they take.
  double Fit(const std::vector<SpacePoint>& corners, PagePoint left_top, double width);
  /// Lets them fill that width, or that height if it is reached before, in the middle of the width.
  double FitWithin(const std::vector<SpacePoint>& corners, PagePoint left_top, double width,
                   double height);
  /// Puts the origin there, at a scale in points for a foot.
  void PutOrigin(PagePoint origin, double scale);

  PagePoint Place(const SpacePoint& point) const;
  /// Larger is nearer to the viewer.
  double Nearness(const SpacePoint& point) const { return to_viewer_.dot(point); }
  /// What to draw a body along that keeps its shape where the vertical is stretched: heading and
  /// bank stay, and the nose points along the path as drawn.
  BodyAxes Shown(const BodyAxes& axes) const;

  double scale() const { return scale_; }  ///< points for a foot across the view

 private:
  double vertical_scale_;
  SpacePoint right_, up_, to_viewer_;  // by which points are multiplied, with the vertical scale
  double scale_ = 1;
  PagePoint origin_;
};

}  // namespace skein
