// SPDX-License-Identifier: Apache-2.0
#include "train/policy/recurrent_policy.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "train/files/tensor_access.h"
#include "train/network/ppo_loss.h"
#include "train/network/recurrent_network.h"
#include "train/policy/low_level_file.h"
#include "train/policy/policy_environment.h"
#include "train/policy/policy_parameters.h"

namespace skein {
namespace {

constexpr const char* kFormat = "skein-policy-1";
constexpr const char* kHiddenLayersKey = "policy.hidden_layers";
constexpr const char* kGruLayersKey = "policy.gru_layers";
constexpr const char* kActivationKey = "policy.activation";
constexpr const char* kTaskKey = "policy.task";
constexpr const char* kEnvironmentPrefix = "policy.env.";
constexpr int kMaxSize = 1 << 14;  ///< of any layer: a file cannot ask for more memory than this

std::string Metadata(const TensorFile& file, const std::string& path, const std::string& key) {
  const auto found = file.metadata.find(key);
  if (found == file.metadata.end()) throw Error(path + ": it holds no policy (no \"" + key + "\")");
  return found->second;
}

double NumberIn(const TensorFile& file, const std::string& path, const std::string& key) {
  return ToNumber(Metadata(file, path, key), path, key);
}

int WholeNumberIn(const TensorFile& file, const std::string& path, const std::string& key, int min,
                  int max) {
  const double value = NumberIn(file, path, key);
  if (value < min || value > max || value != std::floor(value)) {
    throw Error(path + ": \"" + key + "\" must be a whole number from " + std::to_string(min) +
                " to " + std::to_string(max));
  }
  return static_cast<int>(value);
}

int SizeIn(const TensorFile& file, const std::string& path, const std::string& key) {
  return WholeNumberIn(file, path, key, 1, kMaxSize);
}

bool Has(const TensorFile& file, const char* key) { return file.metadata.count(key) > 0; }

Activation ActivationIn(const TensorFile& file, const std::string& path) {
  const std::string text = Metadata(file, path, kActivationKey);
  for (const auto& [activation, name] : kActivationNames) {
    if (text == name) return activation;
  }
  throw Error(path + ": \"" + kActivationKey + "\" is \"" + text +
              "\", which this program does not know");
}

}  // namespace

/// The network beside what it was made from.
struct RecurrentPolicy::Actor {
  std::shared_ptr<const Parameters> parameters;
  std::shared_ptr<const Policy> low_level;  ///< that of the parameters, on the same backend
  BackendChoice backend;
  std::unique_ptr<RecurrentNetwork> network;
};

void StorePolicy(const RecurrentPolicy::Parameters& parameters, TensorFile& file) {
  auto& metadata = file.metadata;
  metadata["policy.format"] = kFormat;
  metadata[kHiddenLayersKey] = std::to_string(parameters.config.hidden_layers);
  metadata[kGruLayersKey] = std::to_string(parameters.config.gru_layers);
  metadata[kActivationKey] = Name(parameters.config.activation);
  metadata["policy.hidden_size"] = std::to_string(parameters.config.hidden_size);
  metadata["policy.gru_size"] = std::to_string(parameters.config.gru_size);
  metadata["policy.tanh_mean"] = parameters.config.tanh_mean ? "1" : "0";
  metadata["policy.initial_log_std"] = ExactText(parameters.config.initial_log_std);
  metadata["policy.actor_head_scale"] = ExactText(parameters.config.actor_head_scale);
  metadata["policy.observation_size"] = std::to_string(parameters.shape.observation_size);
  metadata["policy.action_size"] = std::to_string(parameters.shape.output_size);
  metadata["policy.action_repeat"] = std::to_string(parameters.action_repeat);
  if (!parameters.task.empty()) metadata[kTaskKey] = parameters.task;
  InsertWithPrefix(parameters.environment, kEnvironmentPrefix, metadata);
  if (parameters.low_level != nullptr) StoreLowLevelPolicy(*parameters.low_level, file);
  const NetworkLayout layout(parameters.shape);
  for (std::size_t i = 0; i < layout.slices().size(); ++i) {
    const ParameterSlice& slice = layout.slices()[i];
    const std::int64_t end =
        i + 1 < layout.slices().size() ? layout.slices()[i + 1].offset : layout.size();
    StoreTensor(file, "actor/" + slice.name, slice.shape, parameters.values.data() + slice.offset,
                end - slice.offset);
  }
}

std::shared_ptr<const RecurrentPolicy::Parameters> LoadPolicy(const TensorFile& file,
                                                              const std::string& path) {
  const std::string format = Metadata(file, path, "policy.format");
  if (format != kFormat) {
    throw Error(path + ": its policy format is \"" + format + "\"; this program reads \"" +
                kFormat + "\"");
  }
  auto parameters = std::make_shared<RecurrentPolicy::Parameters>();
  NetworkConfig& config = parameters->config;
  // Files from before networks had these hold the one shape there was, which is the default.
  if (Has(file, kHiddenLayersKey)) {
    config.hidden_layers = WholeNumberIn(file, path, kHiddenLayersKey, 0, kMaxHiddenLayers);
  }
  if (Has(file, kGruLayersKey)) {
    config.gru_layers = WholeNumberIn(file, path, kGruLayersKey, 1, kMaxGruLayers);
  }
  if (Has(file, kActivationKey)) config.activation = ActivationIn(file, path);
  config.hidden_size = SizeIn(file, path, "policy.hidden_size");
  config.gru_size = SizeIn(file, path, "policy.gru_size");
  config.tanh_mean = NumberIn(file, path, "policy.tanh_mean") != 0;
  config.initial_log_std = NumberIn(file, path, "policy.initial_log_std");
  config.actor_head_scale = NumberIn(file, path, "policy.actor_head_scale");
  parameters->shape = ActorShape(config, SizeIn(file, path, "policy.observation_size"),
                                 SizeIn(file, path, "policy.action_size"));
  parameters->action_repeat = SizeIn(file, path, "policy.action_repeat");
  if (Has(file, kTaskKey)) parameters->task = Metadata(file, path, kTaskKey);
  parameters->environment = ExtractPrefix(file.metadata, kEnvironmentPrefix);
  parameters->low_level = LoadLowLevelPolicy(file, path);
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

std::shared_ptr<const Policy> OnBackend(std::shared_ptr<const Policy> pilot, Backend backend) {
  const auto* const policy = dynamic_cast<const RecurrentPolicy*>(pilot.get());
  if (policy == nullptr) return pilot;
  const BackendChoice chosen = ChooseBackend(backend, policy->parameters()->shape);
  if (chosen.backend == policy->backend().backend) return pilot;
  return std::make_shared<const RecurrentPolicy>(policy->WithBackend(backend));
}

RecurrentPolicy::RecurrentPolicy(const std::shared_ptr<const Parameters>& parameters,
                                 Backend backend) {
  auto actor = std::make_shared<Actor>();
  actor->parameters = parameters;
  actor->low_level = OnBackend(parameters->low_level, backend);
  actor->backend = ChooseBackend(backend, parameters->shape);
  actor->network = MakeNetwork(actor->backend.backend, NetworkLayout(parameters->shape));
  actor->network->SetParameters(parameters->values.data());
  actor_ = std::move(actor);
}

RecurrentPolicy RecurrentPolicy::WithBackend(Backend backend) const {
  return RecurrentPolicy(actor_->parameters, backend);
}

RecurrentPolicy RecurrentPolicy::Load(const std::string& path) {
  return RecurrentPolicy(LoadPolicy(TensorFile::Read(path), path));
}

RecurrentPolicy RecurrentPolicy::Untrained(const NetworkConfig& config, int observation_size,
                                           int action_size, std::uint64_t seed, int action_repeat,
                                           std::shared_ptr<const Policy> low_level) {
  auto parameters = std::make_shared<Parameters>();
  parameters->config = config;
  parameters->shape = ActorShape(config, observation_size, action_size);
  parameters->action_repeat = action_repeat;
  parameters->low_level = std::move(low_level);
  parameters->values = InitialParameters(NetworkLayout(parameters->shape), config.actor_head_scale,
                                         config.initial_log_std, seed, kActorStream);
  return RecurrentPolicy(std::move(parameters));
}

void RecurrentPolicy::Save(const std::string& path) const {
  TensorFile file;
  StorePolicy(*actor_->parameters, file);
  file.Write(path);
}

const NetworkConfig& RecurrentPolicy::config() const { return actor_->parameters->config; }
int RecurrentPolicy::observation_size() const { return actor_->parameters->shape.observation_size; }
const BackendChoice& RecurrentPolicy::backend() const { return actor_->backend; }
int RecurrentPolicy::action_size() const { return actor_->parameters->shape.output_size; }
int RecurrentPolicy::state_size() const { return actor_->parameters->shape.state_size(); }
int RecurrentPolicy::action_repeat() const { return actor_->parameters->action_repeat; }
EnvConfig RecurrentPolicy::EnvironmentFor(const EnvConfig& env) const {
  EnvConfig own = Policy::EnvironmentFor(env);
  AdoptView(actor_->parameters->environment, &own);
  return own;
}
const std::string& RecurrentPolicy::task() const { return actor_->parameters->task; }
const std::shared_ptr<const Policy>& RecurrentPolicy::low_level() const {
  return actor_->low_level;
}
const std::shared_ptr<const RecurrentPolicy::Parameters>& RecurrentPolicy::parameters() const {
  return actor_->parameters;
}

void RecurrentPolicy::ActionMean(int count, const float* observation, float* state, float* mean,
                                 float* log_std) const {
  // One workspace per thread, kept for the next policy step.
  static thread_local NetworkWorkspace workspace;
  static thread_local std::vector<float> not_done;
  if (static_cast<int>(not_done.size()) < count) not_done.resize(count, 1.0f);
  const Parameters& parameters = *actor_->parameters;
  actor_->network->Forward({1, count, observation, state, not_done.data()}, workspace);
  const std::int64_t size = parameters.shape.output_size;
  std::copy_n(workspace.final_state(),
              static_cast<std::int64_t>(count) * parameters.shape.state_size(), state);
  GaussianMean(count * size, parameters.config.tanh_mean, workspace.output(), mean);
  if (log_std != nullptr) {
    std::copy_n(parameters.values.begin() + actor_->network->layout().log_std(), size, log_std);
  }
}

void RecurrentPolicy::Act(int count, const float* observation, float* state, float* action) const {
  ActionMean(count, observation, state, action);
  for (int i = 0; i < count * action_size(); ++i) action[i] = std::clamp(action[i], -1.0f, 1.0f);
}

}  // namespace skein
