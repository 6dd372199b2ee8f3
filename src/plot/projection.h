// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "src/plot/picture.h"

namespace skein {

/// A place in space: feet to the north, to the east and up.
using SpacePoint = Eigen::Vector3d;

inline const SpacePoint kNorthward(1, 0, 0), kEastward(0, 1, 0), kUpward(0, 0, 1);

/// A parallel projection, equal scales on all three axes: seen from afar.
class View {
 public:
  /// Looks towards a compass direction, and down by an elevation; 90 is a map.
  View(double azimuth_deg, double elevation_deg);

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

  const SpacePoint& to_viewer() const { return to_viewer_; }
  double scale() const { return scale_; }  ///< points for a foot across the view

 private:
  SpacePoint right_, up_, to_viewer_;
  double scale_ = 1;
  PagePoint origin_;
};

/// The body's forward, right and up directions.
struct BodyAxes {
  SpacePoint forward, right, up;
};

BodyAxes BodyAxesOf(double roll_deg, double pitch_deg, double yaw_deg);

}  // namespace skein
