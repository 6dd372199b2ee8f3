// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/ppo_config.h"

#include <cstdint>
#include <string>

#include "base/error.h"
#include "base/field_list.h"

namespace skein {
namespace {

/// Far above what flushed denormals round to 0: parameters without a gradient divide 0 by it.
constexpr double kLeastAdamEpsilon = 1e-30;

void ListRolloutFields(PpoConfig& config, FieldList& list) {
  list.Add("num_aircraft", &config.num_aircraft, {1, 10000000}, "aircraft flown at once");
  list.Add("rollout_steps", &config.rollout_steps, {1, 1000000},
           "policy steps per aircraft and iteration");
  list.Add("chunk_length", &config.chunk_length, {1, 1000000},
           "steps of truncated backpropagation through time");
  list.Add("epochs", &config.epochs, {1, 1000}, "passes over each rollout");
  list.Add("minibatches", &config.minibatches, Bounds::Count(), "optimiser steps per pass");
}

void ListAdamFields(PpoConfig& config, FieldList& list) {
  list.Add("learning_rate", &config.learning_rate, Bounds::PositiveFraction(),
           "Adam's learning rate at the start");
  list.Add("final_learning_rate_fraction", &config.final_learning_rate_fraction, Bounds::Fraction(),
           "share of it at the budget's end; 1 keeps it constant; 0, to which it can fall linearly "
           "alone, leaves the last iteration without an effect");
  list.Add("learning_rate_decay", &config.learning_rate_decay, kDecayNames,
           "how it falls to that in between")
      .OffUnless(config.learning_rate_decay != Decay::kLinear);
  list.Add("target_kl", &config.target_kl, Bounds::NotNegative(),
           "an iteration's KL divergence above twice this lowers the next one's learning rate, "
           "below half of it raises it again, up to what the decay allows; 0: as the decay has it")
      .OffUnless(config.target_kl > 0);
  list.Add("critic_learning_rate", &config.critic_learning_rate, Bounds::Fraction(),
           "Adam's learning rate of the critic at the start, which falls as the other does, "
           "whatever the KL divergence; 0: the actor's. A critic that begins beside a trained "
           "policy (skein train --from) has all to learn")
      .OffUnless(config.critic_learning_rate > 0);
  list.Add("adam_epsilon", &config.adam_epsilon, {kLeastAdamEpsilon, 1}, "Adam's epsilon");
  list.Add("log_std_rate_factor", &config.log_std_rate_factor, Bounds::Positive(),
           "the actions' standard deviations learn at so many times the learning rate")
      .OffUnless(config.log_std_rate_factor != 1);
  list.Add("average_iterations", &config.average_iterations, {0, 1000000},
           "the policy that is evaluated and kept is the running mean of the actor over about so "
           "many iterations; 0: the actor after the last one")
      .OffUnless(config.average_iterations > 0);
}

}  // namespace

void ListFields(PpoConfig& config, FieldList& list) {
  ListRolloutFields(config, list);
  ListAdamFields(config, list);
  list.Add("gamma", &config.gamma, Bounds::Fraction(), "discount per policy step");
  list.Add("gae_lambda", &config.gae_lambda, Bounds::Fraction(),
           "lambda of the generalised advantage estimate");
  list.Add("clip", &config.clip, Bounds::Positive(), "clip range of the probability ratio");
  list.Add("max_gradient_norm", &config.max_gradient_norm, Bounds::Positive(),
           "largest gradient norm, actor and critic separately");
  list.Add("entropy_coefficient", &config.entropy_coefficient, Bounds::NotNegative(),
           "weight of the entropy bonus");
  list.Add("action_smoothness_coefficient", &config.action_smoothness_coefficient,
           Bounds::NotNegative(),
           "weight in the loss of the mean squared change of the mean action from one policy step "
           "to the next (CAPS); 0: none")
      .OffUnless(config.action_smoothness_coefficient > 0);
  list.Add(
          "handling_ramp", &config.handling_ramp, Bounds::Fraction(),
          "share of the budget over which env.reward's costs and the action smoothness grow from 0 "
          "to their weights; 0: from the start")
      .OffUnless(config.handling_ramp > 0);
  list.Add("condition_ramp", &config.condition_ramp, Bounds::Fraction(),
           "share of the budget over which initial altitudes and airspeeds, wind, turbulence and "
           "noise widen from the least of their ranges, plants from the nominal one; 0: from the "
           "start")
      .OffUnless(config.condition_ramp > 0);
  list.Add("time_limit_ramp", &config.time_limit_ramp, Bounds::Fraction(),
           "share of the budget over which the time limit of targets grows from "
           "env.mission.training_time_limit_s to env.time_limit_steps; 0: it stays")
      .OffUnless(config.time_limit_ramp > 0);
  list.Add("held_noise_share", &config.held_noise_share, Bounds::Fraction(),
           "share of the exploration's variance that stays the same for ppo.held_noise_steps: what "
           "acts slowly, as a throttle does, shows little of noise that is drawn every step; 0: "
           "none")
      .OffUnless(config.held_noise_share > 0);
  list.Add("held_noise_steps", &config.held_noise_steps, {1, 1000000},
           "policy steps for which that share is held")
      .OffUnless(config.held_noise_share > 0);
  list.Add("held_noise_actions", &config.held_noise_actions, {1, 1000},
           "of the first so many actions: the throttle is the first of the stick commands, pitch "
           "of a "
           "high-level policy's")
      .OffUnless(config.held_noise_share > 0);
  list.Add(
          "pedals", &config.pedals,
          "false: the yaw action is 0, and flight control coordinates turns; of policies that give "
          "stick commands")
      .OffUnless(!config.pedals);
  list.Add("value_coefficient", &config.value_coefficient, Bounds::Positive(),
           "weight of the value loss");
  list.Add("clip_value_loss", &config.clip_value_loss, "clip the value's change like the ratio");
  list.Add("privileged_critic", &config.privileged_critic,
           "the critic also sees what no policy observes: errors without noise, clock, progress, "
           "wind, the drawn plant (C++ API, VecEnv::privileged_names)")
      .OffUnless(config.privileged_critic);
  list.Add("normalise_advantages", &config.normalise_advantages,
           "advantages get zero mean and unit variance");
  list.Add("popart", &config.popart, "value targets normalised with the head rescaled (PopArt)");
  list.Add("popart_rate", &config.popart_rate, Bounds::PositiveFraction(),
           "weight of an iteration in PopArt's moving moments");
}

void Validate(const PpoConfig& config) {
  PpoConfig listed = config;
  FieldList list;
  list.Group("ppo", listed);
  list.Check();
  if (config.rollout_steps % config.chunk_length != 0) {
    throw Error("configuration: ppo.rollout_steps = " + std::to_string(config.rollout_steps) +
                " is not a multiple of ppo.chunk_length = " + std::to_string(config.chunk_length));
  }
  if (config.learning_rate_decay == Decay::kExponential &&
      config.final_learning_rate_fraction == 0) {
    throw Error(
        "configuration: ppo.final_learning_rate_fraction = 0, which an exponential "
        "ppo.learning_rate_decay never comes to");
  }
  if (config.action_smoothness_coefficient > 0 && config.chunk_length < 2) {
    throw Error(
        "configuration: ppo.action_smoothness_coefficient needs a ppo.chunk_length of 2 at "
        "least: changes are seen within chunks");
  }
  const std::int64_t chunks =
      static_cast<std::int64_t>(config.num_aircraft) * (config.rollout_steps / config.chunk_length);
  if (config.minibatches > chunks) {
    throw Error("configuration: ppo.minibatches = " + std::to_string(config.minibatches) +
                " is more than the " + std::to_string(chunks) + " chunks of a rollout");
  }
}

}  // namespace skein
