// SPDX-License-Identifier: Apache-2.0
#include "train/network/fused_network.h"

#include <algorithm>

#include "base/error.h"
#include "train/network/backend.h"
#include "train/network/network_kernels.h"

namespace skein {
namespace {

// Fewer rows of a step are few for a product: rows of several steps go through a layer together.
constexpr std::int64_t kFewRows = 12;

/// Calls visit(first, count) for `rows` rows, `most` at a time.
template <typename Visit>
void ForEachRows(std::int64_t rows, std::int64_t most, const Visit& visit) {
  for (std::int64_t first = 0; first < rows; first += most) {
    visit(first, std::min(most, rows - first));
  }
}
template <typename Visit>
void ForEachLayerRows(std::int64_t rows, const Visit& visit) {
  ForEachRows(rows, FusedNetwork::kLayerRows, visit);
}

void Grow(AlignedVector<float>& vector, std::int64_t size) {
  if (static_cast<std::int64_t>(vector.size()) < size) vector.resize(size);
}

/// One layer's part of the states [batch][layers][size], times not_done, into padded rows.
void LoadState(std::int64_t batch, int layers, int layer, int size, const float* not_done,
               const float* state, float* rows) {
  const int padded = PaddedWidth(size);
  const std::int64_t stride = RowStride(size);
  for (std::int64_t i = 0; i < batch; ++i) {
    const float* const from = state + (i * layers + layer) * size;
    float* const to = rows + i * stride;
    for (int j = 0; j < size; ++j) to[j] = not_done[i] * from[j];
    std::fill(to + size, to + padded, 0.0f);
  }
}

void StoreState(std::int64_t batch, int layers, int layer, int size, const float* rows,
                float* state) {
  const std::int64_t stride = RowStride(size);
  for (std::int64_t i = 0; i < batch; ++i) {
    std::copy_n(rows + i * stride, size, state + (i * layers + layer) * size);
  }
}

/// `count` rows from `first` on are fetched by the next products.
void FetchRows(const float* rows, std::int64_t first, std::int64_t count, std::int64_t stride,
               FusedActivations& activations) {
  activations.products.FetchSoon(rows + first * stride, count * stride);
}

void AddTo(std::int64_t count, const float* values, float* sums) {
  for (std::int64_t i = 0; i < count; ++i) sums[i] += values[i];
}

}  // namespace

void FusedActivations::Reserve(const NetworkShape& shape, int steps, int batch) {
  const std::int64_t rows = static_cast<std::int64_t>(steps) * batch;
  const std::int64_t width = RowStride(shape.hidden_size), state = RowStride(shape.gru_size);
  const int size = PaddedWidth(shape.gru_size);
  Grow(observation, rows * RowStride(shape.observation_size));
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
    Grow(gru[i].states, (rows + batch) * state);
    if (i + 1 < shape.gru_layers) Grow(gru[i].outputs, rows * state);
  }
  Grow(normalised_state, rows * state);
  Grow(state_inverse_std, rows);
  Grow(output_gradient, rows * shape.output_size);
  for (AlignedVector<float>& buffer : state_gradient) Grow(buffer, rows * state);
  for (AlignedVector<float>& buffer : block_gradient) {
    Grow(buffer, FusedNetwork::kLayerRows * std::max(width, state));
  }
  Grow(gate_sums, 4 * size);
}

FusedNetwork::FusedNetwork(const NetworkLayout& layout, const NetworkPrecision& precision)
    : layout_(layout),
      folded_layout_(layout),
      head_(folded_layout_.linear(layout.head()), precision),
      folded_(folded_layout_.size()) {
  const NetworkShape& shape = layout.shape();
  const std::string limitation = FusedLimitation(shape);
  if (!limitation.empty()) throw Error("the fused kernels do not know " + limitation);
  for (int i = 0; i < layout.head(); ++i) {
    if (i != layout.gru_input()) hidden_.emplace_back(folded_layout_.linear(i), precision);
  }
  const int size = PaddedWidth(shape.gru_size);
  for (int i = 0; i < shape.gru_layers; ++i) {
    const FoldedGru& place = folded_layout_.gru(i);
    gru_.push_back({LinearLayer(place.input, precision), LinearLayer(place.hidden, precision),
                    AlignedVector<float>(3 * size)});
  }
}

