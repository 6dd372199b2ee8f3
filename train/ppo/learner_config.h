// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "envs/env_config.h"
#include "envs/policy.h"

namespace skein {

/// What a hidden layer applies to its linear map.
enum class Activation { kRelu, kTanh, kElu, kSilu };

/// Names in configurations and files.
inline constexpr std::array<std::pair<Activation, const char*>, 4> kActivationNames{
    {{Activation::kRelu, "relu"},
     {Activation::kTanh, "tanh"},
     {Activation::kElu, "elu"},
     {Activation::kSilu, "silu"}}};
const char* Name(Activation activation);

/// Largest networks.
inline constexpr int kMaxHiddenLayers = 8, kMaxGruLayers = 8, kMaxWidth = 1024;

/// Shape of the recurrent actor and critic: LayerNorm on the observation; `hidden_layers` of
/// Linear, activation, LayerNorm; `gru_layers` of a GRU; LayerNorm; as many hidden layers again;
/// linear head.
struct NetworkConfig {
  int hidden_layers = 2;  ///< before the GRU, and as many behind it
  int hidden_size = 128;
  int gru_layers = 1;  ///< each reads the state of the one before it
  int gru_size = 128;
  Activation activation = Activation::kRelu;
  bool tanh_mean = true;  ///< the Gaussian's mean goes through tanh
  double initial_log_std = 0;
  double actor_head_scale = 0.01;
};

struct PpoConfig {
  int num_aircraft = 1536;
  int rollout_steps = 64;  ///< policy steps per aircraft and iteration
  int chunk_length = 8;    ///< truncated backpropagation through time
  int epochs = 2;
  int minibatches = 16;
  double learning_rate = 1e-3;
  double final_learning_rate_fraction =
      0.02;  ///< linear in steps done to this fraction at the budget's end; 1 keeps it constant
  double adam_epsilon = 1e-5;
  double gamma = 0.99;  ///< per policy step
  double gae_lambda = 0.95;
  double clip = 0.2;
  double max_gradient_norm = 2;  ///< actor and critic separately
  double entropy_coefficient = 1e-3;
  double value_coefficient = 1;
  bool clip_value_loss = false;
  bool normalise_advantages = true;
  bool popart = true;        ///< false: value targets unscaled, as in the paper
  double popart_rate = 0.1;  ///< moving average of the value targets' moments
};

/// Throws Error on values that do not go together: a rollout is a whole number of chunks per
/// aircraft, and every minibatch has a chunk.
void Validate(const PpoConfig& config);

/// What computes the networks, forward and backward.
enum class Backend {
  kFused,     ///< own kernels, tile by tile
  kLibTorch,  ///< LibTorch's operations and autograd: the reference, two to three times slower
};

/// Names in configurations and files.
inline constexpr std::array<std::pair<Backend, const char*>, 2> kBackendNames{
    {{Backend::kFused, "fused"}, {Backend::kLibTorch, "libtorch"}}};
const char* Name(Backend backend);

/// Of the operands of a network's products; sums and all the rest are float32.
enum class LearnerPrecision {
  kAuto,  ///< kFast where the processor multiplies bfloat16 itself, else kFloat32
  kFloat32,
  kMixed,     ///< forward float32, backward bfloat16
  kBfloat16,  ///< both bfloat16
  kFast,      ///< actor kMixed, critic kBfloat16
};

/// Names in configurations and files.
inline constexpr std::array<std::pair<LearnerPrecision, const char*>, 5> kPrecisionNames{
    {{LearnerPrecision::kAuto, "auto"},
     {LearnerPrecision::kFloat32, "fp32"},
     {LearnerPrecision::kMixed, "mixed"},
     {LearnerPrecision::kBfloat16, "bf16"},
     {LearnerPrecision::kFast, "fast"}}};
const char* Name(LearnerPrecision precision);

struct LearnerConfig {
  /// As asked for; ChooseBackend (train/network/backend.h) says what runs.
  Backend backend = Backend::kFused;
  LearnerPrecision precision = LearnerPrecision::kAuto;
  int tile_samples =
      384;  ///< samples per gradient tile: fixed shards, so results do not depend on threads
  int rollout_tile = 64;  ///< aircraft per rollout tile
};

/// In-training evaluation, which also chooses the best checkpoint.
struct PeriodicEvaluationConfig {
  int interval_iterations = 20;  ///< 0: never
  int episodes = 256;
};

struct TrainConfig {
  EnvConfig env;
  NetworkConfig network;
  PpoConfig ppo;
  LearnerConfig learner;
  PeriodicEvaluationConfig evaluation;
  /// What flies, frozen, while a high-level policy is trained; null where the policy itself flies.
  std::shared_ptr<const Policy> low_level;
  std::uint64_t total_steps = 0;  ///< budget in control steps (environment steps at 50 Hz)
  std::uint64_t seed = 1;
};

}  // namespace skein
