// SPDX-License-Identifier: Apache-2.0
#include "train/network/network.h"

#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "simd/random.h"

namespace skein {
namespace {

/// 1 / sqrt(E f(x)^2) for a standard normal x.
double GainBefore(Activation activation) {
  switch (activation) {
    case Activation::kRelu:
      return 1.4142135623730951;
    case Activation::kTanh:
      return 1.5925374197;
    case Activation::kElu:
      return 1.2451983007;
    case Activation::kSilu:
      return 1.6765324703;
  }
  throw Error("network.activation holds a value without a name");
}

void RequireWithin(const char* name, int value, int min, int max) {
  if (value >= min && value <= max) return;
  throw Error("network." + std::string(name) + " is " + std::to_string(value) +
              "; it must be between " + std::to_string(min) + " and " + std::to_string(max));
}

/// Rows (or, of a tall matrix, columns) orthonormal times `gain`: modified Gram-Schmidt on Gaussian
/// numbers, twice, which leaves them orthogonal to rounding.
void FillOrthogonal(int rows, int columns, double gain, simd::RandomStream& random, float* out) {
  const bool tall = rows > columns;
  const int count = tall ? columns : rows, length = tall ? rows : columns;
  std::vector<std::vector<double>> basis(count, std::vector<double>(length));
  for (auto& vector : basis) {
    for (double& value : vector) {
      const double radius = std::sqrt(-2 * std::log(1 - random.Uniform()));
      value = radius * std::cos(2 * 3.14159265358979323846 * random.Uniform());
    }
  }
  const auto dot = [length](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (int i = 0; i < length; ++i) sum += a[i] * b[i];
    return sum;
  };
  for (int i = 0; i < count; ++i) {
    for (int pass = 0; pass < 2; ++pass) {
      for (int j = 0; j < i; ++j) {
        const double projection = dot(basis[i], basis[j]);
        for (int k = 0; k < length; ++k) basis[i][k] -= projection * basis[j][k];
      }
    }
    const double scale = 1 / std::sqrt(dot(basis[i], basis[i]));
    for (double& value : basis[i]) value *= scale;
  }
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double value = tall ? basis[column][row] : basis[row][column];
      out[static_cast<std::int64_t>(row) * columns + column] = static_cast<float>(gain * value);
    }
  }
}

}  // namespace

bool operator==(const NetworkShape& a, const NetworkShape& b) {
  return a.observation_size == b.observation_size && a.hidden_size == b.hidden_size &&
         a.gru_size == b.gru_size && a.output_size == b.output_size && a.gaussian == b.gaussian &&
         a.hidden_layers == b.hidden_layers && a.gru_layers == b.gru_layers &&
         a.activation == b.activation;
}

NetworkLayout::NetworkLayout(const NetworkShape& shape) : shape_(shape) {
  if (shape.observation_size <= 0 || shape.output_size <= 0) {
    throw Error("network: observation and output sizes must be positive");
  }
  RequireWithin("hidden_layers", shape.hidden_layers, 0, kMaxHiddenLayers);
  RequireWithin("hidden_size", shape.hidden_size, 1, kMaxWidth);
  RequireWithin("gru_layers", shape.gru_layers, 1, kMaxGruLayers);
  RequireWithin("gru_size", shape.gru_size, 1, kMaxWidth);
  int width = shape.observation_size, number = 0;
  const auto append_hidden = [&] {
    for (int i = 0; i < shape.hidden_layers; ++i) {
      AppendLinear("layer" + std::to_string(++number), width, shape.hidden_size);
      width = shape.hidden_size;
    }
  };
  append_hidden();
  AppendLinear("gru_input", width, 3 * shape.gru_size);
  AppendGru();
  width = shape.gru_size;
  append_hidden();
  AppendLinear("head", width, shape.output_size);
  if (shape.gaussian) log_std_ = Append("log_std", {shape.output_size});
}

void NetworkLayout::AppendLinear(const std::string& name, int in, int out) {
  NormalisedLinear& layer = layers_.emplace_back();
  layer.in = in;
  layer.out = out;
  layer.norm_weight = Append(name + ".norm.weight", {in});
  layer.norm_bias = Append(name + ".norm.bias", {in});
  layer.weight = Append(name + ".weight", {out, in});
  layer.bias = Append(name + ".bias", {out});
}

