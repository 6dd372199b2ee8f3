// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace skein::bench {

// Passes over `count` floats, a multiple of 128, aligned to 64 bytes, by the widest vectors of the
// active target.

/// Their sum.
float ReadStream(const float* values, std::size_t count);

/// Overwrites them with `value`.
void WriteStream(float* values, std::size_t count, float value);

/// Adds `value` to each in place.
void UpdateStream(float* values, std::size_t count, float value);

}  // namespace skein::bench
