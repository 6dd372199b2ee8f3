#include "train/network.h"

#include <cmath>
#include <utility>

#include "simd/error.h"
#include "simd/random.h"

namespace skein {
namespace {

constexpr int kSizeGranularity = 16;
constexpr double kReluGain = 1.4142135623730951;

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
         a.gru_size == b.gru_size && a.output_size == b.output_size && a.gaussian == b.gaussian;
}

NetworkLayout::NetworkLayout(const NetworkShape& shape) : shape_(shape) {
  if (shape.observation_size <= 0 || shape.output_size <= 0) {
    throw Error("network: observation and output sizes must be positive");
  }
  for (const auto& [name, size] :
       {std::pair("hidden_size", shape.hidden_size), std::pair("gru_size", shape.gru_size)}) {
    if (size <= 0 || size % kSizeGranularity != 0) {
      throw Error("network." + std::string(name) + " is " + std::to_string(size) +
                  "; it must be a positive multiple of " + std::to_string(kSizeGranularity));
    }
  }
  const int hidden = shape.hidden_size, gru = shape.gru_size;
  const std::array<std::array<int, 2>, kNumLayers> sizes{{{shape.observation_size, hidden},
                                                          {hidden, hidden},
                                                          {hidden, 3 * gru},
                                                          {gru, hidden},
                                                          {hidden, hidden},
                                                          {hidden, shape.output_size}}};
  constexpr std::array<const char*, kNumLayers> kNames{"layer1", "layer2", "gru_input",
                                                       "layer3", "layer4", "head"};
  for (int i = 0; i < kNumLayers; ++i) {
    const std::string name = kNames[i];
    const auto [in, out] = sizes[i];
    NormalisedLinear& layer = layers_[i];
    layer.in = in;
    layer.out = out;
    layer.norm_weight = Append(name + ".norm.weight", {in});
    layer.norm_bias = Append(name + ".norm.bias", {in});
    layer.weight = Append(name + ".weight", {out, in});
    layer.bias = Append(name + ".bias", {out});
    if (i == kGruInput) {
      gru_weight_ = Append("gru_hidden.weight", {3 * gru, gru});
      gru_bias_ = Append("gru_hidden.bias", {3 * gru});
    }
  }
  if (shape.gaussian) log_std_ = Append("log_std", {shape.output_size});
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
  return {observation_size, config.hidden_size, config.gru_size, action_size, true};
}

NetworkShape CriticShape(const NetworkConfig& config, int observation_size) {
  return {observation_size, config.hidden_size, config.gru_size, 1, false};
}

std::vector<float> InitialParameters(const NetworkLayout& layout, double head_scale, double log_std,
                                     std::uint64_t seed, std::uint32_t stream) {
  std::vector<float> parameters(layout.size(), 0.0f);
  const auto random_for = [&](int block) {
    return simd::RandomStream({seed, stream, static_cast<std::uint32_t>(block), 0,
                               simd::RandomPurpose::kNetworkInitialisation});
  };
  const int gru = layout.shape().gru_size;
  for (int i = 0; i < kNumLayers; ++i) {
    const NormalisedLinear& layer = layout.layer(i);
    for (int j = 0; j < layer.in; ++j) parameters[layer.norm_weight + j] = 1;
    simd::RandomStream random = random_for(i);
    float* const weight = parameters.data() + layer.weight;
    if (i == kGruInput) {
      for (int gate = 0; gate < 3; ++gate) {
        FillOrthogonal(gru, layer.in, 1, random,
                       weight + static_cast<std::int64_t>(gate) * gru * layer.in);
      }
    } else {
      FillOrthogonal(layer.out, layer.in, i == kHead ? head_scale : kReluGain, random, weight);
    }
  }
  simd::RandomStream random = random_for(kNumLayers);
  for (int gate = 0; gate < 3; ++gate) {
    FillOrthogonal(
        gru, gru, 1, random,
        parameters.data() + layout.gru_weight() + static_cast<std::int64_t>(gate) * gru * gru);
  }
  if (layout.shape().gaussian) {
    for (int j = 0; j < layout.shape().output_size; ++j) {
      parameters[layout.log_std() + j] = static_cast<float>(log_std);
    }
  }
  return parameters;
}

double ForwardFlops(const NetworkShape& shape) {
  const double hidden = shape.hidden_size, gru = shape.gru_size;
  return 2 * (shape.observation_size * hidden + hidden * hidden + 3 * gru * hidden + 3 * gru * gru +
              gru * hidden + hidden * hidden + hidden * shape.output_size);
}

}  // namespace skein
