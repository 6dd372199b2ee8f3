// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "base/aligned_vector.h"
#include "train/network/backend.h"
#include "train/network/fused_activations.h"
#include "train/network/linear_layer.h"
#include "train/network/network.h"
#include "train/network/ppo_loss.h"
#include "train/network/sample_tile.h"

namespace skein {

/// What a network leaves of a tile, and the memory it needs in between. One per thread; serves
/// networks of any shape one after the other.
class NetworkWorkspace {
 public:
  /// [steps][batch][output_size], before any tanh.
  const float* output() const { return output_.data(); }
  /// [batch][gru_layers][gru_size], the state after the last step.
  const float* final_state() const { return final_state_.data(); }

 private:
  friend class FusedNetwork;
  friend class LibTorchNetwork;

  AlignedVector<float> output_, final_state_;
  FusedActivations fused_;
};

/// A recurrent network (NetworkShape) that computes tiles of sequences forward, and the gradient of
/// the PPO loss with respect to its parameters. An actor is a network whose shape is gaussian.
/// Const functions may run on several threads at once, each with its own workspace; each computes
/// on its calling thread alone.
class RecurrentNetwork {
 public:
  virtual ~RecurrentNetwork() = default;

  virtual const NetworkLayout& layout() const = 0;
  /// Copies what it needs of a flat vector of layout().size() floats.
  virtual void SetParameters(const float* parameters) = 0;

  /// Leaves output and final state in the workspace.
  virtual void Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const = 0;

  /// Tiles are added up in an accumulator of the implementation's own form (sums of accumulators
  /// are accumulators), which FinishGradient turns into the gradient with respect to the flat
  /// parameters. `parameters` must be those of the last SetParameters, of which the tiles were
  /// computed.
  virtual std::int64_t accumulator_size() const = 0;
  /// Adds the gradient of the tile's loss, and returns its losses.
  virtual LossSums AccumulateGradient(const SampleTile& tile, const LossSettings& settings,
                                      NetworkWorkspace& workspace, float* accumulator) const = 0;
  virtual void FinishGradient(const float* parameters, const float* accumulator,
                              float* gradient) const = 0;
};

/// Throws Error if `backend` cannot compute the shape; ChooseBackend (train/network/backend.h) asks
/// first; or if LibTorch's module is not there. LibTorch takes no notice of the precision.
std::unique_ptr<RecurrentNetwork> MakeNetwork(Backend backend, const NetworkLayout& layout,
                                              const NetworkPrecision& precision = {});

}  // namespace skein
