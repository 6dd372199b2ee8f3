// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/state/state.h"

namespace skein {

/// Throttle, pitch, roll, yaw.
inline constexpr int kActionSize = 4;

/// Turns a tile's actions, row-major [tile.count][kActionSize], into throttle and stick commands:
/// kActionSize columns `command_stride` apart, clipped to [-1, 1], the throttle brought to [0, 1].
/// Where the last aircraft does not fill a vector, the rest of its lanes get centred commands. An
/// action that is not finite makes its aircraft's kU NaN, so that its episode ends as non_finite.
void TakeActions(const float* action, Tile tile, float* command, std::size_t command_stride);

}  // namespace skein
