#include "train/tiled_network.h"

#include <algorithm>

#include "train/matmul.h"
#include "train/network_kernels.h"

namespace skein {
namespace {

/// Floats between rows of gates: four gates, and a cache line so that rows do not all fall into the
/// same sets of the cache.
std::int64_t GateStride(const NetworkShape& shape) { return 4 * shape.gru_size + 16; }

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

}  // namespace

void NetworkWorkspace::Reserve(const NetworkShape& shape, int steps, int batch) {
  const std::int64_t rows = static_cast<std::int64_t>(steps) * batch;
  const std::int64_t hidden = shape.hidden_size, gru = shape.gru_size;
  Grow(observation_, rows * shape.observation_size);
  for (HiddenRows& layer : hidden_) {
    Grow(layer.normalised, rows * hidden);
    Grow(layer.inverse_std, rows);
    Grow(layer.zero_level, rows);
  }
  Grow(gates_, rows * GateStride(shape));
  Grow(hidden_product_, rows * 3 * gru);
  for (AlignedVector<float>* const states : {&previous_state_, &state_, &normalised_state_}) {
    Grow(*states, rows * gru);
  }
  Grow(state_inverse_std_, rows);
  Grow(output_, rows * shape.output_size);
  for (AlignedVector<float>& gradient : gradient_) Grow(gradient, rows * std::max(hidden, gru));
}

TiledNetwork::TiledNetwork(const NetworkLayout& layout) : layout_(layout) {
  UseOneLibTorchThread();
  const auto append = [this](std::int64_t size) {
    const std::int64_t offset = folded_size_;
    folded_size_ += size;
    return offset;
  };
  for (int i = 0; i < kNumLayers; ++i) {
    const NormalisedLinear& layer = layout.layer(i);
    folded_[i].weight = append(static_cast<std::int64_t>(layer.out) * layer.in);
    folded_[i].bias = append(layer.out);
  }
  const std::int64_t gru = layout.shape().gru_size;
  folded_gru_.weight = append(3 * gru * gru);
  folded_gru_.bias = append(3 * gru);
  if (layout.shape().gaussian) folded_log_std_ = append(layout.shape().output_size);
  parameters_.resize(folded_size_);
}

int TiledNetwork::FlatRow(int layer, int row) const {
  if (layer != kGruInput) return row;
  const int gru = layout_.shape().gru_size;
  return row < gru ? row + 2 * gru : row - gru;
}

void TiledNetwork::SetParameters(const float* parameters) {
  for (int i = 0; i < kNumLayers; ++i) {
    const NormalisedLinear& layer = layout_.layer(i);
    const float* const gamma = parameters + layer.norm_weight;
    const float* const beta = parameters + layer.norm_bias;
    for (int row = 0; row < layer.out; ++row) {
      const int flat_row = FlatRow(i, row);
      const float* const weight =
          parameters + layer.weight + static_cast<std::int64_t>(flat_row) * layer.in;
      float* const folded =
          parameters_.data() + folded_[i].weight + static_cast<std::int64_t>(row) * layer.in;
      double bias = parameters[layer.bias + flat_row];
      for (int j = 0; j < layer.in; ++j) {
        folded[j] = weight[j] * gamma[j];
        bias += static_cast<double>(weight[j]) * beta[j];
      }
      parameters_[folded_[i].bias + row] = static_cast<float>(bias);
    }
  }
  const std::int64_t gru = layout_.shape().gru_size;
  std::copy_n(parameters + layout_.gru_weight(), 3 * gru * gru,
              parameters_.begin() + folded_gru_.weight);
  std::copy_n(parameters + layout_.gru_bias(), 3 * gru, parameters_.begin() + folded_gru_.bias);
  if (layout_.shape().gaussian) {
    std::copy_n(parameters + layout_.log_std(), layout_.shape().output_size,
                parameters_.begin() + folded_log_std_);
  }
}

void TiledNetwork::HiddenForward(int layer, const float* in, std::int64_t rows,
                                 NetworkWorkspace::HiddenRows& out) const {
  const NormalisedLinear& map = layout_.layer(layer);
  MatMul(Rows(in, rows, map.in), Transpose::kNo,
         Rows(parameters_.data() + folded_[layer].weight, map.out, map.in), Transpose::kYes, false,
         Rows(out.normalised.data(), rows, map.out));
  BiasReluNormalise(rows, map.out, parameters_.data() + folded_[layer].bias, out.normalised.data(),
                    out.inverse_std.data(), out.zero_level.data());
}

void TiledNetwork::Forward(const SequenceTile& tile, NetworkWorkspace& workspace) const {
  const NetworkShape& shape = layout_.shape();
  const std::int64_t rows = tile.rows(), batch = tile.batch, gru = shape.gru_size;
  const std::int64_t stride = GateStride(shape);
  const float* const weights = parameters_.data();
  workspace.Reserve(shape, tile.steps, tile.batch);
  auto& hidden = workspace.hidden_;

  NormaliseRows(rows, shape.observation_size, tile.observation, workspace.observation_.data());
  HiddenForward(kFirstLayer, workspace.observation_.data(), rows, hidden[0]);
  HiddenForward(kSecondLayer, hidden[0].normalised.data(), rows, hidden[1]);
  MatMul(Rows(hidden[1].normalised.data(), rows, shape.hidden_size), Transpose::kNo,
         Rows(weights + folded_[kGruInput].weight, 3 * gru, shape.hidden_size), Transpose::kYes,
         false, Rows(workspace.gates_.data(), rows, 3 * gru, stride));
  for (int step = 0; step < tile.steps; ++step) {
    const std::int64_t first = step * batch;
    const float* const last =
        step == 0 ? tile.initial_state : workspace.state_.data() + (first - batch) * gru;
    float* const previous = workspace.previous_state_.data() + first * gru;
    ScaleRows(batch, shape.gru_size, tile.keep + first, last, previous);
    MatMul(Rows(previous, batch, gru), Transpose::kNo,
           Rows(weights + folded_gru_.weight, 3 * gru, gru), Transpose::kYes, false,
           Rows(workspace.hidden_product_.data(), batch, 3 * gru));
    GruForward(batch, shape.gru_size, weights + folded_[kGruInput].bias, weights + folded_gru_.bias,
               workspace.hidden_product_.data(), previous, workspace.gates_.data() + first * stride,
               stride, workspace.state_.data() + first * gru);
  }
  NormaliseWithStd(rows, shape.gru_size, workspace.state_.data(),
                   workspace.normalised_state_.data(), workspace.state_inverse_std_.data());
  HiddenForward(kThirdLayer, workspace.normalised_state_.data(), rows, hidden[2]);
  HiddenForward(kFourthLayer, hidden[2].normalised.data(), rows, hidden[3]);
  MatMul(Rows(hidden[3].normalised.data(), rows, shape.hidden_size), Transpose::kNo,
         Rows(weights + folded_[kHead].weight, shape.output_size, shape.hidden_size),
         Transpose::kYes, false, Rows(workspace.output_.data(), rows, shape.output_size));
  AddBias(rows, shape.output_size, weights + folded_[kHead].bias, workspace.output_.data());
}

void TiledNetwork::MapBackward(int layer, const float* in, const float* output_gradient,
                               std::int64_t rows, float* folded_gradient,
                               float* input_gradient) const {
  const NormalisedLinear& map = layout_.layer(layer);
  const std::int64_t stride = layer == kGruInput ? GateStride(layout_.shape()) : map.out;
  const MatrixView gradient = Rows(output_gradient, rows, map.out, stride);
  MatMul(gradient, Transpose::kYes, Rows(in, rows, map.in), Transpose::kNo, true,
         Rows(folded_gradient + folded_[layer].weight, map.out, map.in));
  if (input_gradient == nullptr) return;
  MatMul(gradient, Transpose::kNo,
         Rows(parameters_.data() + folded_[layer].weight, map.out, map.in), Transpose::kNo, false,
         Rows(input_gradient, rows, map.in));
}

void TiledNetwork::Backward(const SequenceTile& tile, const float* output_gradient,
                            NetworkWorkspace& workspace, float* folded_gradient) const {
  const NetworkShape& shape = layout_.shape();
  const std::int64_t rows = tile.rows(), batch = tile.batch, gru = shape.gru_size;
  const std::int64_t stride = GateStride(shape);
  const auto& hidden = workspace.hidden_;
  float* const even = workspace.gradient_[0].data();
  float* const odd = workspace.gradient_[1].data();
  const auto through_relu = [&](int layer, const NetworkWorkspace::HiddenRows& out,
                                float* gradient) {
    BiasReluNormaliseBackward(rows, shape.hidden_size, out.normalised.data(),
                              out.inverse_std.data(), out.zero_level.data(), gradient,
                              folded_gradient + folded_[layer].bias);
  };

  AddBiasGradient(rows, shape.output_size, output_gradient, folded_gradient + folded_[kHead].bias);
  MapBackward(kHead, hidden[3].normalised.data(), output_gradient, rows, folded_gradient, even);
  through_relu(kFourthLayer, hidden[3], even);
  MapBackward(kFourthLayer, hidden[2].normalised.data(), even, rows, folded_gradient, odd);
  through_relu(kThirdLayer, hidden[2], odd);
  MapBackward(kThirdLayer, workspace.normalised_state_.data(), odd, rows, folded_gradient, even);
  NormaliseBackward(rows, shape.gru_size, workspace.normalised_state_.data(),
                    workspace.state_inverse_std_.data(), even);

  float* const gates = workspace.gates_.data();
  for (int step = tile.steps - 1; step >= 0; --step) {
    const std::int64_t first = step * batch;
    float* const state_gradient = even + first * gru;
    GruBackward(batch, shape.gru_size, workspace.previous_state_.data() + first * gru,
                gates + first * stride, stride, state_gradient);
    if (step == 0) break;
    MatMul(Rows(gates + first * stride + gru, batch, 3 * gru, stride), Transpose::kNo,
           Rows(parameters_.data() + folded_gru_.weight, 3 * gru, gru), Transpose::kNo, true,
           Rows(state_gradient, batch, gru));
    AddScaledRows(batch, shape.gru_size, tile.keep + first, state_gradient,
                  state_gradient - batch * gru);
  }
  MatMul(Rows(gates + gru, rows, 3 * gru, stride), Transpose::kYes,
         Rows(workspace.previous_state_.data(), rows, gru), Transpose::kNo, true,
         Rows(folded_gradient + folded_gru_.weight, 3 * gru, gru));
  AddColumnSums(rows, 3 * shape.gru_size, gates, stride, folded_gradient + folded_[kGruInput].bias);
  AddColumnSums(rows, 3 * shape.gru_size, gates + gru, stride, folded_gradient + folded_gru_.bias);
  MapBackward(kGruInput, hidden[1].normalised.data(), gates, rows, folded_gradient, odd);

  through_relu(kSecondLayer, hidden[1], odd);
  MapBackward(kSecondLayer, hidden[0].normalised.data(), odd, rows, folded_gradient, even);
  through_relu(kFirstLayer, hidden[0], even);
  MapBackward(kFirstLayer, workspace.observation_.data(), even, rows, folded_gradient, nullptr);
}

void TiledNetwork::UnfoldGradient(const float* parameters, const float* folded_gradient,
                                  float* gradient) const {
  for (int i = 0; i < kNumLayers; ++i) {
    const NormalisedLinear& layer = layout_.layer(i);
    const float* const gamma = parameters + layer.norm_weight;
    const float* const beta = parameters + layer.norm_bias;
    AlignedVector<double> gamma_gradient(layer.in, 0.0), beta_gradient(layer.in, 0.0);
    for (int row = 0; row < layer.out; ++row) {
      const std::int64_t flat =
          layer.weight + static_cast<std::int64_t>(FlatRow(i, row)) * layer.in;
      const float* const weight = parameters + flat;
      const float* const folded =
          folded_gradient + folded_[i].weight + static_cast<std::int64_t>(row) * layer.in;
      const float bias_gradient = folded_gradient[folded_[i].bias + row];
      for (int j = 0; j < layer.in; ++j) {
        gradient[flat + j] = folded[j] * gamma[j] + bias_gradient * beta[j];
        gamma_gradient[j] += static_cast<double>(weight[j]) * folded[j];
        beta_gradient[j] += static_cast<double>(weight[j]) * bias_gradient;
      }
      gradient[layer.bias + FlatRow(i, row)] = bias_gradient;
    }
    for (int j = 0; j < layer.in; ++j) {
      gradient[layer.norm_weight + j] = static_cast<float>(gamma_gradient[j]);
      gradient[layer.norm_bias + j] = static_cast<float>(beta_gradient[j]);
    }
  }
  const std::int64_t gru = layout_.shape().gru_size;
  std::copy_n(folded_gradient + folded_gru_.weight, 3 * gru * gru, gradient + layout_.gru_weight());
  std::copy_n(folded_gradient + folded_gru_.bias, 3 * gru, gradient + layout_.gru_bias());
  if (layout_.shape().gaussian) {
    std::copy_n(folded_gradient + folded_log_std_, layout_.shape().output_size,
                gradient + layout_.log_std());
  }
}

}  // namespace skein
