#pragma once

#include <memory>
#include <vector>

#include "train/network_gradient.h"

namespace skein {

/// NetworkGradient by LibTorch's autograd in float32.
std::unique_ptr<NetworkGradient> MakeAutogradGradient(const NetworkLayout& layout);

/// Loss of one tile and its gradient by the flat parameters, in float64 throughout, written from
/// the formulas of the network and the losses with differentiable operations alone.
struct ReferenceGradient {
  double loss = 0;  ///< policy loss less the entropy bonus, or value_coefficient x value loss
  LossSums sums;
  std::vector<double> gradient;
  std::vector<double> output;  ///< [steps][batch][output_size], before tanh
  std::vector<double> state;   ///< [batch][gru_size], after the last step
};
ReferenceGradient ComputeReferenceGradient(const NetworkLayout& layout,
                                           const std::vector<float>& parameters,
                                           const SampleTile& tile, const LossSettings& settings);

}  // namespace skein
