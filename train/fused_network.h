#pragma once

#include <cstdint>
#include <vector>

#include "train/folded_parameters.h"
#include "train/recurrent_network.h"

namespace skein {

/// A recurrent network computed tile by tile without an autograd graph: LibTorch's matrix products,
/// own elementwise kernels, hand-derived gradients. The affine part of each LayerNorm is folded
/// into the map behind it (train/folded_parameters.h), so that it costs nothing per sample. Any
/// depth and width; ReLU alone.
class FusedNetwork : public RecurrentNetwork {
 public:
  /// Throws Error where FusedLimitation (train/backend.h) names one.
  explicit FusedNetwork(const NetworkLayout& layout);

  const NetworkLayout& layout() const override { return layout_; }
  void SetParameters(const float* parameters) override;
  void Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const override;
  /// An accumulator is a gradient by the folded parameters.
  std::int64_t accumulator_size() const override { return folded_layout_.size(); }
  LossSums AccumulateGradient(const SampleTile& tile, const LossSettings& settings,
                              NetworkWorkspace& workspace, float* accumulator) const override;
  void FinishGradient(const float* accumulator, float* gradient) const override;

 private:
  const float* folded(std::int64_t offset) const { return folded_.data() + offset; }

  /// normalise(relu(map(in))) of a hidden layer.
  void HiddenForward(int layer, const float* in, std::int64_t rows,
                     FusedActivations::HiddenRows& out) const;
  void GruForward(int layer, const float* in, const SequenceTile& tile,
                  FusedActivations& activations) const;

  /// Adds the gradient by the folded parameters to `folded_gradient`, given the one by the output,
  /// [steps][batch][output_size]. Uses up what Forward left.
  void Backward(const SequenceTile& tile, const float* output_gradient,
                FusedActivations& activations, float* folded_gradient) const;
  /// Turns the gradient by a hidden layer's output into the one by its map's values, and adds the
  /// bias gradients.
  void HiddenBackward(int layer, const FusedActivations::HiddenRows& out, std::int64_t rows,
                      float* gradient, float* folded_gradient) const;
  /// Back through time: `state_gradient`, by the states of the layer, is used up; gates become
  /// their gradients. Adds all gradients of the layer but that of the input map's weights.
  void GruBackward(int layer, const SequenceTile& tile, FusedActivations& activations,
                   float* state_gradient, float* folded_gradient) const;
  /// Adds the map's weight gradient and writes the gradient by its input, unless `input_gradient`
  /// is null. Rows of `output_gradient` are `stride` floats apart.
  void MapBackward(const FoldedMap& map, const float* in, const float* output_gradient,
                   std::int64_t stride, std::int64_t rows, float* folded_gradient,
                   float* input_gradient) const;

  NetworkLayout layout_;
  FoldedLayout folded_layout_;
  std::vector<float> parameters_;  ///< flat
  AlignedVector<float> folded_;
};

}  // namespace skein
