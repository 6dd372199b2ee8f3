#include "train/policy.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>

#include "simd/error.h"
#include "train/policy_parameters.h"
#include "train/ppo_loss.h"
#include "train/tensor_access.h"
#include "train/tiled_network.h"

namespace skein {
namespace {

constexpr const char* kFormat = "skein-policy-1";
constexpr int kMaxSize = 1 << 14;  ///< of any layer: a file cannot ask for more memory than this

std::string Metadata(const TensorFile& file, const std::string& path, const std::string& key) {
  const auto found = file.metadata.find(key);
  if (found == file.metadata.end()) throw Error(path + ": it holds no policy (no \"" + key + "\")");
  return found->second;
}

double NumberIn(const TensorFile& file, const std::string& path, const std::string& key) {
  const std::string text = Metadata(file, path, key);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    throw Error(path + ": \"" + key + "\" is \"" + text + "\", which is no number");
  }
  return value;
}

int SizeIn(const TensorFile& file, const std::string& path, const std::string& key) {
  const double value = NumberIn(file, path, key);
  if (value < 1 || value > kMaxSize || value != std::floor(value)) {
    throw Error(path + ": \"" + key + "\" must be a whole number from 1 to " +
                std::to_string(kMaxSize));
  }
  return static_cast<int>(value);
}

}  // namespace

/// The network with its affine parts folded, beside what it was folded from.
struct Policy::Folded {
  std::shared_ptr<const Parameters> parameters;
  TiledNetwork network;
};

void StorePolicy(const Policy::Parameters& parameters, TensorFile& file) {
  auto& metadata = file.metadata;
  metadata["policy.format"] = kFormat;
  metadata["policy.hidden_size"] = std::to_string(parameters.config.hidden_size);
  metadata["policy.gru_size"] = std::to_string(parameters.config.gru_size);
  metadata["policy.tanh_mean"] = parameters.config.tanh_mean ? "1" : "0";
  metadata["policy.initial_log_std"] = ExactText(parameters.config.initial_log_std);
  metadata["policy.actor_head_scale"] = ExactText(parameters.config.actor_head_scale);
  metadata["policy.observation_size"] = std::to_string(parameters.shape.observation_size);
  metadata["policy.action_size"] = std::to_string(parameters.shape.output_size);
  metadata["policy.action_repeat"] = std::to_string(parameters.action_repeat);
  const NetworkLayout layout(parameters.shape);
  for (std::size_t i = 0; i < layout.slices().size(); ++i) {
    const ParameterSlice& slice = layout.slices()[i];
    const std::int64_t end =
        i + 1 < layout.slices().size() ? layout.slices()[i + 1].offset : layout.size();
    StoreTensor(file, "actor/" + slice.name, slice.shape, parameters.values.data() + slice.offset,
                end - slice.offset);
  }
}

std::shared_ptr<const Policy::Parameters> LoadPolicy(const TensorFile& file,
                                                     const std::string& path) {
  const std::string format = Metadata(file, path, "policy.format");
  if (format != kFormat) {
    throw Error(path + ": its policy format is \"" + format + "\"; this program reads \"" +
                kFormat + "\"");
  }
  auto parameters = std::make_shared<Policy::Parameters>();
  NetworkConfig& config = parameters->config;
  config.hidden_size = SizeIn(file, path, "policy.hidden_size");
  config.gru_size = SizeIn(file, path, "policy.gru_size");
  config.tanh_mean = NumberIn(file, path, "policy.tanh_mean") != 0;
  config.initial_log_std = NumberIn(file, path, "policy.initial_log_std");
  config.actor_head_scale = NumberIn(file, path, "policy.actor_head_scale");
  parameters->shape = ActorShape(config, SizeIn(file, path, "policy.observation_size"),
                                 SizeIn(file, path, "policy.action_size"));
  parameters->action_repeat = SizeIn(file, path, "policy.action_repeat");
  const NetworkLayout layout(parameters->shape);
  for (const ParameterSlice& slice : layout.slices()) {
    const std::vector<float> values =
        LoadTensor<float>(file, path, "actor/" + slice.name, slice.shape);
    parameters->values.insert(parameters->values.end(), values.begin(), values.end());
  }
  for (const float value : parameters->values) {
    if (!std::isfinite(value)) {
      throw Error(path + ": the policy has parameters that are not finite");
    }
  }
  return parameters;
}

Policy::Policy(const std::shared_ptr<const Parameters>& parameters) {
  auto folded =
      std::make_shared<Folded>(Folded{parameters, TiledNetwork(NetworkLayout(parameters->shape))});
  folded->network.SetParameters(parameters->values.data());
  folded_ = std::move(folded);
}

Policy Policy::Load(const std::string& path) {
  return Policy(LoadPolicy(TensorFile::Read(path), path));
}

Policy Policy::Untrained(const NetworkConfig& config, int observation_size, int action_size,
                         std::uint64_t seed, int action_repeat) {
  auto parameters = std::make_shared<Parameters>();
  parameters->config = config;
  parameters->shape = ActorShape(config, observation_size, action_size);
  parameters->action_repeat = action_repeat;
  parameters->values = InitialParameters(NetworkLayout(parameters->shape), config.actor_head_scale,
                                         config.initial_log_std, seed, kActorStream);
  return Policy(std::move(parameters));
}

void Policy::Save(const std::string& path) const {
  TensorFile file;
  StorePolicy(*folded_->parameters, file);
  file.Write(path);
}

const NetworkConfig& Policy::config() const { return folded_->parameters->config; }
int Policy::observation_size() const { return folded_->parameters->shape.observation_size; }
int Policy::action_size() const { return folded_->parameters->shape.output_size; }
int Policy::state_size() const { return folded_->parameters->shape.gru_size; }
int Policy::action_repeat() const { return folded_->parameters->action_repeat; }

void Policy::Act(int count, const float* observation, float* state, float* mean,
                 float* log_std) const {
  // One workspace per thread, kept for the next decision.
  static thread_local NetworkWorkspace workspace;
  static thread_local std::vector<float> keep;
  if (static_cast<int>(keep.size()) < count) keep.resize(count, 1.0f);
  const Parameters& parameters = *folded_->parameters;
  folded_->network.Forward({1, count, observation, state, keep.data()}, workspace);
  const std::int64_t size = parameters.shape.output_size;
  std::copy_n(workspace.state(), static_cast<std::int64_t>(count) * parameters.shape.gru_size,
              state);
  GaussianMean(count * size, parameters.config.tanh_mean, workspace.output(), mean);
  if (log_std != nullptr) {
    std::copy_n(parameters.values.begin() + folded_->network.layout().log_std(), size, log_std);
  }
}

}  // namespace skein
