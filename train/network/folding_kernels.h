// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein {

/// What FoldRows reads and writes; no alignment is needed.
struct FoldedRows {
  const float* weight = nullptr;   ///< [count][columns]
  const float* gamma = nullptr;    ///< [columns]
  const float* beta = nullptr;     ///< [columns]
  float* folded_weight = nullptr;  ///< [count][stride], of which `columns` are written
  std::int64_t stride = 0;
  float* bias = nullptr;  ///< [count]
};

/// Folds a LayerNorm into `count` rows of the layer behind it
/// (train/network/folded_parameters.h): folded_weight = weight diag(gamma); adds weight beta to
/// the bias, along the columns in float64. Rounds alike on every target.
void FoldRows(int count, int columns, const FoldedRows& rows);

/// What UnfoldRow reads and writes, [columns] each; no alignment is needed.
struct UnfoldedRow {
  const float* gamma = nullptr;
  const float* beta = nullptr;
  const float* weight = nullptr;
  const float* folded_gradient = nullptr;
  float bias_gradient = 0;
  float* weight_gradient = nullptr;
  double* gamma_gradient = nullptr;
  double* beta_gradient = nullptr;
};

/// Unfolds one row W of a layer with a LayerNorm folded in (train/network/folded_parameters.h).
/// With G and g the gradients with respect to its folded weights and its bias, weight_gradient =
/// G gamma + g beta; adds W G to gamma_gradient and W g to beta_gradient. Rounds alike on every
/// target.
void UnfoldRow(int columns, const UnfoldedRow& row);

}  // namespace skein
