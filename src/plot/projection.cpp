// SPDX-License-Identifier: Apache-2.0
#include "src/plot/projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr double kRadians = 0.017453292519943295;  // of a degree

}  // namespace

View::View(double azimuth_deg, double elevation_deg, double vertical_scale)
    : vertical_scale_(vertical_scale) {
  const double azimuth = kRadians * azimuth_deg, elevation = kRadians * elevation_deg;
  const SpacePoint ahead(std::cos(azimuth), std::sin(azimuth), 0);
  right_ = SpacePoint(-std::sin(azimuth), std::cos(azimuth), 0);
  up_ = std::cos(elevation) * kUpward + std::sin(elevation) * ahead;
  to_viewer_ = std::sin(elevation) * kUpward - std::cos(elevation) * ahead;
  up_.z() *= vertical_scale;
  to_viewer_.z() *= vertical_scale;
}

double View::Fit(const std::vector<SpacePoint>& corners, PagePoint left_top, double width) {
  double low_x = right_.dot(corners.front()), high_x = low_x;
  double low_y = up_.dot(corners.front()), high_y = low_y;
  for (const SpacePoint& corner : corners) {
    const double x = right_.dot(corner), y = up_.dot(corner);
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
    low_y = std::min(low_y, y);
    high_y = std::max(high_y, y);
  }
  scale_ = width / std::max(high_x - low_x, 1.0);
  origin_ = {left_top.x - low_x * scale_, left_top.y + high_y * scale_};
  return (high_y - low_y) * scale_;
}

double View::FitWithin(const std::vector<SpacePoint>& corners, PagePoint left_top, double width,
                       double height) {
  const double taken = Fit(corners, left_top, width);
  if (taken <= height) return taken;
  const double narrower = width * height / taken;
  return Fit(corners, {left_top.x + (width - narrower) / 2, left_top.y}, narrower);
}

void View::PutOrigin(PagePoint origin, double scale) {
  origin_ = origin;
  scale_ = scale;
}

PagePoint View::Place(const SpacePoint& point) const {
  return {origin_.x + scale_ * right_.dot(point), origin_.y - scale_ * up_.dot(point)};
}

BodyAxes View::Shown(const BodyAxes& axes) const {
  if (vertical_scale_ == 1) return axes;
  const SpacePoint stretch(1, 1, vertical_scale_);
  // About the level line across the heading, which changes neither heading nor bank.
  const auto pitched =
      Eigen::Quaterniond::FromTwoVectors(axes.forward, axes.forward.cwiseProduct(stretch));
  const auto shown = [&](const SpacePoint& axis) {
    return SpacePoint((pitched * axis).cwiseQuotient(stretch));
  };
  return {shown(axes.forward), shown(axes.right), shown(axes.up)};
}

BodyAxes BodyAxesOf(double roll_deg, double pitch_deg, double yaw_deg) {
  const double sr = std::sin(kRadians * roll_deg), cr = std::cos(kRadians * roll_deg);
  const double sp = std::sin(kRadians * pitch_deg), cp = std::cos(kRadians * pitch_deg);
  const double sy = std::sin(kRadians * yaw_deg), cy = std::cos(kRadians * yaw_deg);
  return {{cp * cy, cp * sy, sp},
          {sr * sp * cy - cr * sy, sr * sp * sy + cr * cy, -sr * cp},
          {-(cr * sp * cy + sr * sy), -(cr * sp * sy - sr * cy), cr * cp}};
}

}  // namespace skein
