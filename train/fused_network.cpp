#include "train/fused_network.h"

#include <algorithm>

#include "simd/error.h"
#include "train/backend.h"
#include "train/matmul.h"
#include "train/network_kernels.h"

namespace skein {
namespace {

/// Floats between rows of gates: four gates, and a cache line so that rows do not all fall into the
/// same sets of the cache.
std::int64_t GateStride(int padded_gru) { return 4 * padded_gru + 16; }

MatrixView Rows(const float* data, std::int64_t rows, std::int64_t columns,
                std::int64_t stride = 0) {
  // Inputs of MatMul are read only.
  return {const_cast<float*>(data), rows, columns, stride == 0 ? columns : stride};
}

void Grow(AlignedVector<float>& vector, std::int64_t size) {
  if (static_cast<std::int64_t>(vector.size()) < size) vector.resize(size);
}

void AddBias(std::int64_t rows, int columns, const float* bias, float* values) {
  for (std::int64_t i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) values[i * columns + j] += bias[j];
  }
}

void AddBiasGradient(std::int64_t rows, int columns, const float* gradient, float* bias_gradient) {
  for (std::int64_t i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) bias_gradient[j] += gradient[i * columns + j];
  }
}

/// One layer's part of the states [batch][layers][size], times keep, into padded rows.
void LoadState(int batch, int layers, int layer, int size, const float* keep, const float* state,
               float* rows) {
  const int padded = PaddedWidth(size);
  for (std::int64_t i = 0; i < batch; ++i) {
    const float* const from = state + (i * layers + layer) * size;
    float* const to = rows + i * padded;
    for (int j = 0; j < size; ++j) to[j] = keep[i] * from[j];
    std::fill(to + size, to + padded, 0.0f);
  }
}

void StoreState(int batch, int layers, int layer, int size, const float* rows, float* state) {
  const int padded = PaddedWidth(size);
  for (std::int64_t i = 0; i < batch; ++i) {
    std::copy_n(rows + i * padded, size, state + (i * layers + layer) * size);
  }
}

}  // namespace

void FusedActivations::Reserve(const NetworkShape& shape, int steps, int batch) {
  const std::int64_t rows = static_cast<std::int64_t>(steps) * batch;
  const int width = PaddedWidth(shape.hidden_size), size = PaddedWidth(shape.gru_size);
  Grow(observation, rows * shape.observation_size);
  // Workspaces serve several networks: memory of larger ones stays.
  hidden.resize(std::max<std::size_t>(hidden.size(), 2 * shape.hidden_layers));
  for (int i = 0; i < 2 * shape.hidden_layers; ++i) {
    Grow(hidden[i].normalised, rows * width);
    Grow(hidden[i].inverse_std, rows);
    Grow(hidden[i].zero_level, rows);
  }
  gru.resize(std::max<std::size_t>(gru.size(), shape.gru_layers));
  for (int i = 0; i < shape.gru_layers; ++i) {
    Grow(gru[i].gates, rows * GateStride(size));
    Grow(gru[i].previous, rows * size);
    Grow(gru[i].state, rows * size);
  }
  Grow(hidden_product, static_cast<std::int64_t>(batch) * 3 * size);
  Grow(normalised_state, rows * size);
  Grow(state_inverse_std, rows);
  Grow(output_gradient, rows * shape.output_size);
  for (AlignedVector<float>& buffer : gradient) Grow(buffer, rows * std::max(width, size));
}

FusedNetwork::FusedNetwork(const NetworkLayout& layout)
    : layout_(layout), folded_layout_(layout), folded_(folded_layout_.size()) {
  const std::string limitation = FusedLimitation(layout.shape());
  if (!limitation.empty()) throw Error("the fused kernels do not know " + limitation);
  UseOneLibTorchThread();
}

void FusedNetwork::SetParameters(const float* parameters) {
  parameters_.assign(parameters, parameters + layout_.size());
  folded_layout_.Fold(parameters, folded_.data());
}

void FusedNetwork::HiddenForward(int layer, const float* in, std::int64_t rows,
                                 FusedActivations::HiddenRows& out) const {
  const FoldedMap& map = folded_layout_.map(layer);
  MatMul(Rows(in, rows, map.in), Transpose::kNo, Rows(folded(map.weight), map.out, map.in),
         Transpose::kYes, false, Rows(out.normalised.data(), rows, map.out));
  BiasReluNormalise(rows, layout_.layer(layer).out, folded(map.bias), out.normalised.data(),
                    out.inverse_std.data(), out.zero_level.data());
}

