// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein::simd {

/// Does `rounds` rounds of products of bfloat16 pairs by the instruction vdpbf16ps, and returns
/// their floating-point operations (a multiply-add counts as two); `sink` gets a result, so that
/// the work cannot be left out. Only where NativeBfloat16() (simd/target.h).
double MultiplyAddBfloat16(std::int64_t rounds, float* sink);

/// The same of tiles of bfloat16 by the instruction tdpbf16ps. Only where NativeTiles().
double MultiplyAddTiles(std::int64_t rounds, float* sink);

}  // namespace skein::simd
