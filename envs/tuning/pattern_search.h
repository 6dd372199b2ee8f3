// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace skein {

/// Positive numbers at which `cost` is least, from `start` on: each in turn is multiplied and
/// divided by a factor, 2 at first and its square root wherever nothing helps, until it is below
/// `last_factor` (the pattern search of Hooke and Jeeves, 1961, on logarithms). The same
/// everywhere.
std::vector<double> SearchPattern(const std::function<double(const std::vector<double>&)>& cost,
                                  std::vector<double> start, double last_factor = 1.1);

}  // namespace skein
