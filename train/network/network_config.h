// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>

namespace skein {

class FieldList;

/// What a hidden layer applies to its linear values.
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

/// Its settings (base/field_list.h).
void ListFields(NetworkConfig& config, FieldList& list);

}  // namespace skein
