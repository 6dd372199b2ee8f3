// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace skein {

/// The larger of two numbers. NaN counts as infinity: std::max passes over it, so that a worst
/// error would stay small where there is no number at all.
template <class Number>
Number Larger(Number a, Number b) {
  constexpr Number kInfinity = std::numeric_limits<Number>::infinity();
  return std::isnan(a) || std::isnan(b) ? kInfinity : std::max(a, b);
}

/// The smaller of two numbers; NaN counts as minus infinity.
template <class Number>
Number Smaller(Number a, Number b) {
  return -Larger(-a, -b);
}

/// The largest element of a range that is not empty, by Larger.
template <class Numbers>
auto LargestOf(const Numbers& numbers) {
  auto largest = *std::begin(numbers);
  for (const auto number : numbers) largest = Larger(largest, number);
  return largest;
}

}  // namespace skein
