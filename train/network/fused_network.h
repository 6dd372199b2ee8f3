// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "train/network/folded_parameters.h"
#include "train/network/linear_layer.h"
#include "train/network/recurrent_network.h"

namespace skein {

/// A recurrent network computed tile by tile without an autograd graph, by custom GEMM and
/// elementwise kernels and hand-derived gradients. A layer goes through its product and what
/// follows it a few rows at a time, which stay in the innermost caches. The affine part of each
/// LayerNorm is folded into the linear layer behind it (train/network/folded_parameters.h), so that
/// it costs nothing per sample. Any depth and width; ReLU alone.
class FusedNetwork : public RecurrentNetwork {
 public:
  /// Rows that go through all layers together: their values stay in the first two levels of the
  /// cache, while the layers' weights are read once for all of them.
  static constexpr std::int64_t kForwardRows = 48;
  /// Rows that go back through a layer together: the weight's gradient is read and written once for
  /// all of them, too.
  static constexpr std::int64_t kLayerRows = 96;

  /// Throws Error where FusedLimitation (train/network/backend.h) names one.
  explicit FusedNetwork(const NetworkLayout& layout, const NetworkPrecision& precision = {});

  const NetworkLayout& layout() const override { return layout_; }
  void SetParameters(const float* parameters) override;
  void Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const override;
  /// An accumulator is a gradient with respect to the folded parameters.
  std::int64_t accumulator_size() const override { return folded_layout_.size(); }
  LossSums AccumulateGradient(const SampleTile& tile, const LossSettings& settings,
                              NetworkWorkspace& workspace, float* accumulator) const override;
  void FinishGradient(const float* parameters, const float* accumulator,
                      float* gradient) const override;

 private:
  struct Gru {
    LinearLayer input, hidden;
    AlignedVector<float> gate_bias;  ///< of n, r, z: the hidden layer's added for r and z
  };

  const float* folded(std::int64_t offset) const { return folded_.data() + offset; }
  /// What the hidden layer `index` (or the head, one behind the last) and a GRU layer read.
  const float* InputOf(int index, const FusedActivations& activations) const;
  const float* GruInputOf(int layer, const FusedActivations& activations) const;

  /// Rows of one step of a tile, `count` from `sequence` on, whose activations are kept from the
  /// row `kept` on.
  struct TileRows {
    int step;
    std::int64_t sequence, count, kept;
  };

  /// Keeps the activations of all rows if there is more than one step, or `keeps_all`; else those
  /// of a few rows follow each other in the same memory, which stays in the cache.
  void Forward(const SequenceTile& tile, NetworkWorkspace& workspace, bool keeps_all) const;
  /// The same for a tile whose steps have few rows: those of several steps go together but in the
  /// GRU.
  void ForwardByLayers(const SequenceTile& tile, NetworkWorkspace& workspace) const;

  /// What lies before the GRU and its input products, and what lies behind it, for `count` rows
  /// from `row` on, whose activations are kept from the row `kept` on.
  void RowsToGru(const SequenceTile& tile, std::int64_t row, std::int64_t count, std::int64_t kept,
                 NetworkWorkspace& workspace) const;
  void RowsFromGru(std::int64_t row, std::int64_t count, std::int64_t kept,
                   NetworkWorkspace& workspace) const;
  /// The GRU and the LayerNorm of its states, which the next step masks. What is `kept` of the step
  /// before must lie `tile.batch` rows before it.
  void RowsThroughGru(const SequenceTile& tile, const TileRows& tile_rows,
                      NetworkWorkspace& workspace) const;
  /// The next products fetch where these keep the activations of `count` rows from `row` on; or
  /// what those rows begin with, if there are any.
  void FetchToGru(std::int64_t row, std::int64_t count, FusedActivations& activations) const;
  void FetchFromGru(const SequenceTile& tile, std::int64_t row, std::int64_t count,
                    FusedActivations& activations) const;
  void FetchNext(const SequenceTile& tile, std::int64_t row, std::int64_t count,
                 FusedActivations& activations) const;
  /// normalise(relu(linear(in))) of the rows [first, first + count).
  void HiddenForward(int index, std::int64_t first, std::int64_t count,
                     FusedActivations& activations) const;
  /// Input products of a GRU's gates, of the rows [first, first + count).
  void GatesForward(int layer, std::int64_t first, std::int64_t count,
                    FusedActivations& activations) const;
  void GruForward(int layer, const SequenceTile& tile, const TileRows& tile_rows,
                  NetworkWorkspace& workspace) const;

  /// Adds the gradient with respect to the folded parameters to `folded_gradient`, given the one
  /// with respect to the output, [steps][batch][output_size]. Uses up what Forward left.
  void Backward(const SequenceTile& tile, const float* output_gradient,
                FusedActivations& activations, float* folded_gradient) const;
  /// For the rows [first, first + count): turns `gradient`, with respect to the layer's output,
  /// into the one with respect to its linear values, adds that of its parameters, and writes the
  /// one with respect to its input unless that is null.
  void HiddenBackward(int index, float* input_gradient, std::int64_t first, std::int64_t count,
                      FusedActivations& activations, float* gradient, float* folded_gradient) const;
  /// Back through time: `state_gradient`, with respect to the states after each step, is used up;
  /// gates become their gradients. Adds the gradients of the biases.
  void GruBackward(int layer, const SequenceTile& tile, FusedActivations& activations,
                   float* state_gradient, float* folded_gradient) const;

  NetworkLayout layout_;
  FoldedLayout folded_layout_;
  std::vector<LinearLayer> hidden_;  ///< before the GRU, then behind it
  std::vector<Gru> gru_;
  LinearLayer head_;
  AlignedVector<float> folded_;
};

}  // namespace skein
