// SPDX-License-Identifier: Apache-2.0
#include "bench/tile_parts.h"

#include <algorithm>

#include "bench/learner_meter.h"
#include "train/network/fused_network.h"
#include "train/network/network_kernels.h"

namespace skein::bench {
namespace {

constexpr int kObservations = 22, kActions = 4;
constexpr int kHiddenLayers = 2;  // on each side of the GRU
constexpr int kSize = 128;        // of layers and state
constexpr std::int64_t kGateStride = GateStride(kSize);
constexpr std::int64_t kStride = RowStride(kSize);
// Of parameters around fresh ones, whose zero biases would hide a bias that is left out.
constexpr float kParameterSpread = 0.02f;

template <typename Visit>
void ForEachBlock(std::int64_t rows, std::int64_t most, const Visit& visit) {
  for (std::int64_t first = 0; first < rows; first += most) {
    visit(first, std::min(most, rows - first));
  }
}

void AddTo(std::int64_t count, const float* values, float* sums) {
  for (std::int64_t i = 0; i < count; ++i) sums[i] += values[i];
}

NetworkShape Shape() { return ActorShape(NetworkConfig(), kObservations, kActions); }

std::vector<float> Parameters(const NetworkLayout& layout) {
  std::vector<float> parameters = InitialParameters(layout, 0.01, 0, 1, 0);
  AddTo(layout.size(), Normal(layout.size(), kParameterSpread).data(), parameters.data());
  return parameters;
}

}  // namespace

const char* Name(TilePart part) {
  switch (part) {
    case TilePart::kObservation:
      return "observation: LayerNorm";
    case TilePart::kHiddenForward:
      return "hidden layers: products forward";
    case TilePart::kHiddenNormalise:
      return "hidden layers: ReLU, LayerNorm";
    case TilePart::kGateInputForward:
      return "GRU: products of its input";
    case TilePart::kGateStateForward:
      return "GRU: products of its state";
    case TilePart::kState:
      return "GRU: states masked";
    case TilePart::kGates:
      return "GRU: gates";
    case TilePart::kStateNormalise:
      return "GRU: LayerNorm";
    case TilePart::kHead:
      return "head: products, both ways";
    case TilePart::kLoss:
      return "loss";
    case TilePart::kHiddenToInput:
      return "hidden layers: products to inputs";
    case TilePart::kHiddenToWeight:
      return "hidden layers: products to weights";
    case TilePart::kNormaliseBackward:
      return "ReLU, LayerNorm backward, bias";
    case TilePart::kGatesBackward:
      return "GRU: gates backward, bias";
    case TilePart::kGateStateToInput:
      return "GRU: products to states";
    case TilePart::kGateStateToWeight:
      return "GRU: products to the state's weight";
    case TilePart::kGateInputToInput:
      return "GRU: products to its input";
    case TilePart::kGateInputToWeight:
      return "GRU: products to the input's weight";
    case TilePart::kCount:
      break;
  }
  return "";
}

TileReplay::TileReplay(const NetworkPrecision& precision, int steps, int batch)
    : layout_(Shape()),
      folded_layout_(layout_),
      gate_input_(folded_layout_.gru(0).input, precision),
      gate_state_(folded_layout_.gru(0).hidden, precision),
      head_(folded_layout_.linear(layout_.head()), precision),
      parameters_(Parameters(layout_)),
      folded_(folded_layout_.size()),
      gate_bias_(3 * kSize),
      gradient_(folded_layout_.size(), 0.0f),
      observation_(Normal(static_cast<std::int64_t>(steps) * batch * kObservations)),
      initial_state_(Normal(static_cast<std::int64_t>(batch) * kSize, 0.3f)),
      action_(Normal(static_cast<std::int64_t>(steps) * batch * kActions)),
      advantage_(Normal(static_cast<std::int64_t>(steps) * batch)),
      not_done_(advantage_.size(), 1.0f),
      log_prob_(advantage_.size(), -5.5f) {
  folded_layout_.CopyLogStd(parameters_.data(), folded_.data());
  for (int i = 0; i < layout_.head(); ++i) {
    if (i != layout_.gru_input()) hidden_.emplace_back(folded_layout_.linear(i), precision);
  }
  for (LinearLayer& linear : hidden_) {
    linear.SetParameters(parameters_.data(), folded_.data());
  }
  for (LinearLayer* const linear : {&gate_input_, &gate_state_, &head_}) {
    linear->SetParameters(parameters_.data(), folded_.data());
  }
  std::copy_n(folded_.data() + gate_input_.place().bias, 3 * kSize, gate_bias_.begin());
  AddTo(2 * kSize, folded_.data() + gate_state_.place().bias, gate_bias_.data() + kSize);  // r, z
  tile_.sequence = {steps, batch, observation_.data(), initial_state_.data(), not_done_.data()};
  tile_.actor = {action_.data(), log_prob_.data(), advantage_.data()};
  settings_.sample_weight = 1.0 / static_cast<double>(tile_.sequence.rows());
  activations_.Reserve(layout_.shape(), steps, batch);
  output_.resize(tile_.sequence.rows() * kActions);
  final_state_.resize(initial_state_.size());
}

TileReplay::Seconds TileReplay::Run(bool backward) {
  seconds_ = {};
  Forward(backward);
  if (backward) {
    Time(TilePart::kLoss, [&] {
      const std::int64_t log_std = folded_layout_.log_std();
      ActorLoss(tile_, kActions, settings_, output_.data(), folded_.data() + log_std,
                activations_.output_gradient.data(), gradient_.data() + log_std);
    });
    Backward();
  }
  return seconds_;
}

double TileReplay::Flops(TilePart part) const {
  const double product = 2.0 * static_cast<double>(tile_.sequence.rows());
  const double hidden = product * kSize * (kObservations + (2 * kHiddenLayers - 1) * kSize);
  const double gates = product * kSize * 3 * kSize;
  switch (part) {
    case TilePart::kHiddenForward:
    case TilePart::kHiddenToWeight:
      return hidden;
    case TilePart::kHiddenToInput:
      return hidden - product * kSize * kObservations;
    case TilePart::kGateInputForward:
    case TilePart::kGateStateForward:
    case TilePart::kGateStateToWeight:
    case TilePart::kGateInputToInput:
    case TilePart::kGateInputToWeight:
      return gates;
    case TilePart::kGateStateToInput:
      return gates * (tile_.sequence.steps - 1) / tile_.sequence.steps;
    case TilePart::kHead:
      return 3 * product * kSize * kActions;
    default:
      return 0;
  }
}

const float* TileReplay::InputOf(int hidden) const {
  if (hidden == kHiddenLayers) return activations_.normalised_state.data();
  return hidden == 0 ? activations_.observation.data()
                     : activations_.hidden[hidden - 1].normalised.data();
}

void TileReplay::FetchRows(const float* rows, std::int64_t first, std::int64_t count,
                           std::int64_t stride) {
  activations_.products.FetchSoon(rows + first * stride, count * stride);
}

void TileReplay::FetchForward(std::int64_t kept, std::int64_t count) {
  const auto hidden = [&](int index) {
    FetchRows(activations_.hidden[index].normalised.data(), kept, count, kStride);
  };
  for (int i = 1; i < kHiddenLayers; ++i) hidden(i);
  FetchRows(activations_.gru[0].gates.data(), kept, count, kGateStride);
  FetchRows(activations_.gru[0].states.data(), kept + tile_.sequence.batch, count, kStride);
  FetchRows(activations_.normalised_state.data(), kept, count, kStride);
  for (int i = kHiddenLayers; i < 2 * kHiddenLayers; ++i) hidden(i);
  kept += count;
  if (kept >= tile_.sequence.rows()) return;
  FetchRows(observation_.data(), kept, count, kObservations);
  FetchRows(activations_.observation.data(), kept, count, RowStride(kObservations));
  hidden(0);
}

void TileReplay::HiddenForward(int index, std::int64_t first, std::int64_t count) {
  const LinearLayer& linear = hidden_[index];
  const std::int64_t in = RowStride(linear.place().in);
  FusedActivations::HiddenRows& rows = activations_.hidden[index];
  float* const values = rows.normalised.data() + first * kStride;
  Time(TilePart::kHiddenForward, [&] {
    linear.Forward(count, InputOf(index) + first * in, in, folded_.data() + linear.place().bias, 0,
                   values, kStride, &activations_.products);
  });
  Time(TilePart::kHiddenNormalise, [&] {
    ReluNormalise(count, kSize, values, rows.inverse_std.data() + first,
                  rows.zero_level.data() + first);
  });
}

void TileReplay::StateForward(int step, std::int64_t first, std::int64_t count, std::int64_t kept) {
  const std::int64_t batch = tile_.sequence.batch;
  FusedActivations::GruRows& rows = activations_.gru[0];
  float* const previous = rows.states.data() + kept * kStride;
  float* const next = previous + batch * kStride;
  float* const gates = rows.gates.data() + kept * kGateStride;
  Time(TilePart::kState, [&] {
    if (step == 0) {
      float* to = previous;
      for (std::int64_t i = first; i < first + count; ++i, to += kStride) {
        const float* const from = initial_state_.data() + i * kSize;
        for (int j = 0; j < kSize; ++j) to[j] = not_done_[i] * from[j];
      }
    } else {
      MaskRows(count, kSize, not_done_.data() + step * batch + first, previous);
    }
  });
  Time(TilePart::kGateStateForward, [&] {
    gate_state_.Forward(count, previous, kStride, folded_.data() + gate_state_.place().bias,
                        2 * kSize, gates + kSize, kGateStride, &activations_.products);
  });
  Time(TilePart::kGates, [&] { GruStep(count, kSize, previous, gates, kGateStride, next); });
  if (step + 1 < tile_.sequence.steps) return;
  Time(TilePart::kState, [&] {
    for (std::int64_t i = 0; i < count; ++i) {
      std::copy_n(next + i * kStride, kSize, final_state_.data() + (first + i) * kSize);
    }
  });
}

void TileReplay::RowsForward(int step, std::int64_t first, std::int64_t count, std::int64_t kept) {
  FusedActivations& own = activations_;
  const std::int64_t row = step * tile_.sequence.batch + first;
  Time(TilePart::kObservation, [&] {
    NormaliseRows(count, kObservations, observation_.data() + row * kObservations,
                  own.observation.data() + kept * RowStride(kObservations));
  });
  for (int i = 0; i < kHiddenLayers; ++i) HiddenForward(i, kept, count);
  Time(TilePart::kGateInputForward, [&] {
    gate_input_.Forward(count, own.hidden[kHiddenLayers - 1].normalised.data() + kept * kStride,
                        kStride, gate_bias_.data(), 0, own.gru[0].gates.data() + kept * kGateStride,
                        kGateStride, &own.products);
  });
  StateForward(step, first, count, kept);
  Time(TilePart::kStateNormalise, [&] {
    const std::int64_t batch = tile_.sequence.batch;
    NormaliseWithStd(count, kSize, own.gru[0].states.data() + (batch + kept) * kStride,
                     own.normalised_state.data() + kept * kStride,
                     own.state_inverse_std.data() + kept);
  });
  for (int i = kHiddenLayers; i < 2 * kHiddenLayers; ++i) HiddenForward(i, kept, count);
  Time(TilePart::kHead, [&] {
    head_.Forward(count, own.hidden[2 * kHiddenLayers - 1].normalised.data() + kept * kStride,
                  kStride, folded_.data() + head_.place().bias, 0, output_.data() + row * kActions,
                  kActions, &own.products);
  });
}

void TileReplay::Forward(bool keeps) {
  const std::int64_t batch = tile_.sequence.batch;
  for (int step = 0; step < tile_.sequence.steps; ++step) {
    ForEachBlock(batch, FusedNetwork::kForwardRows, [&](std::int64_t first, std::int64_t count) {
      if (keeps) FetchForward(step * batch + first, count);
      RowsForward(step, first, count, keeps ? step * batch + first : 0);
    });
  }
}

void TileReplay::HiddenBackward(int index, float* input_gradient, std::int64_t first,
                                std::int64_t count, float* gradient) {
  const LinearLayer& linear = hidden_[index];
  const std::int64_t in = RowStride(linear.place().in);
  const FusedActivations::HiddenRows& rows = activations_.hidden[index];
  Time(TilePart::kNormaliseBackward, [&] {
    ReluNormaliseBackward(count, kSize, rows.normalised.data() + first * kStride,
                          rows.inverse_std.data() + first, rows.zero_level.data() + first, gradient,
                          gradient_.data() + linear.place().bias);
  });
  if (input_gradient != nullptr) {
    Time(TilePart::kHiddenToInput, [&] {
      linear.BackwardToInput(count, gradient, kStride, false, input_gradient, in,
                             &activations_.products);
    });
  }
  Time(TilePart::kHiddenToWeight, [&] {
    linear.BackwardToWeight(count, InputOf(index) + first * in, in, gradient, kStride,
                            gradient_.data(), &activations_.products);
  });
}

void TileReplay::StepBackward(int step) {
  const std::int64_t batch = tile_.sequence.batch;
  FusedActivations::GruRows& own = activations_.gru[0];
  ForEachBlock(batch, FusedNetwork::kLayerRows, [&](std::int64_t offset, std::int64_t count) {
    const std::int64_t first = step * batch + offset;
    float* const gates = own.gates.data() + first * kGateStride;
    float* const gradient = activations_.state_gradient[0].data() + first * kStride;
    LaterStep later;
    if (step + 1 < tile_.sequence.steps) {
      later = {gradient + batch * kStride, not_done_.data() + first + batch};
    }
    Time(TilePart::kGatesBackward, [&] {
      GruStepBackward(count, kSize, own.states.data() + first * kStride, gates, kGateStride, later,
                      gradient, activations_.gate_sums.data());
    });
    if (step == 0) return;
    FetchRows(own.gates.data(), first - batch, count, kGateStride);
    FetchRows(own.states.data(), first - batch, count, kStride);
    FetchRows(activations_.state_gradient[0].data(), first - batch, count, kStride);
    Time(TilePart::kGateStateToInput, [&] {
      gate_state_.BackwardToInput(count, gates + kSize, kGateStride, true, gradient, kStride,
                                  &activations_.products);
    });
  });
}

void TileReplay::BackwardBehindGru() {
  const std::int64_t rows = tile_.sequence.rows();
  FusedActivations& own = activations_;
  float* const by_state = own.state_gradient[0].data();
  float* const block[2] = {own.block_gradient[0].data(), own.block_gradient[1].data()};
  ForEachBlock(rows, FusedNetwork::kLayerRows, [&](std::int64_t first, std::int64_t count) {
    const float* const by_output = own.output_gradient.data() + first * kActions;
    Time(TilePart::kHead, [&] {
      AddColumnSums(count, kActions, by_output, kActions, gradient_.data() + head_.place().bias);
      head_.BackwardToWeight(count,
                             own.hidden[2 * kHiddenLayers - 1].normalised.data() + first * kStride,
                             kStride, by_output, kActions, gradient_.data(), &own.products);
    });
    for (int i = 2 * kHiddenLayers - 1; i >= kHiddenLayers; --i) {
      FetchRows(InputOf(i), first, count, kStride);
    }
    FetchRows(by_state, first, count, kStride);
    if (first + count < rows) {
      FetchRows(InputOf(2 * kHiddenLayers), first + count, count, kStride);
    } else {
      const std::int64_t batch = tile_.sequence.batch;
      FetchRows(own.gru[0].gates.data(), rows - batch, batch, kGateStride);
      FetchRows(own.gru[0].states.data(), rows - batch, batch, kStride);
    }
    Time(TilePart::kHead, [&] {
      head_.BackwardToInput(count, by_output, kActions, false, block[0], kStride, &own.products);
    });
    float* const by_block_state = by_state + first * kStride;
    HiddenBackward(3, block[1], first, count, block[0]);
    HiddenBackward(2, by_block_state, first, count, block[1]);
    Time(TilePart::kNormaliseBackward, [&] {
      NormaliseBackward(count, kSize, own.normalised_state.data() + first * kStride,
                        own.state_inverse_std.data() + first, by_block_state);
    });
  });
}

void TileReplay::Backward() {
  const std::int64_t rows = tile_.sequence.rows();
  FusedActivations& own = activations_;
  float* const block[2] = {own.block_gradient[0].data(), own.block_gradient[1].data()};
  float* const sums = own.gate_sums.data();
  BackwardBehindGru();
  std::fill_n(sums, 4 * kSize, 0.0f);
  for (int step = tile_.sequence.steps - 1; step >= 0; --step) StepBackward(step);
  AddTo(3 * kSize, sums, gradient_.data() + gate_input_.place().bias);
  AddTo(3 * kSize, sums + kSize, gradient_.data() + gate_state_.place().bias);
  const float* const gates = own.gru[0].gates.data();
  const float* const states = own.gru[0].states.data();
  ForEachBlock(rows, FusedNetwork::kLayerRows, [&](std::int64_t first, std::int64_t count) {
    const float* const own_gates = gates + first * kGateStride;
    for (int i = kHiddenLayers - 1; i >= 0; --i) {
      FetchRows(own.hidden[i].normalised.data(), first, count, kStride);
    }
    FetchRows(own.observation.data(), first, count, RowStride(kObservations));
    if (first + count < rows) {
      FetchRows(gates, first + count, count, kGateStride);
      FetchRows(states, first + count, count, kStride);
    }
    Time(TilePart::kGateStateToWeight, [&] {
      gate_state_.BackwardToWeight(count, states + first * kStride, kStride, own_gates + kSize,
                                   kGateStride, gradient_.data(), &own.products);
    });
    Time(TilePart::kGateInputToWeight, [&] {
      gate_input_.BackwardToWeight(
          count, own.hidden[kHiddenLayers - 1].normalised.data() + first * kStride, kStride,
          own_gates, kGateStride, gradient_.data(), &own.products);
    });
    Time(TilePart::kGateInputToInput, [&] {
      gate_input_.BackwardToInput(count, own_gates, kGateStride, false, block[0], kStride,
                                  &own.products);
    });
    HiddenBackward(1, block[1], first, count, block[0]);
    HiddenBackward(0, nullptr, first, count, block[1]);
  });
}

}  // namespace skein::bench
