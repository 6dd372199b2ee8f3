// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/plot/legend.h"
#include "src/plot/recordings.h"
#include "src/plot/track.h"

namespace skein {

/// A line with a head at its end.
void DrawArrow(PagePoint begin, PagePoint end, std::vector<Shape>* shapes);

/// Where a track's target is marked last: the end of the arrow into its heading, or the target.
PagePoint TargetTip(const View& view, const Track& track);

/// What a track was to reach: a ring at a target in space with the box of its tolerances, or else
/// an arrow into its heading at its altitude with the sector and the height that count as reached.
void DrawTarget(const View& view, const Track& track, const Recordings& recordings,
                std::vector<Shape>* shapes);

/// What the marks mean.
LegendEntry TargetEntry(const Track& track, const Recordings& recordings);

}  // namespace skein
