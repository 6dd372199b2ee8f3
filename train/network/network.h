// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "train/network/network_config.h"

namespace skein {

/// Shape of one recurrent network: LayerNorm on the observation; `hidden_layers` of Linear,
/// activation, LayerNorm; `gru_layers` of a GRU, each reading the state of the one before it;
/// LayerNorm; as many hidden layers again; linear head. Read as linear layers, each behind a
/// LayerNorm, with the GRU on the one in the middle (the NeuralPlane paper's learning settings have
/// two hidden layers on each side and one GRU).
struct NetworkShape {
  int observation_size = 0;
  int hidden_size = 0;
  int gru_size = 0;
  int output_size = 0;
  bool gaussian = false;  ///< has a state-independent log standard deviation per output (actor)
  int hidden_layers = 2;
  int gru_layers = 1;
  Activation activation = Activation::kRelu;

  /// Floats of recurrent state of a sequence: [gru_layers][gru_size].
  int state_size() const { return gru_layers * gru_size; }
};

bool operator==(const NetworkShape& a, const NetworkShape& b);

/// A LayerNorm over `in` values followed by a linear layer to `out` values; offsets in floats.
/// Weights are row-major [out][in].
struct NormalisedLinear {
  int in = 0, out = 0;
  std::int64_t norm_weight = 0, norm_bias = 0, weight = 0, bias = 0;
};

/// The linear layers of one GRU layer; offsets in floats. Rows of the weights, [3 gru_size][in],
/// are the gates in the order reset, update, new.
struct GruLayer {
  int in = 0;
  std::int64_t input_weight = 0, input_bias = 0;
  std::int64_t hidden_weight = 0, hidden_bias = 0;
};

/// A named part of the flat parameter vector.
struct ParameterSlice {
  std::string name;
  std::vector<std::int64_t> shape;
  std::int64_t offset = 0;
};

/// Where each parameter of a network lies in its one flat float32 vector.
class NetworkLayout {
 public:
  /// Throws Error unless sizes are positive and depths and widths within kMaxHiddenLayers,
  /// kMaxGruLayers and kMaxWidth.
  explicit NetworkLayout(const NetworkShape& shape);

  const NetworkShape& shape() const { return shape_; }
  std::int64_t size() const { return size_; }

  /// The linear layers behind LayerNorms from the observation to the output: hidden layers, the
  /// first GRU layer's input, hidden layers, head.
  const std::vector<NormalisedLinear>& layers() const { return layers_; }
  const NormalisedLinear& layer(int index) const { return layers_[index]; }
  int gru_input() const { return shape_.hidden_layers; }     ///< index of the first GRU's input
  int head() const { return 2 * shape_.hidden_layers + 1; }  ///< index of the last layer
  /// The GRU layers; the first one's input is layer(gru_input()).
  const std::vector<GruLayer>& gru_layers() const { return gru_layers_; }
  std::int64_t log_std() const { return log_std_; }  ///< [output_size]; only if gaussian
  /// Every parameter, in the order of the flat vector, without gaps.
  const std::vector<ParameterSlice>& slices() const { return slices_; }

 private:
  std::int64_t Append(const std::string& name, std::vector<std::int64_t> shape);
  void AppendLinear(const std::string& name, int in, int out);
  void AppendGru();

  NetworkShape shape_;
  std::int64_t size_ = 0;
  std::vector<NormalisedLinear> layers_;
  std::vector<GruLayer> gru_layers_;
  std::int64_t log_std_ = 0;
  std::vector<ParameterSlice> slices_;
};

NetworkShape ActorShape(const NetworkConfig& config, int observation_size, int action_size);
NetworkShape CriticShape(const NetworkConfig& config, int observation_size);

/// Streams of InitialParameters.
inline constexpr std::uint32_t kActorStream = 0, kCriticStream = 1;

/// Fresh parameters: orthogonal weights (before an activation with the gain that keeps the second
/// moment of Gaussian values, sqrt 2 for ReLU; 1 in each gate of the GRU, `head_scale` in the
/// head), zero biases, unit LayerNorms, `log_std` throughout. A function of its arguments alone;
/// `stream` tells the networks of one seed apart.
std::vector<float> InitialParameters(const NetworkLayout& layout, double head_scale, double log_std,
                                     std::uint64_t seed, std::uint32_t stream);

/// Floating-point operations (a multiply-add is two) of the products of one forward pass per
/// sample: every matrix of the layout meets every sample once.
double ForwardFlops(const NetworkLayout& layout);

/// The same of one backward pass, of a sample in chunks of `steps`: every matrix meets every sample
/// for its own gradient and for the one with respect to its input. Left out is what no gradient of
/// parameters needs (with LayerNorms folded into the matrices, as in FusedNetwork): the gradient
/// with respect to the observation, and to the states that chunks begin with.
double BackwardFlops(const NetworkLayout& layout, int steps);

}  // namespace skein
