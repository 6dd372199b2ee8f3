// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/pattern_search.h"

#include <cmath>

namespace skein {

std::vector<double> SearchPattern(const std::function<double(const std::vector<double>&)>& cost,
                                  std::vector<double> start, double last_factor) {
  constexpr double kFirstFactor = 2;
  std::vector<double> best = std::move(start);
  double least = cost(best);
  for (double factor = kFirstFactor; factor > last_factor;) {
    bool is_better = false;
    for (double& value : best) {
      const double here = value;
      for (const double there : {here * factor, here / factor}) {
        value = there;
        const double found = cost(best);
        if (found < least) {
          least = found;
          is_better = true;
          break;
        }
        value = here;
      }
    }
    if (!is_better) factor = std::sqrt(factor);
  }
  return best;
}

}  // namespace skein
