// SPDX-License-Identifier: Apache-2.0
// Rows of memory, one per aircraft, to columns of vectors and back.

#if defined(SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_
#endif

#include "simd/transpose-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// Columns [row_size][kLanes], aligned, of as many rows as a vector has lanes. `row_size` is at
/// least as many.
HWY_INLINE void ColumnsFromRows(const float* rows, int row_size, float* columns) {
  const FloatTag d;
  for (int begin = 0; begin < row_size; begin += kLanes) {
    // The last square overlaps the one before, not the next row.
    const int k = begin + kLanes <= row_size ? begin : row_size - kLanes;
    V square[kLanes];
    for (int i = 0; i < kLanes; ++i) square[i] = hn::LoadU(d, rows + i * row_size + k);
    Transpose(d, square);
    for (int i = 0; i < kLanes; ++i) hn::Store(square[i], d, columns + (k + i) * kLanes);
  }
}

/// The reverse.
HWY_INLINE void RowsFromColumns(const float* columns, int row_size, float* rows) {
  const FloatTag d;
  for (int begin = 0; begin < row_size; begin += kLanes) {
    const int k = begin + kLanes <= row_size ? begin : row_size - kLanes;
    V square[kLanes];
    for (int i = 0; i < kLanes; ++i) square[i] = hn::Load(d, columns + (k + i) * kLanes);
    Transpose(d, square);
    for (int i = 0; i < kLanes; ++i) hn::StoreU(square[i], d, rows + i * row_size + k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_
