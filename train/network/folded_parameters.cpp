// SPDX-License-Identifier: Apache-2.0
#include "train/network/folded_parameters.h"

#include <algorithm>

#include "train/network/folding_kernels.h"
#include "train/network/network_kernels.h"

namespace skein {
namespace {

void UnfoldLinear(const FoldedLinear& linear, const float* parameters, const float* folded_gradient,
                  float* gradient) {
  const int columns = linear.flat_in;
  const bool has_norm = linear.norm_weight >= 0;
  std::vector<double> gamma_gradient(columns, 0.0), beta_gradient(columns, 0.0);
  std::vector<float> gathered(linear.gradient_by_input ? columns : 0);
  UnfoldedRow unfolded;
  unfolded.gamma_gradient = gamma_gradient.data();
  unfolded.beta_gradient = beta_gradient.data();
  if (has_norm) {
    unfolded.gamma = parameters + linear.norm_weight;
    unfolded.beta = parameters + linear.norm_bias;
  }
  for (int row = 0; row < linear.out; ++row) {
    const int flat_row = linear.FlatRow(row);
    if (flat_row < 0) continue;
    const std::int64_t flat = linear.flat_weight + static_cast<std::int64_t>(flat_row) * columns;
    unfolded.weight = parameters + flat;
    unfolded.weight_gradient = gradient + flat;
    unfolded.folded_gradient = folded_gradient + linear.WeightGradient(row, 0);
    if (linear.gradient_by_input) {
      for (int j = 0; j < columns; ++j) {
        gathered[j] = folded_gradient[linear.WeightGradient(row, j)];
      }
      unfolded.folded_gradient = gathered.data();
    }
    unfolded.bias_gradient = folded_gradient[linear.bias + row];
    gradient[linear.flat_bias + flat_row] = unfolded.bias_gradient;
    if (has_norm) {
      UnfoldRow(columns, unfolded);
    } else {
      std::copy_n(unfolded.folded_gradient, columns, unfolded.weight_gradient);
    }
  }
  if (!has_norm) return;
  std::copy_n(gamma_gradient.begin(), columns, gradient + linear.norm_weight);
  std::copy_n(beta_gradient.begin(), columns, gradient + linear.norm_bias);
}

}  // namespace

int FoldedLinear::FlatRow(int row) const {
  const int unit = row % padded_block;
  return unit < block ? order[row / padded_block] * block + unit : -1;
}

void FoldLinear(const FoldedLinear& linear, const float* parameters, float* folded) {
  const bool has_norm = linear.norm_weight >= 0;
  FoldedRows rows;
  rows.stride = linear.in;
  if (has_norm) {
    rows.gamma = parameters + linear.norm_weight;
    rows.beta = parameters + linear.norm_bias;
  }
  for (int first = 0; first < linear.out; first += linear.padded_block) {
    const int flat_row = linear.FlatRow(first);
    const float* const bias = parameters + linear.flat_bias + flat_row;
    rows.weight =
        parameters + linear.flat_weight + static_cast<std::int64_t>(flat_row) * linear.flat_in;
    rows.folded_weight = folded + linear.weight + first * rows.stride;
    rows.bias = folded + linear.bias + first;
    std::fill(std::copy_n(bias, linear.block, rows.bias), rows.bias + linear.padded_block, 0.0f);
    if (has_norm) FoldRows(linear.block, linear.flat_in, rows);
    for (int row = 0; row < linear.block; ++row) {
      float* const to = rows.folded_weight + row * rows.stride;
      if (!has_norm) {
        std::copy_n(rows.weight + static_cast<std::int64_t>(row) * linear.flat_in, linear.flat_in,
                    to);
      }
      std::fill(to + linear.flat_in, to + linear.in, 0.0f);
    }
    std::fill_n(rows.folded_weight + linear.block * rows.stride,
                (linear.padded_block - linear.block) * rows.stride, 0.0f);
  }
}

FoldedLinear FoldedLayout::Place(int in, int padded_in, int blocks, int block, int padded_block) {
  FoldedLinear linear;
  linear.flat_in = in;
  linear.in = padded_in;
  linear.block = block;
  linear.padded_block = padded_block;
  linear.out = blocks * padded_block;
  linear.order = {0, 1, 2};
  linear.weight = size_;
  linear.bias = linear.weight + static_cast<std::int64_t>(linear.out) * linear.in;
  size_ = linear.bias + linear.out;
  return linear;
}

FoldedLayout::FoldedLayout(const NetworkLayout& layout) {
  constexpr int kGates = 3;
  constexpr std::array<int, 3> kNewGateFirst{2, 0, 1};
  const NetworkShape& shape = layout.shape();
  const int gru = shape.gru_size, padded_gru = PaddedWidth(gru);
  for (int i = 0; i <= layout.head(); ++i) {
    const NormalisedLinear& layer = layout.layer(i);
    // The observation is read as it comes, and the output left as the losses read it.
    const int padded_in = i == 0 ? layer.in : PaddedWidth(layer.in);
    FoldedLinear linear;
    if (i == layout.gru_input()) {
      linear = Place(layer.in, padded_in, kGates, gru, padded_gru);
      linear.order = kNewGateFirst;
    } else {
      const int padded_out = i == layout.head() ? layer.out : PaddedWidth(layer.out);
      linear = Place(layer.in, padded_in, 1, layer.out, padded_out);
    }
    linear.flat_weight = layer.weight;
    linear.flat_bias = layer.bias;
    linear.norm_weight = layer.norm_weight;
    linear.norm_bias = layer.norm_bias;
    linear.gradient_by_input = i == 0;
    linear_.push_back(linear);
  }
  for (int i = 0; i < shape.gru_layers; ++i) {
    const GruLayer& layer = layout.gru_layers()[i];
    FoldedGru folded;
    if (i == 0) {
      folded.input = linear_[layout.gru_input()];
    } else {
      folded.input = Place(layer.in, PaddedWidth(layer.in), kGates, gru, padded_gru);
      folded.input.order = kNewGateFirst;
      folded.input.flat_weight = layer.input_weight;
      folded.input.flat_bias = layer.input_bias;
    }
    folded.hidden = Place(gru, padded_gru, kGates, gru, padded_gru);
    folded.hidden.flat_weight = layer.hidden_weight;
    folded.hidden.flat_bias = layer.hidden_bias;
    gru_.push_back(folded);
  }
  if (!shape.gaussian) return;
  outputs_ = shape.output_size;
  flat_log_std_ = layout.log_std();
  log_std_ = size_;
  size_ += outputs_;
}

void FoldedLayout::CopyLogStd(const float* parameters, float* folded) const {
  std::copy_n(parameters + flat_log_std_, outputs_, folded + log_std_);
}

void FoldedLayout::UnfoldGradient(const float* parameters, const float* folded_gradient,
                                  float* gradient) const {
  ForEachLinear([&](const FoldedLinear& linear) {
    UnfoldLinear(linear, parameters, folded_gradient, gradient);
  });
  std::copy_n(folded_gradient + log_std_, outputs_, gradient + flat_log_std_);
}

}  // namespace skein
