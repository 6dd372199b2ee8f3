// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "train/network/network.h"

namespace skein {

/// One linear layer of a network as FusedNetwork computes it: row-major [out][in] with both widths
/// padded by zeros, and with the affine part of the LayerNorm before it, if there is one, folded
/// in: W' = W diag(gamma), b' = b + W beta.
struct FoldedLinear {
  int in = 0, out = 0;  ///< padded
  std::int64_t weight = 0, bias = 0;
  /// The weight's gradient lies [in][out]: `in` is not padded, and would leave lanes of a product's
  /// columns empty.
  bool gradient_by_input = false;

  // What it is folded from.
  int flat_in = 0;
  int block = 0, padded_block = 0;  ///< rows of a gate of the GRU, else all rows
  std::array<int, 3> order{};       ///< the flat vector's block that is the folded one's
  std::int64_t flat_weight = 0, flat_bias = 0;
  std::int64_t norm_weight = -1, norm_bias = -1;  ///< -1: no LayerNorm before it

  /// The flat row that is the folded one's `row`; -1 for padding.
  int FlatRow(int row) const;
  /// Where a folded gradient has the one with respect to the weight from input `j` to output `row`.
  std::int64_t WeightGradient(int row, int j) const {
    return weight + (gradient_by_input ? std::int64_t{j} * out + row : std::int64_t{row} * in + j);
  }
};

/// Writes the layer's part of a folded vector, from a network's flat one.
void FoldLinear(const FoldedLinear& linear, const float* parameters, float* folded);

/// The linear layers of one GRU layer. Gates of the input layer are in the order n, r, z, of the
/// hidden layer r, z, n, so that a row of gate gradients [n | r | z | q] is contiguous for both
/// products.
struct FoldedGru {
  FoldedLinear input, hidden;
};

/// Where the parts of a network lie in a folded vector: its parameters as the kernels read them, or
/// a gradient with respect to those.
class FoldedLayout {
 public:
  explicit FoldedLayout(const NetworkLayout& layout);

  std::int64_t size() const { return size_; }
  /// By the index of NetworkLayout::layer; the one at gru_input() is gru(0).input.
  const FoldedLinear& linear(int layer) const { return linear_[layer]; }
  const FoldedGru& gru(int layer) const { return gru_[layer]; }
  std::int64_t log_std() const { return log_std_; }

  /// Every linear layer once.
  template <typename Visit>
  void ForEachLinear(const Visit& visit) const {
    for (const FoldedLinear& linear : linear_) visit(linear);
    for (std::size_t i = 0; i < gru_.size(); ++i) {
      if (i > 0) visit(gru_[i].input);  // the first one's is among linear_
      visit(gru_[i].hidden);
    }
  }

  /// Copies the log standard deviations, which belong to no layer, from a network's flat vector.
  void CopyLogStd(const float* parameters, float* folded) const;
  /// The gradient with respect to the flat parameters from the one with respect to the folded
  /// ones, which is linear in it: the sum over tiles may be unfolded at once. With G the gradient
  /// with respect to W' and g with respect to b', dW = G diag(gamma) + g beta^T, dgamma = column
  /// sums of W o G, dbeta = W^T g.
  void UnfoldGradient(const float* parameters, const float* folded_gradient, float* gradient) const;

 private:
  /// Places a layer of `blocks` blocks of rows.
  FoldedLinear Place(int in, int padded_in, int blocks, int block, int padded_block);

  std::vector<FoldedLinear> linear_;
  std::vector<FoldedGru> gru_;
  int outputs_ = 0;  ///< that have a log_std
  std::int64_t log_std_ = 0, flat_log_std_ = 0, size_ = 0;
};

}  // namespace skein
