// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "envs/aircraft/aircraft.h"

namespace skein {

/// Where a value lies on an axis: between nodes `index` and `index + 1`, `fraction` of the way.
struct GridCell {
  int index = 0;
  double fraction = 0;
};

/// Cell of `x` on a strictly increasing axis of at least two nodes; values outside are clamped to
/// it.
inline GridCell Locate(const std::vector<double>& axis, double x) {
  x = std::clamp(x, axis.front(), axis.back());
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, x);
  const auto index = static_cast<std::size_t>(above - axis.begin()) - 1;
  return {static_cast<int>(index), (x - axis[index]) / (axis[index + 1] - axis[index])};
}

/// Linear interpolation in one row of nodes `stride` apart.
inline double Interpolate(const double* row, GridCell cell, int stride) {
  const double* node = row + cell.index * stride;
  return node[0] * (1 - cell.fraction) + node[stride] * cell.fraction;
}

inline double Interpolate(const std::vector<double>& table, GridCell i) {
  return Interpolate(table.data(), i, 1);
}

/// The function at `mach`.
inline double ValueAt(const MachFunction& function, double mach) {
  return Interpolate(function.value, Locate(function.mach, mach));
}

/// Bilinear interpolation in a row-major table with `columns` columns.
inline double Interpolate(const std::vector<double>& table, GridCell i, GridCell j, int columns) {
  const double* row = table.data() + i.index * columns;
  return Interpolate(row, j, 1) * (1 - i.fraction) + Interpolate(row + columns, j, 1) * i.fraction;
}

/// Trilinear interpolation in a row-major table of rows x `columns` x `layers`.
inline double Interpolate(const std::vector<double>& table, GridCell i, GridCell j, int columns,
                          GridCell k, int layers) {
  const auto line = [&](int row, int column) {
    return Interpolate(table.data() + (row * columns + column) * layers, k, 1);
  };
  const auto plane = [&](int row) {
    return line(row, j.index) * (1 - j.fraction) + line(row, j.index + 1) * j.fraction;
  };
  return plane(i.index) * (1 - i.fraction) + plane(i.index + 1) * i.fraction;
}

}  // namespace skein
