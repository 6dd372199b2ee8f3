// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "envs/state/state.h"

namespace skein {

/// Angles of a tile's aircraft, rad.
struct BodyAngles {
  std::vector<float> roll;      ///< in [-pi, pi]
  std::vector<float> sideslip;  ///< relative to the air, in [-pi / 2, pi / 2]
};

/// Measures those of `tile`. The vectors become as long as its padding asks.
void MeasureAngles(const Tile& tile, BodyAngles* angles);

}  // namespace skein
