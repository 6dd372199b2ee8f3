#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "train/learner_config.h"

namespace skein {

/// Sizes of one recurrent network: LayerNorm on the observation; Linear, ReLU, LayerNorm twice;
/// GRU, LayerNorm; Linear, ReLU, LayerNorm twice; linear head. Read as six affine maps, each behind
/// a LayerNorm, with a GRU on the third (section "Learning settings" of the NeuralPlane paper).
struct NetworkShape {
  int observation_size = 0;
  int hidden_size = 0;
  int gru_size = 0;
  int output_size = 0;
  bool gaussian = false;  ///< has a state-independent log standard deviation per output (actor)
};

bool operator==(const NetworkShape& a, const NetworkShape& b);

/// A LayerNorm over `in` values followed by an affine map to `out` values; offsets in floats.
/// Weights are row-major [out][in].
struct NormalisedLinear {
  int in = 0, out = 0;
  std::int64_t norm_weight = 0, norm_bias = 0, weight = 0, bias = 0;
};

/// Indices of the six NormalisedLinear of a network.
enum NetworkLayer {
  kFirstLayer,
  kSecondLayer,
  kGruInput,  ///< 3 * gru_size rows, gates in the order reset, update, new
  kThirdLayer,
  kFourthLayer,
  kHead,
  kNumLayers,
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
  /// Throws Error unless all sizes are positive and hidden_size and gru_size are multiples of 16
  /// (whole vectors of every SIMD target).
  explicit NetworkLayout(const NetworkShape& shape);

  const NetworkShape& shape() const { return shape_; }
  std::int64_t size() const { return size_; }
  const NormalisedLinear& layer(int index) const { return layers_[index]; }
  std::int64_t gru_weight() const {
    return gru_weight_;
  }                                                    ///< [3 gru_size][gru_size], gates r, z, n
  std::int64_t gru_bias() const { return gru_bias_; }  ///< [3 gru_size]
  std::int64_t log_std() const { return log_std_; }    ///< [output_size]; only if gaussian
  /// Every parameter, in the order of the flat vector, without gaps.
  const std::vector<ParameterSlice>& slices() const { return slices_; }

 private:
  std::int64_t Append(const std::string& name, std::vector<std::int64_t> shape);

  NetworkShape shape_;
  std::int64_t size_ = 0;
  std::array<NormalisedLinear, kNumLayers> layers_;
  std::int64_t gru_weight_ = 0, gru_bias_ = 0, log_std_ = 0;
  std::vector<ParameterSlice> slices_;
};

NetworkShape ActorShape(const NetworkConfig& config, int observation_size, int action_size);
NetworkShape CriticShape(const NetworkConfig& config, int observation_size);

/// Streams of InitialParameters.
inline constexpr std::uint32_t kActorStream = 0, kCriticStream = 1;

/// Fresh parameters: orthogonal weights (gain sqrt 2 before a ReLU, 1 in each gate of the GRU,
/// `head_scale` in the head), zero biases, unit LayerNorms, `log_std` throughout. A function of its
/// arguments alone; `stream` tells the networks of one seed apart.
std::vector<float> InitialParameters(const NetworkLayout& layout, double head_scale, double log_std,
                                     std::uint64_t seed, std::uint32_t stream);

/// Floating-point operations (a multiply-add is two) of the products of one forward pass per
/// sample.
double ForwardFlops(const NetworkShape& shape);

}  // namespace skein