void FusedNetwork::SetParameters(const float* parameters) {
  for (LinearLayer& linear : hidden_) linear.SetParameters(parameters, folded_.data());
  const int size = PaddedWidth(layout_.shape().gru_size);
  for (Gru& gru : gru_) {
    gru.input.SetParameters(parameters, folded_.data());
    gru.hidden.SetParameters(parameters, folded_.data());
    std::copy_n(folded(gru.input.place().bias), 3 * size, gru.gate_bias.begin());
    AddTo(2 * size, folded(gru.hidden.place().bias), gru.gate_bias.data() + size);  // r, z
  }
  head_.SetParameters(parameters, folded_.data());
  folded_layout_.CopyLogStd(parameters, folded_.data());
}

const float* FusedNetwork::InputOf(int index, const FusedActivations& activations) const {
  if (index == layout_.shape().hidden_layers) return activations.normalised_state.data();
  return index == 0 ? activations.observation.data()
                    : activations.hidden[index - 1].normalised.data();
}

const float* FusedNetwork::GruInputOf(int layer, const FusedActivations& activations) const {
  if (layer > 0) return activations.gru[layer - 1].outputs.data();
  const int before = layout_.shape().hidden_layers;
  return before == 0 ? activations.observation.data()
                     : activations.hidden[before - 1].normalised.data();
}

void FusedNetwork::HiddenForward(int index, std::int64_t first, std::int64_t count,
                                 FusedActivations& activations) const {
  const LinearLayer& linear = hidden_[index];
  const std::int64_t in = RowStride(linear.place().in), out = RowStride(linear.place().out);
  FusedActivations::HiddenRows& rows = activations.hidden[index];
  float* const values = rows.normalised.data() + first * out;
  linear.Forward(count, InputOf(index, activations) + first * in, in, folded(linear.place().bias),
                 0, values, out, &activations.products);
  ReluNormalise(count, layout_.shape().hidden_size, values, rows.inverse_std.data() + first,
                rows.zero_level.data() + first);
}

void FusedNetwork::GatesForward(int layer, std::int64_t first, std::int64_t count,
                                FusedActivations& activations) const {
  const LinearLayer& linear = gru_[layer].input;
  const std::int64_t in = RowStride(linear.place().in);
  const std::int64_t stride = GateStride(PaddedWidth(layout_.shape().gru_size));
  linear.Forward(
      count, GruInputOf(layer, activations) + first * in, in, gru_[layer].gate_bias.data(), 0,
      activations.gru[layer].gates.data() + first * stride, stride, &activations.products);
}

void FusedNetwork::GruForward(int layer, const SequenceTile& tile, const TileRows& tile_rows,
                              NetworkWorkspace& workspace) const {
  const NetworkShape& shape = layout_.shape();
  const Gru& gru = gru_[layer];
  const int size = PaddedWidth(shape.gru_size);
  const std::int64_t stride = GateStride(size), state = RowStride(size);
  const auto [step, sequence, count, kept] = tile_rows;
  FusedActivations& activations = workspace.fused_;
  FusedActivations::GruRows& rows = activations.gru[layer];
  const float* const not_done = tile.not_done + step * tile.batch + sequence;
  const std::int64_t states = sequence * shape.state_size();
  float* const previous = rows.states.data() + kept * state;
  float* const next = previous + tile.batch * state;
  float* const gates = rows.gates.data() + kept * stride;
  if (step == 0) {
    LoadState(count, shape.gru_layers, layer, shape.gru_size, not_done, tile.initial_state + states,
              previous);
  } else {
    MaskRows(count, size, not_done, previous);
  }
  // The state's part of the new gate stands alone; the others are added to the input's.
  gru.hidden.Forward(count, previous, state, folded(gru.hidden.place().bias), 2 * size,
                     gates + size, stride, &activations.products);
  GruStep(count, size, previous, gates, stride, next);
  if (layer + 1 < shape.gru_layers) {
    std::copy_n(next, count * state, rows.outputs.data() + kept * state);
  }
  if (step + 1 == tile.steps) {
    StoreState(count, shape.gru_layers, layer, shape.gru_size, next,
               workspace.final_state_.data() + states);
  }
}

void FusedNetwork::RowsToGru(const SequenceTile& tile, std::int64_t row, std::int64_t count,
                             std::int64_t kept, NetworkWorkspace& workspace) const {
  FusedActivations& activations = workspace.fused_;
  const int observations = layout_.shape().observation_size;
  NormaliseRows(count, observations, tile.observation + row * observations,
                activations.observation.data() + kept * RowStride(observations));
  for (int i = 0; i < layout_.shape().hidden_layers; ++i) {
    HiddenForward(i, kept, count, activations);
  }
  GatesForward(0, kept, count, activations);
}

