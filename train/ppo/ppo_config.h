// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>

namespace skein {

class FieldList;

/// How the learning rate falls over the budget.
enum class Decay { kLinear, kExponential };
inline constexpr std::array<std::pair<Decay, const char*>, 2> kDecayNames{
    {{Decay::kLinear, "linear"}, {Decay::kExponential, "exponential"}}};

/// How rollouts are flown and learned from.
struct PpoConfig {
  int num_aircraft = 1536;
  int rollout_steps = 64;  ///< policy steps per aircraft and iteration
  int chunk_length = 8;    ///< truncated backpropagation through time
  int epochs = 2;
  int minibatches = 16;
  double learning_rate = 1e-3;
  /// The learning rate falls to this fraction at the budget's end, and so in the last iteration; 1
  /// keeps it constant, 0 (linear decay alone) makes that iteration's update none.
  double final_learning_rate_fraction = 0.02;
  Decay learning_rate_decay = Decay::kLinear;
  /// Of an iteration's approximate_kl, by which the learning rate is adapted below that line; 0: it
  /// is not.
  double target_kl = 0;
  double critic_learning_rate = 0;  ///< at the start, and not adapted; 0: the actor's
  double adam_epsilon = 1e-5;
  /// The standard deviations learn at so many times the learning rate. At the rate of the weights
  /// they are hardly narrower when it has fallen.
  double log_std_rate_factor = 1;
  /// The policy that is evaluated and kept is the mean of the actor after about so many of the last
  /// iterations (MoveAverage); 0: the actor itself.
  int average_iterations = 0;
  double gamma = 0.99;  ///< per policy step
  double gae_lambda = 0.95;
  double clip = 0.2;
  double max_gradient_norm = 2;  ///< actor and critic separately
  double entropy_coefficient = 1e-3;
  /// Weight of the mean squared change of the mean action from one policy step to the next.
  double action_smoothness_coefficient = 0;
  /// Share of the budget over which what handling costs (env.reward, and the above) grows from 0 to
  /// its weights: a policy learns to arrive before it learns how. 0: from the start.
  double handling_ramp = 0;
  /// Share of the budget over which what episodes draw (VecEnv::SetConditionShare) widens from the
  /// mildest to all of its ranges: a policy learns to fly before it learns to fly in everything.
  /// 0: all from the start.
  double condition_ramp = 0;
  /// Share of the budget over which VecEnv::SetTimeLimitShare goes from 0 to 1: a policy learns to
  /// hit what lies ahead before it learns to turn back to what it has passed. 0: it stays 0.
  double time_limit_ramp = 0;
  /// Share of the exploration's variance that is held for some policy steps (HeldNoise).
  double held_noise_share = 0;
  int held_noise_steps = 10;
  int held_noise_actions = 1;  ///< of the first so many: the throttle's alone
  /// false: the yaw action is 0 (IdlePedals).
  bool pedals = true;
  double value_coefficient = 1;
  bool clip_value_loss = false;
  /// The critic also sees what no policy observes (VecEnv::ObservePrivileged).
  bool privileged_critic = false;
  bool normalise_advantages = true;
  bool popart = true;        ///< false: value targets unscaled, as in the paper
  double popart_rate = 0.1;  ///< moving average of the value targets' moments
};

/// Its settings (base/field_list.h).
void ListFields(PpoConfig& config, FieldList& list);

/// Throws Error on values out of bounds or that do not go together: a rollout is a whole number of
/// chunks per aircraft, and every minibatch has a chunk.
void Validate(const PpoConfig& config);

}  // namespace skein
