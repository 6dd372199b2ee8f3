// SPDX-License-Identifier: Apache-2.0
#include "train/policy/recurrent_policy.h"

#include <algorithm>

#include "base/choice_error.h"
#include "train/files/tensor_file.h"
#include "train/network/ppo_loss.h"
#include "train/network/recurrent_network.h"
#include "train/policy/policy_environment.h"
#include "train/policy/policy_parameters.h"

namespace skein {

/// The network beside what it was made from.
struct RecurrentPolicy::Actor {
  std::shared_ptr<const Parameters> parameters;
  std::shared_ptr<const StoredPolicy> low_level;  ///< that of the parameters, on the same backend
  BackendChoice backend;
  std::unique_ptr<RecurrentNetwork> network;
};

RecurrentPolicy::RecurrentPolicy(const std::shared_ptr<const Parameters>& parameters,
                                 Backend backend) {
  auto actor = std::make_shared<Actor>();
  actor->parameters = parameters;
  if (parameters->low_level != nullptr) {
    actor->low_level = parameters->low_level->OnBackend(backend);
  }
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
                                           std::shared_ptr<const StoredPolicy> low_level) {
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
  Store(file);
  file.Write(path);
}

void RecurrentPolicy::Store(TensorFile& file) const { StorePolicy(*actor_->parameters, file); }

std::shared_ptr<const StoredPolicy> RecurrentPolicy::OnBackend(Backend backend) const {
  const BackendChoice chosen = ChooseBackend(backend, actor_->parameters->shape);
  const bool is_same = chosen.backend == actor_->backend.backend;
  return std::make_shared<const RecurrentPolicy>(is_same ? *this : WithBackend(backend));
}

double RecurrentPolicy::FlopsPerAction() const { return ForwardFlops(actor_->network->layout()); }

void RecurrentPolicy::CheckMadeFor(const EnvConfig& env, const std::string& who) const {
  const Parameters& made = *actor_->parameters;
  if (!made.task.empty() && made.task != env.task) {
    throw ChoiceError(who + " was made with env.task = " + made.task +
                      ", but is to fly with env.task = " + env.task);
  }
  CheckMadeWith(env, made.environment, who);
  if (low_level() != nullptr) CheckLowLevelMadeFor(env, *low_level(), who + "'s low-level policy");
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
const std::shared_ptr<const StoredPolicy>& RecurrentPolicy::low_level() const {
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
