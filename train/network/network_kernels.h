// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein {

/// What LayerNorm adds to the variance.
inline constexpr float kLayerNormEpsilon = 1e-5f;

/// Rows of a tile are whole vectors of every SIMD target: widths are rounded up to this.
inline constexpr int kWidthGranularity = 16;
constexpr int PaddedWidth(int width) {
  return (width + kWidthGranularity - 1) / kWidthGranularity * kWidthGranularity;
}
/// Floats between rows of `width` values: a cache line more than the padded width, since rows a
/// power of two apart would all fall into the same few sets of the cache.
constexpr std::int64_t RowStride(int width) { return PaddedWidth(width) + 16; }

// The elementwise parts of a recurrent network, forward and backward, over row-major tiles; the
// products between them are simd/matrix_product.h's. Unless said otherwise rows lie
// RowStride(columns) floats apart, and what is behind the columns is zero before and after.
// "Normalise" is LayerNorm without its affine part: (x - mean) / sqrt(variance + epsilon) of each
// row; the affine part is folded into the linear layer that follows
// (train/network/folded_parameters.h). Not-a-number in an input shows in the output.

/// Rows of `in` are `columns` floats apart; what is behind the columns of `out` is left alone.
void NormaliseRows(std::int64_t rows, int columns, const float* in, float* out);

/// values = normalise(relu(values)). `inverse_std` and `zero_level` get one value per row:
/// 1 / sqrt(variance + epsilon), and what a zero before the normalisation became, so that a ReLU
/// was active just where values > zero_level.
void ReluNormalise(std::int64_t rows, int columns, float* values, float* inverse_std,
                   float* zero_level);

/// `gradient` with respect to the normalised values becomes the one with respect to the values
/// before the ReLU; its column sums are added to `bias_gradient`.
void ReluNormaliseBackward(std::int64_t rows, int columns, const float* normalised,
                           const float* inverse_std, const float* zero_level, float* gradient,
                           float* bias_gradient);

/// out = normalise(in), with 1 / sqrt(variance + epsilon) of each row.
void NormaliseWithStd(std::int64_t rows, int columns, const float* in, float* out,
                      float* inverse_std);

/// `gradient` with respect to the normalised values becomes the one with respect to the values
/// before normalisation.
void NormaliseBackward(std::int64_t rows, int columns, const float* normalised,
                       const float* inverse_std, float* gradient);

/// values[row] *= not_done[row]. Rows with a factor of one are not touched.
void MaskRows(std::int64_t rows, int columns, const float* not_done, float* values);

/// One step of a GRU (Cho et al. 2014, in the form of cuDNN and LibTorch: the reset gate acts on
/// the hidden product of the new gate). `size` is a padded width: a unit without weights, bias and
/// state stays exactly zero. `gates` rows of `stride` floats hold [n | r | z | q], each `size`
/// wide: on entry in r and z the sums of both products and biases, in n those of the input, in q
/// those of the state; on return the activations, and q as it was. next = (1 - z) n + z previous.
void GruStep(std::int64_t rows, int size, const float* previous, float* gates, std::int64_t stride,
             float* next);

/// What comes back to a GRU's states from the step behind: not_done[row] * gradient[row], with
/// `gradient` with respect to that step's previous states. Nothing if null.
struct LaterStep {
  const float* gradient = nullptr;
  const float* not_done = nullptr;
};

/// Back through GruStep: `gates` become the gradients with respect to [n | r | z | q] before
/// activation, whose column sums are added to `gate_sums`; `state_gradient`, which with what comes
/// from the step behind is the one with respect to next, becomes the direct part of the one with
/// respect to previous, z times it.
void GruStepBackward(std::int64_t rows, int size, const float* previous, float* gates,
                     std::int64_t stride, const LaterStep& later, float* state_gradient,
                     float* gate_sums);

/// sums[j] += sum over rows of in[row][j]. Any number of columns, rows `stride` floats apart.
void AddColumnSums(std::int64_t rows, int columns, const float* in, std::int64_t stride,
                   float* sums);

}  // namespace skein
