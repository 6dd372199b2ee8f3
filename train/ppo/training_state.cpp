// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/training_state.h"

#include <array>
#include <utility>

#include "base/error.h"
#include "base/name_in.h"
#include "envs/tasks/task.h"
#include "simd/target.h"
#include "train/files/fnv_hash.h"
#include "train/files/legacy_names.h"
#include "train/files/tensor_access.h"
#include "train/policy/low_level_file.h"
#include "train/policy/policy_parameters.h"
#include "train/ppo/actor_critic.h"

namespace skein {
namespace {

constexpr const char* kFormat = "skein-checkpoint-2";
/// Of version 0.1, which had other names for some tensors (train/files/legacy_names.h).
constexpr const char* kOldFormat = "skein-checkpoint-1";
constexpr const char* kConfigPrefix = "config.";

std::string Text(const std::string& value) { return value; }
std::string Text(bool value) { return value ? "true" : "false"; }
std::string Text(int value) { return std::to_string(value); }
std::string Text(std::uint64_t value) { return std::to_string(value); }
std::string Text(double value) { return ExactText(value); }
std::string Text(AtmosphereModel model) { return NameIn(kAtmosphereNames, model); }
std::string Text(TrackingAxes axes) { return Name(axes); }
std::string Text(Activation activation) { return Name(activation); }
std::string Text(Backend backend) { return Name(backend); }
std::string Text(LearnerPrecision precision) { return Name(precision); }
std::string Text(FlightControlMode mode) { return NameIn(kFlightControlNames, mode); }

void DescribeEnv(const EnvConfig& env, std::map<std::string, std::string>& fields) {
  const auto add = [&](const char* name, const auto& value) {
    fields[std::string("env.") + name] = Text(value);
  };
  add("task", env.task);
  add("aircraft", env.aircraft);
  add("atmosphere", env.atmosphere);
  add("flight_control", env.flight_control);
  add("cg_chord_fraction", env.cg);
  add("engine_angular_momentum_slug_ft2_per_s", env.engine_angular_momentum);
  add("control_interval_s", env.control_interval_s);
  add("substeps", env.substeps);
  add("action_repeat", env.action_repeat);
  add("time_limit_steps", env.time_limit_steps);
  add("truncate_at_time_limit", env.truncate_at_time_limit);
  add("stagger_clocks", env.stagger_clocks);
  add("observation_noise", env.observation_noise);
  add("reward_scale", env.reward_scale);
  // What is off is not named: runs from before it existed go on.
  if (env.thrust_grows) add("thrust_growth_above_mach_1", env.thrust_grows);
  if (env.drag_rises) add("drag_rise", env.drag_rises);
  if (env.observation_noise_max > 0) add("observation_noise_max", env.observation_noise_max);
  if (env.wind.enabled()) {
    add("wind.speed_min_fps", env.wind.speed_fps.min);
    add("wind.speed_max_fps", env.wind.speed_fps.max);
    add("wind.from_min_deg", env.wind.from_deg.min);
    add("wind.from_max_deg", env.wind.from_deg.max);
    add("wind.turbulence_min_fps", env.wind.turbulence_fps.min);
    add("wind.turbulence_max_fps", env.wind.turbulence_fps.max);
    add("wind.step_at_reset", env.wind.step_at_reset);
  }
  add("initial.altitude_min_ft", env.initial.altitude_ft.min);
  add("initial.altitude_max_ft", env.initial.altitude_ft.max);
  add("initial.true_airspeed_min_fps", env.initial.true_airspeed_fps.min);
  add("initial.true_airspeed_max_fps", env.initial.true_airspeed_fps.max);
  add("initial.trimmed", env.initial.trimmed);
  // Of the tasks the one that is flown: a task added later does not keep older runs from going on.
  if (env.task == "heading") {
    add("heading.altitude_change_ft", env.heading.altitude_change_ft);
    add("heading.yaw_change_rad", env.heading.yaw_change_rad);
    add("heading.speed_change_fps", env.heading.speed_change_fps);
    add("heading.altitude_tolerance_ft", env.heading.altitude_tolerance_ft);
    add("heading.yaw_tolerance_deg", env.heading.yaw_tolerance_deg);
    add("heading.speed_tolerance_fps", env.heading.speed_tolerance_fps);
    add("heading.training_tolerance_min", env.heading.training_tolerance_min);
    add("heading.earliest_success_step", env.heading.earliest_success_step);
    add("heading.speed_error_weight", env.heading.speed_error_weight);
  } else if (env.task == "control") {
    add("control.pitch_change_rad", env.control.pitch_change_rad);
    add("control.yaw_change_rad", env.control.yaw_change_rad);
    add("control.speed_change_fps", env.control.speed_change_fps);
    add("control.pitch_tolerance_deg", env.control.pitch_tolerance_deg);
    add("control.yaw_tolerance_deg", env.control.yaw_tolerance_deg);
    add("control.speed_tolerance_fps", env.control.speed_tolerance_fps);
    add("control.training_tolerance_min", env.control.training_tolerance_min);
    add("control.reward_includes_roll", env.control.reward_includes_roll);
    add("control.speed_error_weight", env.control.speed_error_weight);
  } else if (env.task == "tracking") {
    add("tracking.distance_min_ft", env.tracking.distance_ft.min);
    add("tracking.distance_max_ft", env.tracking.distance_ft.max);
    add("tracking.azimuth_deg", env.tracking.azimuth_deg);
    add("tracking.elevation_deg", env.tracking.elevation_deg);
    add("tracking.position_tolerance_ft", env.tracking.position_tolerance_ft);
    add("tracking.training_tolerance_max", env.tracking.training_tolerance_max);
    add("tracking.error_axes", env.tracking.error_axes);
  }
  if (IsHierarchical(env.task)) {
    add("high_level.pitch_change_rad", env.high_level.pitch_change_rad);
    add("high_level.yaw_change_rad", env.high_level.yaw_change_rad);
    add("high_level.speed_change_fps", env.high_level.speed_change_fps);
    add("high_level.averages_observations", env.high_level.averages_observations);
  }
  add("termination.alpha_min_deg", env.termination.alpha_deg.min);
  add("termination.alpha_max_deg", env.termination.alpha_deg.max);
  add("termination.beta_min_deg", env.termination.beta_deg.min);
  add("termination.beta_max_deg", env.termination.beta_deg.max);
  add("termination.max_mach", env.termination.max_mach);
  add("termination.min_mach", env.termination.min_mach);
  add("termination.min_altitude_ft", env.termination.min_altitude_ft);
  add("termination.max_load_factor_g", env.termination.max_load_factor);
  add("termination.failure_reward", env.termination.failure_reward);
  add("termination.success_reward", env.termination.success_reward);
}

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

std::array<double, 4> Scalars(const TrainingState& state) {
  return {state.popart.mean, state.popart.mean_square, state.best_success_rate, state.best_return};
}

void RequireSameConfig(const TensorFile& file, const std::string& path, const TrainConfig& config) {
  const std::map<std::string, std::string> described = DescribeConfig(config);
  for (const auto& [name, value] : described) {
    const auto stored = file.metadata.find(kConfigPrefix + name);
    if (stored == file.metadata.end()) {
      throw Error(path + ": the checkpoint does not say what " + name + " was");
    }
    if (stored->second != value) {
      throw Error(path + ": made with " + name + " = " + stored->second +
                  ", but the configuration says " + value);
    }
  }
  const std::string prefix = kConfigPrefix;
  for (const auto& [key, value] : file.metadata) {
    if (key.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string name = key.substr(prefix.size());
    if (described.count(name) == 0) {
      throw Error(path + ": made with " + name + " = " + value +
                  ", but the configuration has none of it");
    }
  }
}

}  // namespace

std::map<std::string, std::string> DescribeConfig(const TrainConfig& config) {
  std::map<std::string, std::string> fields;
  DescribeEnv(config.env, fields);
  const auto add = [&](const char* name, const auto& value) { fields[name] = Text(value); };
  const NetworkConfig& network = config.network;
  add("network.hidden_layers", network.hidden_layers);
  add("network.hidden_size", network.hidden_size);
  add("network.gru_layers", network.gru_layers);
  add("network.gru_size", network.gru_size);
  add("network.activation", network.activation);
  add("network.tanh_mean", network.tanh_mean);
  add("network.initial_log_std", network.initial_log_std);
  add("network.actor_head_scale", network.actor_head_scale);
  const PpoConfig& ppo = config.ppo;
  add("ppo.num_aircraft", ppo.num_aircraft);
  add("ppo.rollout_steps", ppo.rollout_steps);
  add("ppo.chunk_length", ppo.chunk_length);
  add("ppo.epochs", ppo.epochs);
  add("ppo.minibatches", ppo.minibatches);
  add("ppo.learning_rate", ppo.learning_rate);
  add("ppo.final_learning_rate_fraction", ppo.final_learning_rate_fraction);
  add("ppo.adam_epsilon", ppo.adam_epsilon);
  add("ppo.gamma", ppo.gamma);
  add("ppo.gae_lambda", ppo.gae_lambda);
  add("ppo.clip", ppo.clip);
  add("ppo.max_gradient_norm", ppo.max_gradient_norm);
  add("ppo.entropy_coefficient", ppo.entropy_coefficient);
  add("ppo.value_coefficient", ppo.value_coefficient);
  add("ppo.clip_value_loss", ppo.clip_value_loss);
  add("ppo.normalise_advantages", ppo.normalise_advantages);
  add("ppo.popart", ppo.popart);
  add("ppo.popart_rate", ppo.popart_rate);
  add("learner.backend", config.learner.backend);
  add("learner.precision", config.learner.precision);
  add("learner.tile_samples", config.learner.tile_samples);
  add("learner.rollout_tile", config.learner.rollout_tile);
  add("evaluation.interval_iterations", config.evaluation.interval_iterations);
  add("evaluation.episodes", config.evaluation.episodes);
  add("run.total_steps", config.total_steps);
  add("run.seed", config.seed);
  return fields;
}

TensorFile StoreCheckpoint(const TrainConfig& config, const NetworkLayout& actor,
                           const TrainingState& state) {
  TensorFile file;
  file.metadata["checkpoint.format"] = kFormat;
  file.metadata[kSimdTargetKey] = Name(simd::ActiveTarget());
  for (const auto& [name, value] : DescribeConfig(config)) {
    file.metadata[kConfigPrefix + name] = value;
  }
  StorePolicy(*PolicyInTraining(config, actor.shape(), state.actor), file);
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
  return file;
}

TrainingState LoadCheckpoint(TensorFile file, const std::string& path, const TrainConfig& config,
                             const NetworkLayout& actor, const NetworkLayout& critic) {
  const auto format = file.metadata.find("checkpoint.format");
  if (format == file.metadata.end() ||
      (format->second != kFormat && format->second != kOldFormat)) {
    throw Error(path + ": not a checkpoint of this version of Skein (\"" + kFormat + "\")");
  }
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
  const std::vector<double> scalars =
      LoadTensor<double>(file, path, "scalars", {std::tuple_size_v<decltype(Scalars(state))>});
  state.popart.mean = scalars[0];
  state.popart.mean_square = scalars[1];
  state.best_success_rate = scalars[2];
  state.best_return = scalars[3];
  return state;
}

StartingNetworks LoadNetworks(const std::string& path, const TrainConfig& config,
                              const NetworkLayout& actor, const NetworkLayout& critic) {
  const TensorFile file = TensorFile::Read(path);
  const std::shared_ptr<const RecurrentPolicy::Parameters> policy = LoadPolicy(file, path);
  if (!(policy->shape == actor.shape())) {
    throw Error(path + ": its networks have other sizes than the configuration's (network.*)");
  }
  RecurrentPolicy(policy).CheckMadeFor(config.env, path);
  StartingNetworks networks;
  networks.actor = policy->values;
  if (file.metadata.count("checkpoint.format") == 0) return networks;
  const auto counters = LoadTensor<std::uint64_t>(
      file, path, "counters", {std::tuple_size_v<decltype(Counters(TrainingState()))>});
  const auto scalars = LoadTensor<double>(file, path, "scalars",
                                          {std::tuple_size_v<decltype(Scalars(TrainingState()))>});
  networks.popart = {scalars[0], scalars[1], counters[4] != 0};
  if (networks.popart.started && !config.ppo.popart) return networks;
  networks.critic = LoadTensor<float>(file, path, "critic/parameters", {critic.size()});
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
  return hash.value();
}

}  // namespace skein
