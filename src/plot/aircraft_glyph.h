// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "src/plot/picture.h"
#include "src/plot/projection.h"

namespace skein {

/// Of the outline that is drawn, an F-16's, ft.
inline constexpr double kGlyphLength_ft = 49, kGlyphHalfSpan_ft = 15.5;
/// The span of its wing without what is at the tips, by which aircraft are compared with it, ft.
inline constexpr double kGlyphWingSpan_ft = 30;

/// A little aircraft in its attitude, as View::Shown has it, `enlarged` times its size: from above
/// filled with the colour, from below with a pale one.
std::vector<Shape> AircraftGlyph(const View& view, const SpacePoint& position,
                                 const BodyAxes& attitude, Colour colour, double enlarged);

}  // namespace skein
