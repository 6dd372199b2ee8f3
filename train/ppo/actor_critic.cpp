// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/actor_critic.h"

#include <utility>

#include "envs/actions.h"
#include "train/policy/policy_environment.h"
#include "train/policy/policy_parameters.h"

namespace skein {
namespace {

constexpr double kCriticHeadScale = 1, kCriticLogStd = 0;

TrainedNetwork FreshNetwork(const TrainConfig& config, const NetworkShape& shape, Backend backend,
                            const NetworkPrecision& precision) {
  const NetworkLayout layout(shape);
  const std::vector<float> parameters =
      shape.gaussian
          ? InitialParameters(layout, config.network.actor_head_scale,
                              config.network.initial_log_std, config.seed, kActorStream)
          : InitialParameters(layout, kCriticHeadScale, kCriticLogStd, config.seed, kCriticStream);
  RateFactor rate_factor;
  // None for a factor of 1: a step that is taken apart and put together rounds.
  if (shape.gaussian && config.ppo.log_std_rate_factor != 1) {
    rate_factor = {layout.log_std(), layout.log_std() + shape.output_size,
                   config.ppo.log_std_rate_factor};
  }
  TrainedNetwork fresh{MakeNetwork(backend, layout, precision),
                       AdamOptimiser(parameters, config.ppo.adam_epsilon, rate_factor),
                       std::nullopt};
  if (shape.gaussian && !config.ppo.pedals) {
    fresh.idle_pedals.emplace(layout);
    fresh.idle_pedals->Idle(fresh.optimiser.parameters());
  }
  return fresh;
}

}  // namespace

void SetPedals(const TrainConfig& config, const NetworkLayout& layout, float* parameters) {
  if (layout.shape().output_size != kActionSize) return;
  const IdlePedals pedals(layout);
  if (!config.ppo.pedals) pedals.Idle(parameters);
  if (config.ppo.pedals && pedals.AreIdle(parameters)) {
    pedals.Free(static_cast<float>(config.network.initial_log_std), parameters);
  }
}

ActorCritic::ActorCritic(const TrainConfig& config, int observation_size, int privileged_size,
                         int action_size)
    : backend(ChooseBackend(config.learner.backend,
                            ActorShape(config.network, observation_size, action_size),
                            config.learner.precision)),
      actor(FreshNetwork(config, ActorShape(config.network, observation_size, action_size),
                         backend.backend, ActorPrecision(backend.precision))),
      critic(FreshNetwork(config, CriticShape(config.network, observation_size + privileged_size),
                          backend.backend, CriticPrecision(backend.precision))) {}

std::vector<float> ActorCritic::LogStd() const {
  const NetworkLayout& layout = actor.layout();
  const float* const log_std = actor.optimiser.parameters() + layout.log_std();
  return {log_std, log_std + layout.shape().output_size};
}

std::shared_ptr<const RecurrentPolicy::Parameters> PolicyInTraining(const TrainConfig& config,
                                                                    const NetworkShape& shape,
                                                                    std::vector<float> parameters) {
  auto policy = std::make_shared<RecurrentPolicy::Parameters>();
  policy->config = config.network;
  policy->shape = shape;
  policy->action_repeat = config.env.action_repeat;
  policy->task = config.env.task;
  if (config.env.term_task != nullptr) policy->task_file = config.env.term_task->text;
  policy->environment = PolicyEnvironment(config.env);
  policy->low_level = config.low_level;
  policy->values = std::move(parameters);
  return policy;
}

}  // namespace skein