void FusedNetwork::RowsThroughGru(const SequenceTile& tile, const TileRows& tile_rows,
                                  NetworkWorkspace& workspace) const {
  const NetworkShape& shape = layout_.shape();
  FusedActivations& activations = workspace.fused_;
  for (int i = 0; i < shape.gru_layers; ++i) {
    if (i > 0) GatesForward(i, tile_rows.kept, tile_rows.count, activations);
    GruForward(i, tile, tile_rows, workspace);
  }
  const std::int64_t state = tile_rows.kept * RowStride(shape.gru_size);
  NormaliseWithStd(tile_rows.count, shape.gru_size,
                   activations.gru[shape.gru_layers - 1].states.data() +
                       tile.batch * RowStride(shape.gru_size) + state,
                   activations.normalised_state.data() + state,
                   activations.state_inverse_std.data() + tile_rows.kept);
}

void FusedNetwork::RowsFromGru(std::int64_t row, std::int64_t count, std::int64_t kept,
                               NetworkWorkspace& workspace) const {
  const NetworkShape& shape = layout_.shape();
  FusedActivations& activations = workspace.fused_;
  for (int i = shape.hidden_layers; i < 2 * shape.hidden_layers; ++i) {
    HiddenForward(i, kept, count, activations);
  }
  const std::int64_t in = RowStride(head_.place().in);
  head_.Forward(count, InputOf(2 * shape.hidden_layers, activations) + kept * in, in,
                folded(head_.place().bias), 0, workspace.output_.data() + row * shape.output_size,
                shape.output_size, &activations.products);
}

void FusedNetwork::FetchToGru(std::int64_t row, std::int64_t count,
                              FusedActivations& activations) const {
  const NetworkShape& shape = layout_.shape();
  const std::int64_t width = RowStride(shape.hidden_size);
  for (int i = 1; i < shape.hidden_layers; ++i) {
    FetchRows(activations.hidden[i].normalised.data(), row, count, width, activations);
  }
  FetchRows(activations.gru[0].gates.data(), row, count, GateStride(PaddedWidth(shape.gru_size)),
            activations);
}

void FusedNetwork::FetchFromGru(const SequenceTile& tile, std::int64_t row, std::int64_t count,
                                FusedActivations& activations) const {
  const NetworkShape& shape = layout_.shape();
  const std::int64_t width = RowStride(shape.hidden_size), state = RowStride(shape.gru_size);
  for (int i = 0; i < shape.gru_layers; ++i) {
    if (i > 0) {
      FetchRows(activations.gru[i].gates.data(), row, count,
                GateStride(PaddedWidth(shape.gru_size)), activations);
    }
    FetchRows(activations.gru[i].states.data(), row + tile.batch, count, state, activations);
  }
  FetchRows(activations.normalised_state.data(), row, count, state, activations);
  for (int i = shape.hidden_layers; i < 2 * shape.hidden_layers; ++i) {
    FetchRows(activations.hidden[i].normalised.data(), row, count, width, activations);
  }
}

void FusedNetwork::FetchNext(const SequenceTile& tile, std::int64_t row, std::int64_t count,
                             FusedActivations& activations) const {
  if (row >= tile.rows()) return;
  const NetworkShape& shape = layout_.shape();
  const int observations = shape.observation_size;
  FetchRows(tile.observation, row, count, observations, activations);
  FetchRows(activations.observation.data(), row, count, RowStride(observations), activations);
  if (shape.hidden_layers > 0) {
    FetchRows(activations.hidden[0].normalised.data(), row, count, RowStride(shape.hidden_size),
              activations);
  }
}

void FusedNetwork::Forward(const SequenceTile& tile, NetworkWorkspace& workspace,
                           bool keeps_all) const {
  const NetworkShape& shape = layout_.shape();
  FusedActivations& activations = workspace.fused_;
  activations.Reserve(shape, tile.steps, tile.batch);
  Grow(workspace.output_, tile.rows() * shape.output_size);
  Grow(workspace.final_state_, static_cast<std::int64_t>(tile.batch) * shape.state_size());
  if (tile.steps > 1 && tile.batch < kFewRows) {
    ForwardByLayers(tile, workspace);
    return;
  }
  const bool keeps = keeps_all || tile.steps > 1;
  for (int step = 0; step < tile.steps; ++step) {
    ForEachRows(tile.batch, kForwardRows, [&](std::int64_t first, std::int64_t count) {
      const std::int64_t row = step * std::int64_t{tile.batch} + first;
      if (keeps) {
        FetchToGru(row, count, activations);
        FetchFromGru(tile, row, count, activations);
        FetchNext(tile, row + count, count, activations);
      }
      const std::int64_t kept = keeps ? row : 0;
      RowsToGru(tile, row, count, kept, workspace);
      RowsThroughGru(tile, {step, first, count, kept}, workspace);
      RowsFromGru(row, count, kept, workspace);
    });
  }
}

