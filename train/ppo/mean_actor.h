// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace skein {

/// Moves the mean of parameters to what it is after iteration `iteration`, from 1 on, which left
/// `parameters`: their plain mean until there are `iterations` of them, then by 1 / `iterations` of
/// the difference. (Polyak and Juditsky 1992, "Acceleration of stochastic approximation by
/// averaging".)
void MoveAverage(const float* parameters, std::uint64_t iteration, int iterations,
                 std::vector<float>* mean);

}  // namespace skein
