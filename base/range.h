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

/// `share`^power, of a power of at least 0.
inline double WholePower(double share, int power) {
  double product = 1;
  for (int k = 0; k < power; ++k) product *= share;
  return product;
}

/// Where the `share`^power, of a share in [0, 1), lies in the range: uniform shares favour its
/// least values where power is above 1.
inline double BentInto(const Range& range, double share, int power) {
  return range.min + (range.max - range.min) * WholePower(share, power);
}

}  // namespace skein