void FusedNetwork::ForwardByLayers(const SequenceTile& tile, NetworkWorkspace& workspace) const {
  FusedActivations& activations = workspace.fused_;
  ForEachRows(tile.rows(), kForwardRows, [&](std::int64_t row, std::int64_t count) {
    FetchToGru(row, count, activations);
    FetchNext(tile, row + count, count, activations);
    RowsToGru(tile, row, count, row, workspace);
  });
  for (int step = 0; step < tile.steps; ++step) {
    RowsThroughGru(tile, {step, 0, tile.batch, step * std::int64_t{tile.batch}}, workspace);
  }
  ForEachRows(tile.rows(), kForwardRows, [&](std::int64_t row, std::int64_t count) {
    FetchFromGru(tile, row, count, activations);
    RowsFromGru(row, count, row, workspace);
  });
}

void FusedNetwork::Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const {
  Forward(tile, workspace, false);
}

LossSums FusedNetwork::AccumulateGradient(const SampleTile& tile, const LossSettings& settings,
                                          NetworkWorkspace& workspace, float* accumulator) const {
  Forward(tile.sequence, workspace, true);
  const std::int64_t log_std = folded_layout_.log_std();
  float* const output_gradient = workspace.fused_.output_gradient.data();
  const LossSums sums =
      layout_.shape().gaussian
          ? ActorLoss(tile, layout_.shape().output_size, settings, workspace.output(),
                      folded(log_std), output_gradient, accumulator + log_std)
          : CriticLoss(tile, settings, workspace.output(), output_gradient);
  Backward(tile.sequence, output_gradient, workspace.fused_, accumulator);
  return sums;
}

void FusedNetwork::FinishGradient(const float* parameters, const float* accumulator,
                                  float* gradient) const {
  folded_layout_.UnfoldGradient(parameters, accumulator, gradient);
}

void FusedNetwork::HiddenBackward(int index, float* input_gradient, std::int64_t first,
                                  std::int64_t count, FusedActivations& activations,
                                  float* gradient, float* folded_gradient) const {
  const LinearLayer& linear = hidden_[index];
  const std::int64_t in = RowStride(linear.place().in), out = RowStride(linear.place().out);
  const FusedActivations::HiddenRows& rows = activations.hidden[index];
  ReluNormaliseBackward(count, layout_.shape().hidden_size, rows.normalised.data() + first * out,
                        rows.inverse_std.data() + first, rows.zero_level.data() + first, gradient,
                        folded_gradient + linear.place().bias);
  if (input_gradient != nullptr) {
    linear.BackwardToInput(count, gradient, out, false, input_gradient, in, &activations.products);
  }
  linear.BackwardToWeight(count, InputOf(index, activations) + first * in, in, gradient, out,
                          folded_gradient, &activations.products);
}

void FusedNetwork::GruBackward(int layer, const SequenceTile& tile, FusedActivations& activations,
                               float* state_gradient, float* folded_gradient) const {
  const Gru& gru = gru_[layer];
  const std::int64_t batch = tile.batch;
  const int size = PaddedWidth(layout_.shape().gru_size);
  const std::int64_t stride = GateStride(size), state = RowStride(size);
  const FusedActivations::GruRows& own = activations.gru[layer];
  float* const all_gates = activations.gru[layer].gates.data();
  float* const sums = activations.gate_sums.data();
  std::fill_n(sums, 4 * size, 0.0f);
  for (int step = tile.steps - 1; step >= 0; --step) {
    ForEachLayerRows(batch, [&](std::int64_t offset, std::int64_t count) {
      const std::int64_t first = step * batch + offset;
      float* const gates = all_gates + first * stride;
      float* const gradient = state_gradient + first * state;
      LaterStep later;
      if (step + 1 < tile.steps) later = {gradient + batch * state, tile.not_done + first + batch};
      GruStepBackward(count, size, own.states.data() + first * state, gates, stride, later,
                      gradient, sums);
      if (step == 0) return;
      FetchRows(all_gates, first - batch, count, stride, activations);
      FetchRows(own.states.data(), first - batch, count, state, activations);
      FetchRows(state_gradient, first - batch, count, state, activations);
      gru.hidden.BackwardToInput(count, gates + size, stride, true, gradient, state,
                                 &activations.products);
    });
  }
  AddTo(3 * size, sums, folded_gradient + gru.input.place().bias);
  AddTo(3 * size, sums + size, folded_gradient + gru.hidden.place().bias);
}

