// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "bench/seconds_of.h"
#include "train/network/fused_activations.h"
#include "train/network/linear_layer.h"
#include "train/network/ppo_loss.h"

namespace skein::bench {

/// Parts of what a network does with a tile of samples.
enum class TilePart {
  kObservation,        ///< its LayerNorm
  kHiddenForward,      ///< products
  kHiddenNormalise,    ///< ReLU and LayerNorm
  kGateInputForward,   ///< products of the GRU's input
  kGateStateForward,   ///< products of its state, step by step
  kState,              ///< states zeroed where episodes begin, the last ones handed on
  kGates,              ///< sigmoids and tanh
  kStateNormalise,     ///< LayerNorm of the state
  kHead,               ///< products forward and backward
  kLoss,               ///< gradient with respect to the output
  kHiddenToInput,      ///< products backward with respect to the input
  kHiddenToWeight,     ///< and to the weight
  kNormaliseBackward,  ///< ReLU, LayerNorm, bias
  kGatesBackward,      ///< of the sigmoids and tanh, bias
  kGateStateToInput,   ///< products with respect to the state before, step by step
  kGateStateToWeight,  ///< and to its weight
  kGateInputToInput,   ///< products with respect to the GRU's input
  kGateInputToWeight,  ///< and to its weight
  kCount,
};

/// What the part does, for people.
const char* Name(TilePart part);

/// Computes a tile of one network, an actor of the default settings, as FusedNetwork does: the same
/// calls in the same order on memory laid out alike, but with a clock between any two parts. Output
/// and gradient are the network's bit for bit, which bench_tile checks.
class TileReplay {
 public:
  using Seconds = std::array<double, static_cast<std::size_t>(TilePart::kCount)>;

  TileReplay(const NetworkPrecision& precision, int steps, int batch);

  const NetworkLayout& layout() const { return layout_; }
  const SampleTile& tile() const { return tile_; }
  const LossSettings& settings() const { return settings_; }
  const std::vector<float>& parameters() const { return parameters_; }
  /// Of the last run.
  const AlignedVector<float>& output() const { return output_; }
  /// With respect to the folded parameters, the sum over all runs backward.
  const AlignedVector<float>& gradient() const { return gradient_; }

  /// What each part took, forward alone or backward, too.
  Seconds Run(bool backward);
  /// Floating-point operations of the part's products in a tile, a multiply-add is two; zero if it
  /// has none.
  double Flops(TilePart part) const;

 private:
  template <typename Call>
  void Time(TilePart part, const Call& call) {
    seconds_[static_cast<std::size_t>(part)] += SecondsOf(call);
  }

  const float* InputOf(int hidden) const;
  void FetchRows(const float* rows, std::int64_t first, std::int64_t count, std::int64_t stride);
  void FetchForward(std::int64_t kept, std::int64_t count);
  void HiddenForward(int index, std::int64_t first, std::int64_t count);
  void StateForward(int step, std::int64_t first, std::int64_t count, std::int64_t kept);
  void RowsForward(int step, std::int64_t first, std::int64_t count, std::int64_t kept);
  void Forward(bool keeps);
  void HiddenBackward(int index, float* input_gradient, std::int64_t first, std::int64_t count,
                      float* gradient);
  void StepBackward(int step);
  void BackwardBehindGru();
  void Backward();

  NetworkLayout layout_;
  FoldedLayout folded_layout_;
  std::vector<LinearLayer> hidden_;
  LinearLayer gate_input_, gate_state_, head_;
  std::vector<float> parameters_;
  AlignedVector<float> folded_, gate_bias_, gradient_, output_, final_state_;
  FusedActivations activations_;
  AlignedVector<float> observation_, initial_state_, action_, advantage_, not_done_, log_prob_;
  SampleTile tile_;
  LossSettings settings_;
  Seconds seconds_{};
};

}  // namespace skein::bench