void NetworkLayout::AppendGru() {
  const std::int64_t gru = shape_.gru_size;
  for (int i = 0; i < shape_.gru_layers; ++i) {
    GruLayer& layer = gru_layers_.emplace_back();
    const std::string name = i == 0 ? "gru" : "gru" + std::to_string(i + 1);
    if (i == 0) {
      layer.in = layers_.back().in;
      layer.input_weight = layers_.back().weight;
      layer.input_bias = layers_.back().bias;
    } else {
      layer.in = shape_.gru_size;
      layer.input_weight = Append(name + "_input.weight", {3 * gru, gru});
      layer.input_bias = Append(name + "_input.bias", {3 * gru});
    }
    layer.hidden_weight = Append(name + "_hidden.weight", {3 * gru, gru});
    layer.hidden_bias = Append(name + "_hidden.bias", {3 * gru});
  }
}

std::int64_t NetworkLayout::Append(const std::string& name, std::vector<std::int64_t> shape) {
  const std::int64_t offset = size_;
  std::int64_t count = 1;
  for (const std::int64_t extent : shape) count *= extent;
  slices_.push_back({name, std::move(shape), offset});
  size_ += count;
  return offset;
}

NetworkShape ActorShape(const NetworkConfig& config, int observation_size, int action_size) {
  NetworkShape shape = CriticShape(config, observation_size);
  shape.output_size = action_size;
  shape.gaussian = true;
  return shape;
}

NetworkShape CriticShape(const NetworkConfig& config, int observation_size) {
  NetworkShape shape;
  shape.observation_size = observation_size;
  shape.hidden_size = config.hidden_size;
  shape.gru_size = config.gru_size;
  shape.output_size = 1;
  shape.hidden_layers = config.hidden_layers;
  shape.gru_layers = config.gru_layers;
  shape.activation = config.activation;
  return shape;
}

std::vector<float> InitialParameters(const NetworkLayout& layout, double head_scale, double log_std,
                                     std::uint64_t seed, std::uint32_t stream) {
  std::vector<float> parameters(layout.size(), 0.0f);
  std::uint32_t block = 0;  // every matrix has random numbers of its own
  const auto next_random = [&] {
    return simd::RandomStream(
        {seed, stream, block++, 0, simd::RandomPurpose::kNetworkInitialisation});
  };
  const int gru = layout.shape().gru_size;
  const auto fill_gates = [&](std::int64_t offset, int in) {
    simd::RandomStream random = next_random();
    for (int gate = 0; gate < 3; ++gate) {
      FillOrthogonal(gru, in, 1, random,
                     parameters.data() + offset + static_cast<std::int64_t>(gate) * gru * in);
    }
  };
  const double gain = GainBefore(layout.shape().activation);
  for (int i = 0; i <= layout.head(); ++i) {
    const NormalisedLinear& layer = layout.layer(i);
    for (int j = 0; j < layer.in; ++j) parameters[layer.norm_weight + j] = 1;
    if (i == layout.gru_input()) {
      fill_gates(layer.weight, layer.in);
    } else {
      simd::RandomStream random = next_random();
      FillOrthogonal(layer.out, layer.in, i == layout.head() ? head_scale : gain, random,
                     parameters.data() + layer.weight);
    }
  }
  for (int i = 0; i < layout.shape().gru_layers; ++i) {
    const GruLayer& layer = layout.gru_layers()[i];
    if (i > 0) fill_gates(layer.input_weight, layer.in);
    fill_gates(layer.hidden_weight, gru);
  }
  if (layout.shape().gaussian) {
    for (int j = 0; j < layout.shape().output_size; ++j) {
      parameters[layout.log_std() + j] = static_cast<float>(log_std);
    }
  }
  return parameters;
}

double ForwardFlops(const NetworkLayout& layout) {
  double products = 0;
  for (const ParameterSlice& slice : layout.slices()) {
    if (slice.shape.size() == 2) products += static_cast<double>(slice.shape[0] * slice.shape[1]);
  }
  return 2 * products;
}

double BackwardFlops(const NetworkLayout& layout, int steps) {
  constexpr int kGates = 3;
  const NetworkShape& shape = layout.shape();
  const NormalisedLinear& first = layout.layer(0);
  const double to_observation = 2.0 * first.in * first.out;
  const double to_states = 2.0 * shape.gru_layers * kGates * shape.gru_size * shape.gru_size;
  return 2 * ForwardFlops(layout) - to_observation - to_states / steps;
}

}  // namespace skein
