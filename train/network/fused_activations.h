// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "simd/matrix_product.h"
#include "train/network/network.h"

namespace skein {

/// Floats between rows of gates: four gates, and a cache line so that rows do not all fall into the
/// same sets of the cache.
constexpr std::int64_t GateStride(int padded_gru) { return 4 * padded_gru + 16; }

/// What FusedNetwork's forward pass of a tile leaves for its backward pass. One row per sample,
/// time-major, RowStride apart (train/network/network_kernels.h).
struct FusedActivations {
  /// A LayerNorm behind a ReLU: its output and what its gradient needs.
  struct HiddenRows {
    AlignedVector<float> normalised, inverse_std, zero_level;
  };
  struct GruRows {
    AlignedVector<float> gates;  ///< [n | r | z | q], GateStride apart
    /// Before each step, zero where an episode begins; behind them those after the last step.
    AlignedVector<float> states;
    AlignedVector<float> outputs;  ///< states after each step, if another GRU layer reads them
  };

  /// Grows to hold a tile of `steps` x `batch`; contents are lost.
  void Reserve(const NetworkShape& shape, int steps, int batch);

  AlignedVector<float> observation;  ///< normalised, not padded
  std::vector<HiddenRows> hidden;    ///< before the GRU, then behind it
  std::vector<GruRows> gru;
  AlignedVector<float> normalised_state, state_inverse_std;
  AlignedVector<float> output_gradient;
  std::array<AlignedVector<float>, 2> state_gradient;  ///< of the states of two GRU layers
  std::array<AlignedVector<float>, 2> block_gradient;  ///< of two hidden layers, of a few rows
  AlignedVector<float> gate_sums;                      ///< of gate gradients over the rows
  simd::ProductWorkspace products;
};

}  // namespace skein
