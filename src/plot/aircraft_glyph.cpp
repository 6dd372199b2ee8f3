// SPDX-License-Identifier: Apache-2.0
#include "src/plot/aircraft_glyph.h"

#include <utility>

namespace skein {
namespace {

using Outline = std::vector<std::pair<double, double>>;  // ft forward, and to a side or up

/// The right half, from nose to tail.
Outline Hull() {
  return {{25, 0},
          {20, 1.4},
          {13, 2.2},
          {8, 3.4},
          {4, 4.4},
          {-6, kGlyphHalfSpan_ft},
          {-10, kGlyphHalfSpan_ft},
          {-10.5, 4.4},
          {-14.5, 4.2},
          {-20.5, 9.2},
          {-23.5, 9.2},
          {-22.5, 2.4},
          {-24, 1.8}};
}

Outline Fin() { return {{-6, 1.5}, {-16.5, 11.5}, {-22.5, 11.5}, {-20.5, 1.5}}; }

/// The right half.
Outline Canopy() { return {{16, 0}, {14, 1.1}, {9, 1.3}, {6, 0}}; }

Outline BothHalves(const Outline& half) {
  Outline whole = half;
  for (auto point = half.rbegin(); point != half.rend(); ++point) {
    whole.emplace_back(point->first, -point->second);
  }
  return whole;
}

}  // namespace

std::vector<Shape> AircraftGlyph(const View& view, const SpacePoint& position,
                                 const BodyAxes& attitude, Colour colour, double enlarged) {
  const BodyAxes axes = view.Shown(attitude);
  const auto area = [&](const Outline& outline, const SpacePoint& sideways, Colour fill) {
    std::vector<PagePoint> points;
    for (const auto& [forward, side] : outline) {
      points.push_back(
          view.Place(position + enlarged * (forward * axes.forward + side * sideways)));
    }
    return Area(std::move(points), fill);
  };
  const auto edged = [&](Path path) {
    path.stroke = Mixed(colour, 0, 0.45);
    path.width = 0.4;
    return path;
  };
  const bool from_above = view.Nearness(axes.up) > 0;
  const Colour fill = from_above ? colour : Mixed(colour, kWhite, 0.6);
  const Path hull = edged(area(BothHalves(Hull()), axes.right, fill));
  const Path fin = edged(area(Fin(), axes.up, Mixed(colour, 0, 0.25)));
  if (!from_above) return {fin, hull};
  return {hull, area(BothHalves(Canopy()), axes.right, Mixed(colour, kWhite, 0.75)), fin};
}

}  // namespace skein
