// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/plot/legend.h"
#include "src/plot/recordings.h"
#include "src/plot/track.h"

namespace skein {

/// A line with a head at its end.
void DrawArrow(PagePoint begin, PagePoint end, Colour colour, std::vector<Shape>* shapes);

/// Length of the arrow into a target's heading in a picture of that width, points: shorter in one
/// that is narrower than a page.
double TargetArrow(double picture_width);

/// Of the marks of its targets. Those of missions, which differ between agents, have the agent's
/// colour where there are several.
Colour TargetColour(const Track& track, const Recordings& recordings);

/// Where a target is marked last: the end of the arrow into its heading, which is so many feet
/// long, or the target.
SpacePoint TargetTip(const View& view, const TrackTarget& target, double arrow_ft);

/// Places on the paper that the mark covers, from the target to its tip.
std::vector<PagePoint> TargetArrowPoints(const View& view, const TrackTarget& target,
                                         double arrow_ft);

/// What a track was to reach: a ring at a target in space with the box of its tolerances, or else
/// an arrow of so many feet into its heading at its altitude with the sector and the height that
/// count as reached.
void DrawTargets(const View& view, const Track& track, const Recordings& recordings,
                 double arrow_ft, std::vector<Shape>* shapes);

/// What the marks mean; nothing where DrawTargets draws none.
std::optional<LegendEntry> TargetEntry(const Track& track, const Recordings& recordings);

}  // namespace skein
