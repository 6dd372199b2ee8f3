// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// A closed interval from which a value is drawn uniformly.
struct Range {
  double min = 0, max = 0;
};

/// The range with its ends moved towards `nominal`: `share` of their distance is left.
inline Range Narrowed(const Range& range, double nominal, double share) {
  const double rest = (1 - share) * nominal;  // exact at both ends
  return {share * range.min + rest, share * range.max + rest};
}

/// The share of the range that is next to its least value.
inline Range Lowest(const Range& range, double share) {
  return {range.min, Narrowed(range, range.min, share).max};
}

}  // namespace skein
