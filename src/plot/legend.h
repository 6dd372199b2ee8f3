// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/range.h"
#include "src/plot/picture.h"

namespace skein {

/// A sample is drawn from the left end of a space of kSampleWidth on, around a height.
inline constexpr double kSampleWidth = 20;
using Sample = std::function<void(PagePoint left, std::vector<Shape>* shapes)>;

struct LegendEntry {
  Sample sample;
  std::string words;
};

Sample LineSample(Colour colour, double width, Dash dash = Dash::kNone);
Sample BandSample(Colour colour, double opacity);
Sample MarkerSample(Marker marker, const Disc& look);
/// Of dots that are the paler the slower they are, the slowest `pale` of the way to white.
LegendEntry PaleIsSlow(const Range& true_airspeed_fps, double radius, double pale);

/// Of each name whether it is there more than once, so that a legend could not tell apart what has
/// it.
std::vector<bool> AreTwice(const std::vector<std::string>& names);

/// Entries from left to right from `at` on, wrapped at `right`; returns the lowest base line.
double DrawLegend(PagePoint at, double right, const std::vector<LegendEntry>& entries,
                  std::vector<Shape>* shapes);

/// The title, if there is one, in as many lines as it needs between the margins; returns the height
/// from which on there is room.
double DrawTitle(const std::string& title, double width, std::vector<Shape>* shapes);

inline constexpr double kMargin = 8;  ///< of a picture, points

/// The height of the picture is that of what is drawn, and its title what readers of screens say.
Picture FinishedPicture(double width, double bottom, const std::string& title,
                        std::vector<Shape> shapes);

}  // namespace skein
