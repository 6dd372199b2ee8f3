// SPDX-License-Identifier: Apache-2.0
#include "train/libtorch/libtorch_network.h"

#include <c10/core/InferenceMode.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <algorithm>

#include "base/error.h"
#include "train/libtorch/libtorch_threads.h"
#include "train/network/network_kernels.h"

namespace skein {
namespace {

constexpr double kHalfLogTwoPi = 0.91893853320467274;

torch::Tensor View(const torch::Tensor& flat, std::int64_t offset, at::IntArrayRef shape) {
  std::int64_t count = 1;
  for (const std::int64_t extent : shape) count *= extent;
  return flat.narrow(0, offset, count).view(shape);
}

torch::Tensor FromMemory(const float* data, at::IntArrayRef shape, torch::ScalarType type) {
  return torch::from_blob(const_cast<float*>(data), shape, torch::kFloat32).to(type);
}

/// LayerNorm and the linear layer behind it.
torch::Tensor Linear(const torch::Tensor& flat, const NormalisedLinear& layer,
                     const torch::Tensor& in) {
  const torch::Tensor normalised =
      at::layer_norm(in, {layer.in}, View(flat, layer.norm_weight, {layer.in}),
                     View(flat, layer.norm_bias, {layer.in}), kLayerNormEpsilon);
  return at::linear(normalised, View(flat, layer.weight, {layer.out, layer.in}),
                    View(flat, layer.bias, {layer.out}));
}

torch::Tensor Activate(Activation activation, const torch::Tensor& in) {
  switch (activation) {
    case Activation::kRelu:
      return at::relu(in);
    case Activation::kTanh:
      return at::tanh(in);
    case Activation::kElu:
      return at::elu(in);
    case Activation::kSilu:
      return at::silu(in);
  }
  throw Error("network.activation holds a value without a name");
}

/// States [steps][batch][gru_size] of a GRU layer from its input layer's values,
/// [steps][batch][3 gru_size], and its state before the first step.
torch::Tensor GruStates(const torch::Tensor& flat, const GruLayer& layer, int gru_size,
                        const torch::Tensor& inputs, const torch::Tensor& not_done,
                        torch::Tensor state) {
  const torch::Tensor weight = View(flat, layer.hidden_weight, {3 * gru_size, gru_size});
  const torch::Tensor bias = View(flat, layer.hidden_bias, {3 * gru_size});
  std::vector<torch::Tensor> states;
  for (std::int64_t step = 0; step < inputs.size(0); ++step) {
    const torch::Tensor previous = state * not_done[step];
    const auto from_input = inputs[step].chunk(3, 1);
    const auto from_state = at::linear(previous, weight, bias).chunk(3, 1);
    const torch::Tensor r = at::sigmoid(from_input[0] + from_state[0]);
    const torch::Tensor z = at::sigmoid(from_input[1] + from_state[1]);
    const torch::Tensor n = at::tanh(from_input[2] + r * from_state[2]);
    state = (1 - z) * n + z * previous;
    states.push_back(state);
  }
  return at::stack(states);
}

struct Outputs {
  torch::Tensor output;  ///< [rows][output_size]
  torch::Tensor state;   ///< [batch][gru_layers][gru_size]
};

/// In the precision of `flat`, the network's parameters.
Outputs ForwardOf(const NetworkLayout& layout, const torch::Tensor& flat,
                  const SequenceTile& tile) {
  const torch::ScalarType type = flat.scalar_type();
  const NetworkShape& shape = layout.shape();
  const std::int64_t gru = shape.gru_size;
  torch::Tensor x = FromMemory(tile.observation, {tile.rows(), shape.observation_size}, type);
  const auto pass_hidden = [&](int first) {
    for (int i = first; i < first + shape.hidden_layers; ++i) {
      x = Activate(shape.activation, Linear(flat, layout.layer(i), x));
    }
  };
  pass_hidden(0);
  const torch::Tensor not_done = FromMemory(tile.not_done, {tile.steps, tile.batch, 1}, type);
  const torch::Tensor initial =
      FromMemory(tile.initial_state, {tile.batch, shape.gru_layers, gru}, type);
  std::vector<torch::Tensor> last;
  for (int i = 0; i < shape.gru_layers; ++i) {
    const GruLayer& layer = layout.gru_layers()[i];
    const torch::Tensor inputs =
        i == 0 ? Linear(flat, layout.layer(layout.gru_input()), x)
               : at::linear(x, View(flat, layer.input_weight, {3 * gru, layer.in}),
                            View(flat, layer.input_bias, {3 * gru}));
    const torch::Tensor states =
        GruStates(flat, layer, shape.gru_size, inputs.view({tile.steps, tile.batch, 3 * gru}),
                  not_done, initial.select(1, i));
    last.push_back(states[tile.steps - 1]);
    x = states.view({tile.rows(), gru});
  }
  pass_hidden(layout.gru_input() + 1);
  return {Linear(flat, layout.layer(layout.head()), x), at::stack(last, 1)};
}

struct Loss {
  torch::Tensor total;
  LossSums sums;
};

/// LossSums::action_change of `mean`, [rows][size].
torch::Tensor ActionChangeOf(const torch::Tensor& mean, const SequenceTile& tile,
                             const LossSettings& settings) {
  const int pairs = tile.steps - 1;
  const torch::Tensor actions = mean.view({tile.steps, tile.batch, -1});
  const torch::Tensor not_done =
      FromMemory(tile.not_done, {tile.steps, tile.batch, 1}, mean.scalar_type());
  const torch::Tensor change =
      (actions.narrow(0, 1, pairs) - actions.narrow(0, 0, pairs)) * not_done.narrow(0, 1, pairs);
  return change.square().sum() * settings.pair_weight;
}

Loss ActorLossOf(const NetworkLayout& layout, const torch::Tensor& flat,
                 const torch::Tensor& output, const SampleTile& tile,
                 const LossSettings& settings) {
  const torch::ScalarType type = flat.scalar_type();
  const std::int64_t rows = tile.sequence.rows(), size = layout.shape().output_size;
  const torch::Tensor log_std = View(flat, layout.log_std(), {size});
  const torch::Tensor mean = settings.tanh_mean ? at::tanh(output) : output;
  const torch::Tensor deviation =
      (FromMemory(tile.actor.action, {rows, size}, type) - mean) * at::exp(-log_std);
  const torch::Tensor log_prob = (-0.5 * deviation.square() - log_std - kHalfLogTwoPi).sum(1);
  const torch::Tensor log_ratio = log_prob - FromMemory(tile.actor.old_log_prob, {rows}, type);
  const torch::Tensor ratio = at::exp(log_ratio);
  const torch::Tensor advantage = FromMemory(tile.actor.advantage, {rows}, type);
  const torch::Tensor clipped = at::clamp(ratio, 1 - settings.clip, 1 + settings.clip);
  const torch::Tensor policy_loss =
      -at::minimum(ratio * advantage, clipped * advantage).sum() * settings.sample_weight;
  const torch::Tensor entropy =
      (log_std + kHalfLogTwoPi + 0.5).sum() * (settings.sample_weight * static_cast<double>(rows));
  const torch::Tensor action_change = ActionChangeOf(mean, tile.sequence, settings);
  Loss loss;
  loss.total = policy_loss - settings.entropy_coefficient * entropy +
               settings.action_smoothness_coefficient * action_change;
  loss.sums.policy_loss = policy_loss.item<double>();
  loss.sums.entropy = entropy.item<double>();
  loss.sums.approximate_kl = (ratio - 1 - log_ratio).sum().item<double>() * settings.sample_weight;
  loss.sums.action_change = action_change.item<double>();
  loss.sums.clip_fraction = at::ne(ratio, clipped).sum().item<double>() * settings.sample_weight;
  return loss;
}

Loss CriticLossOf(const torch::Tensor& output, const SampleTile& tile,
                  const LossSettings& settings) {
  const torch::ScalarType type = output.scalar_type();
  const std::int64_t rows = tile.sequence.rows();
  const torch::Tensor value = output.view({rows});
  const torch::Tensor target = FromMemory(tile.target, {rows}, type);
  torch::Tensor squares = (value - target).square();
  if (settings.clip_value_loss) {
    const torch::Tensor old_value = FromMemory(tile.old_value, {rows}, type);
    const torch::Tensor moved =
        old_value + at::clamp(value - old_value, -settings.clip, settings.clip);
    squares = at::maximum(squares, (moved - target).square());
  }
  const torch::Tensor value_loss = 0.5 * squares.sum() * settings.sample_weight;
  Loss loss;
  loss.total = settings.value_coefficient * value_loss;
  loss.sums.value_loss = value_loss.item<double>();
  return loss;
}

Loss LossOf(const NetworkLayout& layout, const torch::Tensor& flat, const torch::Tensor& output,
            const SampleTile& tile, const LossSettings& settings) {
  return layout.shape().gaussian ? ActorLossOf(layout, flat, output, tile, settings)
                                 : CriticLossOf(output, tile, settings);
}

void Copy(const torch::Tensor& from, AlignedVector<float>& to) {
  const torch::Tensor values = from.contiguous();
  const float* const data = values.data_ptr<float>();
  to.assign(data, data + values.numel());
}

std::vector<double> ToVector(const torch::Tensor& tensor) {
  const torch::Tensor flat = tensor.detach().to(torch::kFloat64).contiguous().view({-1});
  return {flat.data_ptr<double>(), flat.data_ptr<double>() + flat.numel()};
}

}  // namespace

LibTorchNetwork::LibTorchNetwork(const NetworkLayout& layout) : layout_(layout) {
  UseOneLibTorchThread();
}

void LibTorchNetwork::SetParameters(const float* parameters) {
  parameters_.assign(parameters, parameters + layout_.size());
}

void LibTorchNetwork::Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const {
  const c10::InferenceMode no_autograd;
  const torch::Tensor flat = FromMemory(parameters_.data(), {layout_.size()}, torch::kFloat32);
  const Outputs outputs = ForwardOf(layout_, flat, tile);
  Copy(outputs.output, workspace.output_);
  Copy(outputs.state, workspace.final_state_);
}

LossSums LibTorchNetwork::AccumulateGradient(const SampleTile& tile, const LossSettings& settings,
                                             NetworkWorkspace& /*workspace*/,
                                             float* accumulator) const {
  // A leaf of this call's own graph, so that workers share no gradient buffers.
  const torch::Tensor leaf = FromMemory(parameters_.data(), {layout_.size()}, torch::kFloat32)
                                 .clone()
                                 .requires_grad_(true);
  const Loss loss =
      LossOf(layout_, leaf, ForwardOf(layout_, leaf, tile.sequence).output, tile, settings);
  const torch::Tensor gradient = torch::autograd::grad({loss.total}, {leaf})[0].contiguous();
  const float* const values = gradient.data_ptr<float>();
  for (std::int64_t i = 0; i < layout_.size(); ++i) accumulator[i] += values[i];
  return loss.sums;
}

void LibTorchNetwork::FinishGradient(const float* /*parameters*/, const float* accumulator,
                                     float* gradient) const {
  std::copy_n(accumulator, layout_.size(), gradient);
}

ReferenceGradient ComputeReferenceGradient(const NetworkLayout& layout,
                                           const std::vector<float>& parameters,
                                           const SampleTile& tile, const LossSettings& settings) {
  const torch::Tensor flat =
      FromMemory(parameters.data(), {layout.size()}, torch::kFloat64).clone().requires_grad_(true);
  const Outputs outputs = ForwardOf(layout, flat, tile.sequence);
  const Loss loss = LossOf(layout, flat, outputs.output, tile, settings);
  ReferenceGradient result;
  result.loss = loss.total.item<double>();
  result.sums = loss.sums;
  result.gradient = ToVector(torch::autograd::grad({loss.total}, {flat})[0]);
  result.output = ToVector(outputs.output);
  result.state = ToVector(outputs.state);
  return result;
}

}  // namespace skein
