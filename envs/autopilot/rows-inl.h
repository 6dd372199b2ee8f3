// SPDX-License-Identifier: Apache-2.0
// Rows of memory, one per aircraft, to columns of vectors and back.

#if defined(SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_
#endif

#include "simd/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Columns [row_size][Lanes(d)], aligned, of as many rows as a vector has lanes. `row_size` is at
/// least as many.
template <class D>
HWY_INLINE void ColumnsFromRows(D d, const float* rows, int row_size, float* columns) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int begin = 0; begin < row_size; begin += lanes) {
    // The last square overlaps the one before, not the next row.
    const int k = begin + lanes <= row_size ? begin : row_size - lanes;
    hn::Vec<D> square[HWY_LANES(float)];
    for (int i = 0; i < lanes; ++i) square[i] = hn::LoadU(d, rows + i * row_size + k);
    Transpose(d, square);
    for (int i = 0; i < lanes; ++i) hn::Store(square[i], d, columns + (k + i) * lanes);
  }
}

/// The reverse.
template <class D>
HWY_INLINE void RowsFromColumns(D d, const float* columns, int row_size, float* rows) {
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int begin = 0; begin < row_size; begin += lanes) {
    const int k = begin + lanes <= row_size ? begin : row_size - lanes;
    hn::Vec<D> square[HWY_LANES(float)];
    for (int i = 0; i < lanes; ++i) square[i] = hn::Load(d, columns + (k + i) * lanes);
    Transpose(d, square);
    for (int i = 0; i < lanes; ++i) hn::StoreU(square[i], d, rows + i * row_size + k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_ROWS_INL_H_
