#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "train/ppo_loss.h"
#include "train/tiled_network.h"

namespace skein {

/// A tile of chunks with what the losses need, gathered from a rollout; time-major rows.
struct SampleTile {
  SequenceTile sequence;
  ActorSamples actor;             ///< set for actors
  const float* target = nullptr;  ///< set for critics, in the scale of the network's output
  const float* old_value = nullptr;
};

/// Gradient of the PPO loss of one network, tile by tile. An actor is a network whose shape is
/// gaussian. Tiles are added up in an accumulator of the implementation's own form (sums of
/// accumulators are accumulators), which Finish turns into the gradient by the flat parameters.
class NetworkGradient {
 public:
  virtual ~NetworkGradient() = default;

  virtual void SetParameters(const float* parameters) = 0;
  virtual std::int64_t accumulator_size() const = 0;
  /// May run on several threads at once, one per `worker`.
  virtual LossSums Accumulate(const SampleTile& tile, const LossSettings& settings, int worker,
                              float* accumulator) = 0;
  virtual void Finish(const float* accumulator, float* gradient) const = 0;
};

/// The implementations: "tiled" (TiledNetwork), and "autograd" (LibTorch's autograd, the reference
/// that the other is tested against). Throws Error on another name.
std::unique_ptr<NetworkGradient> MakeNetworkGradient(const std::string& backend,
                                                     const NetworkLayout& layout, int workers);

}  // namespace skein
