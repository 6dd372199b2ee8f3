#pragma once

#include <array>
#include <cstdint>

#include "train/aligned_vector.h"
#include "train/network.h"

namespace skein {

/// A tile of sequences, time-major: row (step * batch + i) belongs to sequence i.
struct SequenceTile {
  int steps = 0, batch = 0;
  const float* observation = nullptr;    ///< [steps][batch][observation_size]
  const float* initial_state = nullptr;  ///< [batch][gru_size]
  /// [steps][batch]: 0 where an episode begins at that step, so that the state is zero there;
  /// else 1.
  const float* keep = nullptr;

  std::int64_t rows() const { return static_cast<std::int64_t>(steps) * batch; }
};

/// Activations of one tile: what Forward leaves for Backward. One per worker.
class NetworkWorkspace {
 public:
  /// Grows to hold a tile of `steps` x `batch`; contents are lost.
  void Reserve(const NetworkShape& shape, int steps, int batch);

  /// [steps][batch][output_size], before any tanh.
  const float* output() const { return output_.data(); }
  /// [steps][batch][gru_size], the state after each step.
  const float* state() const { return state_.data(); }

 private:
  friend class TiledNetwork;

  /// A LayerNorm behind a ReLU: its output and what its gradient needs, one row per sample.
  struct HiddenRows {
    AlignedVector<float> normalised, inverse_std, zero_level;
  };

  AlignedVector<float> observation_;  ///< normalised
  std::array<HiddenRows, 4> hidden_;  ///< layers first, second, third, fourth
  AlignedVector<float> gates_, hidden_product_, previous_state_, state_;
  AlignedVector<float> normalised_state_, state_inverse_std_;
  AlignedVector<float> output_;
  std::array<AlignedVector<float>, 2> gradient_;
};

/// A recurrent network computed tile by tile without an autograd graph: LibTorch's matrix products,
/// own elementwise kernels, hand-derived gradients. The affine part of each LayerNorm is folded
/// into the map behind it (W' = W diag(gamma), b' = b + W beta), so that it costs nothing per
/// sample. Const functions may run on several threads at once, each with its own workspace.
class TiledNetwork {
 public:
  explicit TiledNetwork(const NetworkLayout& layout);

  const NetworkLayout& layout() const { return layout_; }

  /// Folds a flat parameter vector of layout().size() floats; Forward and Backward use it from then
  /// on.
  void SetParameters(const float* parameters);

  void Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const;

  /// Adds the gradient by the folded parameters to `folded_gradient` (folded_size() floats), given
  /// the gradient by the output, [steps][batch][output_size]. Uses up what Forward left.
  void Backward(const SequenceTile& tile, const float* output_gradient, NetworkWorkspace& workspace,
                float* folded_gradient) const;

  std::int64_t folded_size() const { return folded_size_; }
  /// Where gradients by log_std are added in a folded gradient (Backward leaves it alone).
  std::int64_t folded_log_std() const { return folded_log_std_; }
  /// The gradient by the flat parameters from the one by the folded parameters, which is linear in
  /// it: the sum over tiles may be unfolded at once.
  void UnfoldGradient(const float* parameters, const float* folded_gradient, float* gradient) const;

 private:
  struct FoldedMap {
    std::int64_t weight = 0, bias = 0;
  };

  /// Row of the flat weight that is row `row` of the folded one: the GRU's gates are folded in the
  /// order n, r, z, so that a row of gate gradients [n | r | z | q] is contiguous for both
  /// products.
  int FlatRow(int layer, int row) const;
  void HiddenForward(int layer, const float* in, std::int64_t rows,
                     NetworkWorkspace::HiddenRows& out) const;
  /// Adds the map's gradients and writes the gradient by its input, unless `input_gradient` is
  /// null.
  void MapBackward(int layer, const float* in, const float* output_gradient, std::int64_t rows,
                   float* folded_gradient, float* input_gradient) const;

  NetworkLayout layout_;
  std::array<FoldedMap, kNumLayers> folded_;
  FoldedMap folded_gru_;  ///< gates r, z, n
  std::int64_t folded_log_std_ = 0, folded_size_ = 0;
  AlignedVector<float> parameters_;
};

}  // namespace skein
