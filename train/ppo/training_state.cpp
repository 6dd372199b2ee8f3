// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/training_state.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "base/field_list.h"
#include "base/fnv_hash.h"
#include "simd/target.h"
#include "train/files/legacy_names.h"
#include "train/files/tensor_access.h"
#include "train/policy/low_level_file.h"
#include "train/policy/policy_parameters.h"
#include "train/ppo/actor_critic.h"

namespace skein {
namespace {

constexpr const char* kFormatKey = "checkpoint.format";
constexpr const char* kFormat = "skein-checkpoint-2";
/// Of version 0.1, which had other names for some tensors (train/files/legacy_names.h).
constexpr const char* kOldFormat = "skein-checkpoint-1";
constexpr const char* kConfigPrefix = "config.";
/// A tensor of one number, only in checkpoints of an adapted learning rate.
constexpr const char* kAdaptedLearningRate = "adapted_learning_rate";
/// What is trained where the policy is the mean of it.
constexpr const char* kTrainedActor = "trained_actor/parameters";

/// Calls visit(name, vector) for each array of the state that is stored whole.
template <typename State, typename Visit>
void VisitFloats(State& state, const Visit& visit) {
  visit("critic/parameters", state.critic);
  visit("actor_adam/first_moment", state.actor_adam.first_moment);
  visit("actor_adam/second_moment", state.actor_adam.second_moment);
  visit("critic_adam/first_moment", state.critic_adam.first_moment);
  visit("critic_adam/second_moment", state.critic_adam.second_moment);
  visit("recurrent/actor", state.recurrent.actor);
  visit("recurrent/critic", state.recurrent.critic);
  visit("recurrent/not_done", state.recurrent.not_done);
}

std::array<std::uint64_t, 5> Counters(const TrainingState& state) {
  return {state.iteration, state.policy_steps, static_cast<std::uint64_t>(state.actor_adam.step),
          static_cast<std::uint64_t>(state.critic_adam.step), state.popart.started ? 1u : 0u};
}

/// Throws Error unless this version reads the format.
void RequireKnownFormat(const TensorFile& file, const std::string& path) {
  const auto format = file.metadata.find(kFormatKey);
  if (format == file.metadata.end() ||
      (format->second != kFormat && format->second != kOldFormat)) {
    throw Error(path + ": not a checkpoint of this version of Skein (\"" + kFormat + "\")");
  }
}

/// Throws Error on counters beyond those of the longest training (run.total_steps): what is
/// computed of them would overflow.
void CheckCounters(const TrainingState& state, const TrainConfig& config, const std::string& path) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
  const std::uint64_t flown_at_once =
      static_cast<std::uint64_t>(config.ppo.num_aircraft) * config.env.action_repeat;
  const std::uint64_t most_policy_steps = kMost / flown_at_once + config.ppo.rollout_steps;
  const auto counters = Counters(state);
  if (state.policy_steps > most_policy_steps ||
      *std::max_element(counters.begin(), counters.end()) > kMost) {
    throw Error(path + ": damaged: it counts more steps than any training has");
  }
}

std::array<double, 4> Scalars(const TrainingState& state) {
  constexpr double kFormerReturn = 0;  // of the best evaluation, which no longer counts
  return {state.popart.mean, state.popart.mean_square, state.best_success_rate, kFormerReturn};
}

/// The configuration that the checkpoint was made with, by today's names.
std::map<std::string, std::string> StoredConfig(const TensorFile& file) {
  std::map<std::string, std::string> stored = ExtractPrefix(file.metadata, kConfigPrefix);
  TrainConfig any;
  RenameFormerKeys(FieldsOf(any), &stored);
  return stored;
}

void RequireSameConfig(const TensorFile& file, const std::string& path, const TrainConfig& config) {
  const std::map<std::string, std::string> described = DescribeConfig(config);
  const std::map<std::string, std::string> stored = StoredConfig(file);
  for (const auto& [name, value] : described) {
    const auto found = stored.find(name);
    if (found == stored.end()) {
      throw Error(path + ": the checkpoint does not say what " + name + " was");
    }
    if (found->second != value) {
      throw Error(path + ": made with " + name + " = " + found->second +
                  ", but the configuration says " + value);
    }
  }
  for (const auto& [name, value] : stored) {
    if (described.count(name) == 0) {
      throw Error(path + ": made with " + name + " = " + value +
                  ", but the configuration has none of it");
    }
  }
}

}  // namespace

std::map<std::string, std::string> DescribeConfig(const TrainConfig& config) {
  TrainConfig listed = config;
  std::map<std::string, std::string> described;
  for (const Field& field : FieldsOf(listed)) {
    if (field.is_off || !field.IsOf(config.env.task)) continue;
    described[field.key] = field.ValueText(ExactText);
  }
  return described;
}

TensorFile StoreCheckpoint(const TrainConfig& config, const NetworkLayout& actor,
                           const TrainingState& state) {
  TensorFile file;
  file.metadata[kFormatKey] = kFormat;
  file.metadata[kSimdTargetKey] = Name(simd::ActiveTarget());
  for (const auto& [name, value] : DescribeConfig(config)) {
    file.metadata[kConfigPrefix + name] = value;
  }
  const bool averages = config.ppo.average_iterations > 0;
  StorePolicy(*PolicyInTraining(config, actor.shape(), averages ? state.mean_actor : state.actor),
              file);
  VisitFloats(state, [&](const char* name, const std::vector<float>& values) {
    StoreTensor(file, name, {static_cast<std::int64_t>(values.size())}, values.data(),
                values.size());
  });
  StoreTensor(file, "env", {static_cast<std::int64_t>(state.env.size())}, state.env.data(),
              state.env.size());
  const auto counters = Counters(state);
  StoreTensor(file, "counters", {counters.size()}, counters.data(), counters.size());
  const auto scalars = Scalars(state);
  StoreTensor(file, "scalars", {scalars.size()}, scalars.data(), scalars.size());
  if (config.ppo.target_kl > 0) {
    StoreTensor(file, kAdaptedLearningRate, {1}, &state.adapted_learning_rate, 1);
  }
  if (averages) {
    StoreTensor(file, kTrainedActor, {static_cast<std::int64_t>(state.actor.size())},
                state.actor.data(), state.actor.size());
  }
  return file;
}

