// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/mean_actor.h"

#include <algorithm>
#include <cstddef>

namespace skein {

void MoveAverage(const float* parameters, std::uint64_t iteration, int iterations,
                 std::vector<float>* mean) {
  const auto known = std::min(iteration, static_cast<std::uint64_t>(iterations));
  const float share = 1 / static_cast<float>(known);
  for (std::size_t i = 0; i < mean->size(); ++i) {
    (*mean)[i] = (1 - share) * (*mean)[i] + share * parameters[i];
  }
}

}  // namespace skein
