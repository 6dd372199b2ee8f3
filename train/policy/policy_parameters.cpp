// SPDX-License-Identifier: Apache-2.0
#include "train/policy/policy_parameters.h"

#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/field_list.h"
#include "envs/env_config.h"
#include "train/files/legacy_names.h"
#include "train/files/tensor_access.h"
#include "train/network/network_config.h"
#include "train/policy/low_level_file.h"

namespace skein {
namespace {

constexpr const char* kFormatKey = "policy.format";
constexpr const char* kFormat = "skein-policy-2";
/// Of version 0.1, which had other names for low-level policies (train/files/legacy_names.h).
constexpr const char* kOldFormat = "skein-policy-1";
constexpr const char* kHiddenLayersKey = "policy.hidden_layers";
constexpr const char* kGruLayersKey = "policy.gru_layers";
constexpr const char* kActivationKey = "policy.activation";
constexpr const char* kTaskKey = "policy.task";
constexpr const char* kTaskFileKey = "policy.task_file";
constexpr const char* kEnvironmentPrefix = "policy.env.";

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
  return WholeNumberIn(file, path, key, 1, kMaxWidth);
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

NetworkConfig NetworkConfigIn(const TensorFile& file, const std::string& path) {
  NetworkConfig config;
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
  return config;
}

/// The actor's flat parameters.
std::vector<float> ActorIn(const TensorFile& file, const std::string& path,
                           const NetworkLayout& layout) {
  std::vector<float> parameters;
  for (const ParameterSlice& slice : layout.slices()) {
    const std::vector<float> values =
        LoadTensor<float>(file, path, "actor/" + slice.name, slice.shape);
    parameters.insert(parameters.end(), values.begin(), values.end());
  }
  for (const float value : parameters) {
    if (!std::isfinite(value)) {
      throw Error(path + ": the policy has parameters that are not finite");
    }
  }
  return parameters;
}

}  // namespace

void StorePolicy(const RecurrentPolicy::Parameters& parameters, TensorFile& file) {
  auto& metadata = file.metadata;
  metadata[kFormatKey] = kFormat;
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
  if (!parameters.task_file.empty()) metadata[kTaskFileKey] = parameters.task_file;
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

std::shared_ptr<const RecurrentPolicy::Parameters> LoadPolicy(TensorFile file,
                                                              const std::string& path) {
  const std::string format = Metadata(file, path, kFormatKey);
  if (format != kFormat && format != kOldFormat) {
    throw Error(path + ": its policy format is \"" + format + "\"; this program reads \"" +
                kFormat + "\" and \"" + kOldFormat + "\"");
  }
  TakeCurrentNames(file);
  auto parameters = std::make_shared<RecurrentPolicy::Parameters>();
  parameters->config = NetworkConfigIn(file, path);
  parameters->shape = ActorShape(parameters->config, SizeIn(file, path, "policy.observation_size"),
                                 SizeIn(file, path, "policy.action_size"));
  parameters->action_repeat =
      WholeNumberIn(file, path, "policy.action_repeat", 1, kMaxActionRepeat);
  if (Has(file, kTaskKey)) parameters->task = Metadata(file, path, kTaskKey);
  if (Has(file, kTaskFileKey)) parameters->task_file = Metadata(file, path, kTaskFileKey);
  parameters->environment = ExtractPrefix(file.metadata, kEnvironmentPrefix);
  EnvConfig any;
  RenameFormerKeys(FieldsOf(any), &parameters->environment);
  parameters->values = ActorIn(file, path, NetworkLayout(parameters->shape));
  parameters->low_level = LoadLowLevelPolicy(std::move(file), path);
  return parameters;
}

}  // namespace skein
