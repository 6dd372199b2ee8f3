// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "train/network/recurrent_network.h"
#include "train/policy/recurrent_policy.h"
#include "train/ppo/adam.h"
#include "train/ppo/idle_pedals.h"
#include "train/ppo/train_config.h"

namespace skein {

/// A network in training: what computes it, and its parameters with their optimiser.
struct TrainedNetwork {
  const NetworkLayout& layout() const { return network->layout(); }
  /// From now on the network computes with the optimiser's parameters.
  void TakeParameters() { network->SetParameters(optimiser.parameters()); }

  std::unique_ptr<RecurrentNetwork> network;
  AdamOptimiser optimiser;
  std::optional<IdlePedals> idle_pedals;  ///< of an actor, if ppo.pedals is false
};

/// Idles the pedals of an actor's `parameters`, or frees idle ones, as ppo.pedals has it.
void SetPedals(const TrainConfig& config, const NetworkLayout& layout, float* parameters);

/// Both networks of PPO.
struct ActorCritic {
  /// Fresh ones, by `config.seed`. The critic sees `privileged_size` numbers more.
  ActorCritic(const TrainConfig& config, int observation_size, int privileged_size,
              int action_size);

  /// The actor's log standard deviations.
  std::vector<float> LogStd() const;

  BackendChoice backend;
  TrainedNetwork actor, critic;
};

/// The policy that training with `config` has come to: an actor of `shape` with the flat
/// `parameters`.
std::shared_ptr<const RecurrentPolicy::Parameters> PolicyInTraining(const TrainConfig& config,
                                                                    const NetworkShape& shape,
                                                                    std::vector<float> parameters);

}  // namespace skein
