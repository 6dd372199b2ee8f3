// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "train/files/tensor_file.h"
#include "train/ppo/adam.h"
#include "train/ppo/popart.h"
#include "train/ppo/rollout.h"
#include "train/ppo/train_config.h"

namespace skein {

/// All that a training run depends on beside its configuration.
struct TrainingState {
  std::vector<float> actor, critic;  ///< flat parameters
  std::vector<float> mean_actor;     ///< MoveAverage's; empty without ppo.average_iterations
  AdamState actor_adam, critic_adam;
  PopArt popart;
  double adapted_learning_rate = 0;  ///< AdaptedLearningRate so far; 0 without ppo.target_kl
  RecurrentState recurrent{0, 0};
  std::vector<std::uint32_t> env;  ///< VecEnv's snapshot, clocks and returns of episodes included
  std::uint64_t iteration = 0;
  std::uint64_t policy_steps = 0;  ///< per aircraft
  double best_success_rate = -1;   ///< of the evaluations so far
};

/// Metadata key of a checkpoint: the SIMD target that it was made on.
inline constexpr const char* kSimdTargetKey = "checkpoint.simd_target";
/// And what its run's records were then, if it is one of a run.
inline constexpr const char* kRecordsKey = "checkpoint.records";

/// Every field of a configuration that training depends on, as text, by the name of its
/// configuration key (`skein train --help-keys`).
std::map<std::string, std::string> DescribeConfig(const TrainConfig& config);

/// Writes a checkpoint: configuration, state, and the actor, or its mean if there is one, as a
/// policy that RecurrentPolicy::Load reads.
TensorFile StoreCheckpoint(const TrainConfig& config, const NetworkLayout& actor,
                           const TrainingState& state);

/// Throws Error, naming `path`, if the file is no checkpoint, was made with another configuration
/// (naming the first field that differs) or low-level policy, or holds values of another size (of
/// `env`, VecEnv itself says).
TrainingState LoadCheckpoint(TensorFile file, const std::string& path, const TrainConfig& config,
                             const NetworkLayout& actor, const NetworkLayout& critic);

/// What another training begins with.
struct StartingNetworks {
  std::vector<float> actor;   ///< flat parameters
  std::vector<float> critic;  ///< of the same training; empty if the file has none that serves
  PopArt popart;              ///< what the critic's output stands for
};

/// The networks in the policy file or checkpoint `path` for a training by `config`. A critic of
/// scaled values does not serve one that does not scale them (ppo.popart), nor does one of other
/// sizes, which sees more or less (ppo.privileged_critic). Throws Error, naming
/// `path`, if the file is damaged or its policy has other sizes or was made for another task or
/// environment.
StartingNetworks LoadNetworks(const std::string& path, const TrainConfig& config,
                              const NetworkLayout& actor, const NetworkLayout& critic);

/// FNV-1a over every value of the state.
std::uint64_t Hash(const TrainingState& state);

}  // namespace skein