void FusedNetwork::GruForward(int layer, const float* in, const SequenceTile& tile,
                              FusedActivations& activations) const {
  const NetworkShape& shape = layout_.shape();
  const FoldedGru& maps = folded_layout_.gru(layer);
  const std::int64_t rows = tile.rows(), batch = tile.batch;
  const int size = PaddedWidth(shape.gru_size);
  const std::int64_t stride = GateStride(size);
  FusedActivations::GruRows& out = activations.gru[layer];
  MatMul(Rows(in, rows, maps.input.in), Transpose::kNo,
         Rows(folded(maps.input.weight), 3 * size, maps.input.in), Transpose::kYes, false,
         Rows(out.gates.data(), rows, 3 * size, stride));
  for (int step = 0; step < tile.steps; ++step) {
    const std::int64_t first = step * batch;
    float* const previous = out.previous.data() + first * size;
    if (step == 0) {
      LoadState(tile.batch, shape.gru_layers, layer, shape.gru_size, tile.keep, tile.initial_state,
                previous);
    } else {
      ScaleRows(batch, size, tile.keep + first, out.state.data() + (first - batch) * size,
                previous);
    }
    MatMul(Rows(previous, batch, size), Transpose::kNo,
           Rows(folded(maps.hidden.weight), 3 * size, size), Transpose::kYes, false,
           Rows(activations.hidden_product.data(), batch, 3 * size));
    GruStep(batch, size, folded(maps.input.bias), folded(maps.hidden.bias),
            activations.hidden_product.data(), previous, out.gates.data() + first * stride, stride,
            out.state.data() + first * size);
  }
}

void FusedNetwork::Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const {
  const NetworkShape& shape = layout_.shape();
  const std::int64_t rows = tile.rows();
  FusedActivations& activations = workspace.fused_;
  activations.Reserve(shape, tile.steps, tile.batch);
  Grow(workspace.output_, rows * shape.output_size);
  Grow(workspace.final_state_, static_cast<std::int64_t>(tile.batch) * shape.state_size());

  const float* in = activations.observation.data();
  NormaliseRows(rows, shape.observation_size, tile.observation, activations.observation.data());
  for (int i = 0; i < shape.hidden_layers; ++i) {
    HiddenForward(i, in, rows, activations.hidden[i]);
    in = activations.hidden[i].normalised.data();
  }
  const std::int64_t last_step = (rows - tile.batch) * PaddedWidth(shape.gru_size);
  for (int i = 0; i < shape.gru_layers; ++i) {
    GruForward(i, in, tile, activations);
    in = activations.gru[i].state.data();
    StoreState(tile.batch, shape.gru_layers, i, shape.gru_size, in + last_step,
               workspace.final_state_.data());
  }
  NormaliseWithStd(rows, shape.gru_size, in, activations.normalised_state.data(),
                   activations.state_inverse_std.data());
  in = activations.normalised_state.data();
  for (int i = shape.hidden_layers; i < 2 * shape.hidden_layers; ++i) {
    HiddenForward(i + 1, in, rows, activations.hidden[i]);
    in = activations.hidden[i].normalised.data();
  }
  const FoldedMap& head = folded_layout_.map(layout_.head());
  MatMul(Rows(in, rows, head.in), Transpose::kNo, Rows(folded(head.weight), head.out, head.in),
         Transpose::kYes, false, Rows(workspace.output_.data(), rows, head.out));
  AddBias(rows, head.out, folded(head.bias), workspace.output_.data());
}

LossSums FusedNetwork::AccumulateGradient(const SampleTile& tile, const LossSettings& settings,
                                          NetworkWorkspace& workspace, float* accumulator) const {
  Forward(tile.sequence, workspace);
  const std::int64_t rows = tile.sequence.rows(), log_std = folded_layout_.log_std();
  float* const output_gradient = workspace.fused_.output_gradient.data();
  const LossSums sums =
      layout_.shape().gaussian
          ? ActorLoss(rows, layout_.shape().output_size, settings, workspace.output(),
                      folded(log_std), tile.actor, output_gradient, accumulator + log_std)
          : CriticLoss(rows, settings, workspace.output(), tile.target, tile.old_value,
                       output_gradient);
  Backward(tile.sequence, output_gradient, workspace.fused_, accumulator);
  return sums;
}

void FusedNetwork::FinishGradient(const float* accumulator, float* gradient) const {
  folded_layout_.UnfoldGradient(parameters_.data(), accumulator, gradient);
}

void FusedNetwork::MapBackward(const FoldedMap& map, const float* in, const float* output_gradient,
                               std::int64_t stride, std::int64_t rows, float* folded_gradient,
                               float* input_gradient) const {
  const MatrixView gradient = Rows(output_gradient, rows, map.out, stride);
  MatMul(gradient, Transpose::kYes, Rows(in, rows, map.in), Transpose::kNo, true,
         Rows(folded_gradient + map.weight, map.out, map.in));
  if (input_gradient == nullptr) return;
  MatMul(gradient, Transpose::kNo, Rows(folded(map.weight), map.out, map.in), Transpose::kNo, false,
         Rows(input_gradient, rows, map.in));
}