TrainingState LoadCheckpoint(TensorFile file, const std::string& path, const TrainConfig& config,
                             const NetworkLayout& actor, const NetworkLayout& critic) {
  RequireKnownFormat(file, path);
  TakeCurrentNames(file);
  if (file.metadata.find(kSimdTargetKey) == file.metadata.end()) {
    throw Error(path + ": the checkpoint does not say on which SIMD target it was made");
  }
  RequireSameConfig(file, path, config);
  const std::shared_ptr<const RecurrentPolicy::Parameters> policy = LoadPolicy(file, path);
  if (!(policy->shape == actor.shape())) {
    throw Error(path + ": its policy has other sizes than the configuration's");
  }
  if (!IsSamePolicy(policy->low_level.get(), config.low_level.get())) {
    throw Error(path + ": made with another low-level policy than the one that flies now");
  }
  TrainingState state;
  state.actor = policy->values;
  const std::int64_t states =
      static_cast<std::int64_t>(config.ppo.num_aircraft) * actor.shape().state_size();
  const std::map<std::string, std::int64_t> sizes{{"critic/parameters", critic.size()},
                                                  {"actor_adam/first_moment", actor.size()},
                                                  {"actor_adam/second_moment", actor.size()},
                                                  {"critic_adam/first_moment", critic.size()},
                                                  {"critic_adam/second_moment", critic.size()},
                                                  {"recurrent/actor", states},
                                                  {"recurrent/critic", states},
                                                  {"recurrent/not_done", config.ppo.num_aircraft}};
  VisitFloats(state, [&](const char* name, std::vector<float>& values) {
    values = LoadTensor<float>(file, path, name, {sizes.at(name)});
  });
  state.env = LoadTensor<std::uint32_t>(file, path, "env");
  const std::vector<std::uint64_t> counters = LoadTensor<std::uint64_t>(
      file, path, "counters", {std::tuple_size_v<decltype(Counters(state))>});
  state.iteration = counters[0];
  state.policy_steps = counters[1];
  state.actor_adam.step = static_cast<std::int64_t>(counters[2]);
  state.critic_adam.step = static_cast<std::int64_t>(counters[3]);
  state.popart.started = counters[4] != 0;
  CheckCounters(state, config, path);
  const std::vector<double> scalars =
      LoadTensor<double>(file, path, "scalars", {std::tuple_size_v<decltype(Scalars(state))>});
  state.popart.mean = scalars[0];
  state.popart.mean_square = scalars[1];
  state.best_success_rate = scalars[2];
  if (config.ppo.target_kl > 0) {
    state.adapted_learning_rate = LoadTensor<double>(file, path, kAdaptedLearningRate, {1})[0];
  }
  if (config.ppo.average_iterations > 0) {
    state.mean_actor =
        std::exchange(state.actor, LoadTensor<float>(file, path, kTrainedActor, {actor.size()}));
  }
  return state;
}

StartingNetworks LoadNetworks(const std::string& path, const TrainConfig& config,
                              const NetworkLayout& actor, const NetworkLayout& critic) {
  const TensorFile file = TensorFile::Read(path);
  const std::shared_ptr<const RecurrentPolicy::Parameters> policy = LoadPolicy(file, path);
  if (!(policy->shape == actor.shape())) {
    throw Error(path +
                ": its networks have other sizes, or another activation, than the configuration's "
                "(network.*)");
  }
  if (policy->config.tanh_mean != config.network.tanh_mean) {
    throw Error(path + ": was made with network.tanh_mean = " +
                (policy->config.tanh_mean ? "true" : "false") +
                ", and the configuration says otherwise");
  }
  RecurrentPolicy(policy).CheckMadeFor(config.env, path);
  StartingNetworks networks;
  networks.actor = policy->values;
  if (file.metadata.count(kFormatKey) == 0) return networks;
  RequireKnownFormat(file, path);
  const auto counters = LoadTensor<std::uint64_t>(
      file, path, "counters", {std::tuple_size_v<decltype(Counters(TrainingState()))>});
  const auto scalars = LoadTensor<double>(file, path, "scalars",
                                          {std::tuple_size_v<decltype(Scalars(TrainingState()))>});
  networks.popart = {scalars[0], scalars[1], counters[4] != 0};
  if (networks.popart.started && !config.ppo.popart) return networks;
  std::vector<float> stored = LoadTensor<float>(file, path, "critic/parameters");
  if (static_cast<std::int64_t>(stored.size()) == critic.size())
    networks.critic = std::move(stored);
  return networks;
}

std::uint64_t Hash(const TrainingState& state) {
  FnvHash hash;
  const auto add = [&hash](const auto& values) {
    hash.Add(values.data(), values.size() * sizeof(values[0]));
  };
  add(state.actor);
  VisitFloats(state, [&](const char*, const std::vector<float>& values) { add(values); });
  add(state.env);
  add(Counters(state));
  add(Scalars(state));
  if (state.adapted_learning_rate > 0) add(std::array{state.adapted_learning_rate});
  add(state.mean_actor);
  return hash.value();
}

}  // namespace skein
