// SPDX-License-Identifier: Apache-2.0
#include "train/network/network_config.h"

#include "base/field_list.h"
#include "base/name_in.h"

namespace skein {

const char* Name(Activation activation) { return NameIn(kActivationNames, activation); }

void ListFields(NetworkConfig& config, FieldList& list) {
  list.Add("hidden_layers", &config.hidden_layers, {0, kMaxHiddenLayers},
           "linear layers before the gated recurrent ones, and as many behind them");
  list.Add("hidden_size", &config.hidden_size, {1, kMaxWidth},
           "units of each linear layer of actor and critic");
  list.Add("gru_layers", &config.gru_layers, {1, kMaxGruLayers},
           "gated recurrent layers, each on top of the other");
  list.Add("gru_size", &config.gru_size, {1, kMaxWidth}, "units of each gated recurrent layer");
  list.Add("activation", &config.activation, kActivationNames,
           "of the linear layers; all but relu are computed by LibTorch");
  list.Add("tanh_mean", &config.tanh_mean, "the Gaussian's mean goes through tanh");
  list.Add("initial_log_std", &config.initial_log_std, {-10, 5},
           "initial logarithm of the actions' standard deviation");
  list.Add("actor_head_scale", &config.actor_head_scale, Bounds::Positive(),
           "scale of the actor's last layer at the start");
}

}  // namespace skein