void FusedNetwork::HiddenBackward(int layer, const FusedActivations::HiddenRows& out,
                                  std::int64_t rows, float* gradient,
                                  float* folded_gradient) const {
  BiasReluNormaliseBackward(rows, layout_.layer(layer).out, out.normalised.data(),
                            out.inverse_std.data(), out.zero_level.data(), gradient,
                            folded_gradient + folded_layout_.map(layer).bias);
}

void FusedNetwork::GruBackward(int layer, const SequenceTile& tile, FusedActivations& activations,
                               float* state_gradient, float* folded_gradient) const {
  const FoldedGru& maps = folded_layout_.gru(layer);
  const std::int64_t rows = tile.rows(), batch = tile.batch;
  const int size = PaddedWidth(layout_.shape().gru_size);
  const std::int64_t stride = GateStride(size);
  const FusedActivations::GruRows& out = activations.gru[layer];
  float* const gates = activations.gru[layer].gates.data();
  for (int step = tile.steps - 1; step >= 0; --step) {
    const std::int64_t first = step * batch;
    float* const own = state_gradient + first * size;
    GruStepBackward(batch, size, out.previous.data() + first * size, gates + first * stride, stride,
                    own);
    if (step == 0) break;
    MatMul(Rows(gates + first * stride + size, batch, 3 * size, stride), Transpose::kNo,
           Rows(folded(maps.hidden.weight), 3 * size, size), Transpose::kNo, true,
           Rows(own, batch, size));
    AddScaledRows(batch, size, tile.keep + first, own, own - batch * size);
  }
  MapBackward(maps.hidden, out.previous.data(), gates + size, stride, rows, folded_gradient,
              nullptr);
  AddColumnSums(rows, 3 * size, gates, stride, folded_gradient + maps.input.bias);
  AddColumnSums(rows, 3 * size, gates + size, stride, folded_gradient + maps.hidden.bias);
}

void FusedNetwork::Backward(const SequenceTile& tile, const float* output_gradient,
                            FusedActivations& activations, float* folded_gradient) const {
  const NetworkShape& shape = layout_.shape();
  const std::int64_t rows = tile.rows();
  const auto& hidden = activations.hidden;
  float* gradient = activations.gradient[0].data();
  float* other = activations.gradient[1].data();

  const FoldedMap& head = folded_layout_.map(layout_.head());
  AddBiasGradient(rows, head.out, output_gradient, folded_gradient + head.bias);
  const float* const behind_gru = activations.normalised_state.data();
  const auto input_of = [&](int i) {
    return i == shape.hidden_layers ? behind_gru : hidden[i - 1].normalised.data();
  };
  MapBackward(head, input_of(2 * shape.hidden_layers), output_gradient, head.out, rows,
              folded_gradient, gradient);
  for (int i = 2 * shape.hidden_layers - 1; i >= shape.hidden_layers; --i) {
    const FoldedMap& map = folded_layout_.map(i + 1);
    HiddenBackward(i + 1, hidden[i], rows, gradient, folded_gradient);
    MapBackward(map, input_of(i), gradient, map.out, rows, folded_gradient, other);
    std::swap(gradient, other);
  }
  NormaliseBackward(rows, shape.gru_size, behind_gru, activations.state_inverse_std.data(),
                    gradient);

  const std::int64_t stride = GateStride(PaddedWidth(shape.gru_size));
  const bool is_first = shape.hidden_layers == 0;  // nothing needs the gradient by the observation
  for (int i = shape.gru_layers - 1; i >= 0; --i) {
    GruBackward(i, tile, activations, gradient, folded_gradient);
    const float* const in = i > 0      ? activations.gru[i - 1].state.data()
                            : is_first ? activations.observation.data()
                                       : hidden[shape.hidden_layers - 1].normalised.data();
    MapBackward(folded_layout_.gru(i).input, in, activations.gru[i].gates.data(), stride, rows,
                folded_gradient, i == 0 && is_first ? nullptr : other);
    std::swap(gradient, other);
  }
  for (int i = shape.hidden_layers - 1; i >= 0; --i) {
    const FoldedMap& map = folded_layout_.map(i);
    HiddenBackward(i, hidden[i], rows, gradient, folded_gradient);
    MapBackward(map, i > 0 ? hidden[i - 1].normalised.data() : activations.observation.data(),
                gradient, map.out, rows, folded_gradient, i > 0 ? other : nullptr);
    std::swap(gradient, other);
  }
}

}  // namespace skein
