// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein::bench {

/// Draws the deviates of one observation's noise for `count` aircraft, a multiple of 32, and adds
/// them up in `sums`: what observation noise costs before it is scaled and added.
void DrawNoise(std::uint64_t seed, int count, const std::int32_t* episode, const std::int32_t* step,
               float* sums);

}  // namespace skein::bench
