// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "train/network/recurrent_network.h"

namespace skein {

/// A recurrent network by LibTorch's operations, gradients by its autograd, in float32: the
/// reference, and what computes shapes and activations that the fused kernels do not know.
class LibTorchNetwork : public RecurrentNetwork {
 public:
  explicit LibTorchNetwork(const NetworkLayout& layout);

  const NetworkLayout& layout() const override { return layout_; }
  void SetParameters(const float* parameters) override;
  void Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const override;
  /// An accumulator is a gradient with respect to the flat parameters.
  std::int64_t accumulator_size() const override { return layout_.size(); }
  LossSums AccumulateGradient(const SampleTile& tile, const LossSettings& settings,
                              NetworkWorkspace& workspace, float* accumulator) const override;
  void FinishGradient(const float* parameters, const float* accumulator,
                      float* gradient) const override;

 private:
  NetworkLayout layout_;
  std::vector<float> parameters_;
};

/// Loss of one tile and its gradient with respect to the flat parameters, in float64 throughout,
/// written from the formulas of the network and the losses with differentiable operations alone.
struct ReferenceGradient {
  /// Policy loss less the entropy bonus plus the penalty on action changes, or value_coefficient
  /// x value loss.
  double loss = 0;
  LossSums sums;
  std::vector<double> gradient;
  std::vector<double> output;  ///< [steps][batch][output_size], before tanh
  std::vector<double> state;   ///< [batch][gru_layers][gru_size], after the last step
};
ReferenceGradient ComputeReferenceGradient(const NetworkLayout& layout,
                                           const std::vector<float>& parameters,
                                           const SampleTile& tile, const LossSettings& settings);

}  // namespace skein