void FusedNetwork::Backward(const SequenceTile& tile, const float* output_gradient,
                            FusedActivations& activations, float* folded_gradient) const {
  const NetworkShape& shape = layout_.shape();
  const std::int64_t rows = tile.rows();
  const int outputs = shape.output_size;
  const std::int64_t stride = GateStride(PaddedWidth(shape.gru_size));
  const std::int64_t state = RowStride(shape.gru_size);
  float* const by_state = activations.state_gradient[0].data();
  float* const block[2] = {activations.block_gradient[0].data(),
                           activations.block_gradient[1].data()};

  ForEachLayerRows(rows, [&](std::int64_t first, std::int64_t count) {
    const float* const by_output = output_gradient + first * outputs;
    float* const by_block_state = by_state + first * state;
    const int layers = 2 * shape.hidden_layers;
    const std::int64_t in = RowStride(head_.place().in);
    AddColumnSums(count, outputs, by_output, outputs, folded_gradient + head_.place().bias);
    head_.BackwardToWeight(count, InputOf(layers, activations) + first * in, in, by_output, outputs,
                           folded_gradient, &activations.products);
    for (int i = layers - 1; i >= shape.hidden_layers; --i) {
      FetchRows(InputOf(i, activations), first, count, RowStride(hidden_[i].place().in),
                activations);
    }
    FetchRows(by_state, first, count, state, activations);
    if (first + count < rows) {
      FetchRows(InputOf(layers, activations), first + count, count, in, activations);
    } else {
      const FusedActivations::GruRows& gru = activations.gru[shape.gru_layers - 1];
      FetchRows(gru.gates.data(), rows - tile.batch, tile.batch, stride, activations);
      FetchRows(gru.states.data(), rows - tile.batch, tile.batch, state, activations);
    }
    int current = 0;
    head_.BackwardToInput(count, by_output, outputs, false,
                          shape.hidden_layers == 0 ? by_block_state : block[current], in,
                          &activations.products);
    for (int i = layers - 1; i >= shape.hidden_layers; --i, current ^= 1) {
      float* const by_input = i == shape.hidden_layers ? by_block_state : block[current ^ 1];
      HiddenBackward(i, by_input, first, count, activations, block[current], folded_gradient);
    }
    NormaliseBackward(count, shape.gru_size, activations.normalised_state.data() + first * state,
                      activations.state_inverse_std.data() + first, by_block_state);
  });

  for (int i = shape.gru_layers - 1; i >= 0; --i) {
    const int current = (shape.gru_layers - 1 - i) % 2;
    GruBackward(i, tile, activations, activations.state_gradient[current].data(), folded_gradient);
    const LinearLayer& linear = gru_[i].input;
    const std::int64_t in = RowStride(linear.place().in);
    ForEachLayerRows(rows, [&](std::int64_t first, std::int64_t count) {
      const float* const all_gates = activations.gru[i].gates.data();
      const float* const all_states = activations.gru[i].states.data();
      const float* const gates = all_gates + first * stride;
      FetchRows(GruInputOf(i, activations), first, count, in, activations);
      for (int k = shape.hidden_layers - 1; i == 0 && k >= 0; --k) {
        FetchRows(InputOf(k, activations), first, count, RowStride(hidden_[k].place().in),
                  activations);
      }
      if (first + count < rows) {
        FetchRows(all_gates, first + count, count, stride, activations);
        FetchRows(all_states, first + count, count, state, activations);
      }
      gru_[i].hidden.BackwardToWeight(count, all_states + first * state, state,
                                      gates + PaddedWidth(shape.gru_size), stride, folded_gradient,
                                      &activations.products);
      linear.BackwardToWeight(count, GruInputOf(i, activations) + first * in, in, gates, stride,
                              folded_gradient, &activations.products);
      if (i > 0) {
        linear.BackwardToInput(count, gates, stride, false,
                               activations.state_gradient[current ^ 1].data() + first * state,
                               state, &activations.products);
        return;
      }
      // Nothing needs the gradient with respect to the observation.
      if (shape.hidden_layers == 0) return;
      linear.BackwardToInput(count, gates, stride, false, block[0], in, &activations.products);
      for (int k = shape.hidden_layers - 1, now = 0; k >= 0; --k, now ^= 1) {
        HiddenBackward(k, k > 0 ? block[now ^ 1] : nullptr, first, count, activations, block[now],
                       folded_gradient);
      }
    });
  }
}

}  // namespace skein
