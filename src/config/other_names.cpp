// SPDX-License-Identifier: Apache-2.0
#include "src/config/other_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

namespace skein {
namespace {

constexpr char kTheirNumber[] = "their number, not their size";
constexpr char kControlSteps[] = "control steps, env.action_repeat to a policy step";

constexpr OtherName kOtherNames[] = {
    {"total_timesteps", "run.total_steps", kControlSteps},
    {"num_timesteps", "run.total_steps", kControlSteps},
    {"num_env_steps", "run.total_steps", kControlSteps},
    {"timesteps", "run.total_steps", kControlSteps},
    {"max_iterations", "run.total_steps", "control steps, not iterations"},
    {"num_envs", "ppo.num_aircraft", ""},
    {"n_envs", "ppo.num_aircraft", ""},
    {"num_actors", "ppo.num_aircraft", ""},
    {"n_rollout_threads", "ppo.num_aircraft", ""},
    {"n_steps", "ppo.rollout_steps", ""},
    {"num_steps", "ppo.rollout_steps", ""},
    {"num_steps_per_env", "ppo.rollout_steps", ""},
    {"horizon_length", "ppo.rollout_steps", ""},
    {"rollout_fragment_length", "ppo.rollout_steps", ""},
    {"rollout_length", "ppo.rollout_steps", ""},
    {"unroll_length", "ppo.rollout_steps", ""},
    {"buffer_size", "ppo.rollout_steps", ""},
    {"rollouts", "ppo.rollout_steps", ""},
    {"seq_length", "ppo.chunk_length", ""},
    {"data_chunk_length", "ppo.chunk_length", ""},
    {"bptt_horizon", "ppo.chunk_length", ""},
    {"n_epochs", "ppo.epochs", ""},
    {"num_epochs", "ppo.epochs", ""},
    {"update_epochs", "ppo.epochs", ""},
    {"mini_epochs", "ppo.epochs", ""},
    {"ppo_epoch", "ppo.epochs", ""},
    {"num_learning_epochs", "ppo.epochs", ""},
    {"learning_epochs", "ppo.epochs", ""},
    {"num_sgd_iter", "ppo.epochs", ""},
    {"num_updates_per_batch", "ppo.epochs", ""},
    {"num_minibatches", "ppo.minibatches", ""},
    {"num_mini_batches", "ppo.minibatches", ""},
    {"num_mini_batch", "ppo.minibatches", ""},
    {"mini_batches", "ppo.minibatches", ""},
    {"batch_size", "ppo.minibatches", kTheirNumber},
    {"minibatch_size", "ppo.minibatches", kTheirNumber},
    {"sgd_minibatch_size", "ppo.minibatches", kTheirNumber},
    {"lr", "ppo.learning_rate", ""},
    {"actor_lr", "ppo.learning_rate", ""},
    {"critic_lr", "ppo.critic_learning_rate", ""},
    {"anneal_lr", "ppo.final_learning_rate_fraction", "what is left of it in the end"},
    {"desired_kl", "ppo.target_kl", ""},
    {"kl_target", "ppo.target_kl", ""},
    {"kl_threshold", "ppo.target_kl", ""},
    {"discount_factor", "ppo.gamma", ""},
    {"discounting", "ppo.gamma", ""},
    {"lam", "ppo.gae_lambda", ""},
    {"lambda", "ppo.gae_lambda", ""},
    {"lambda_", "ppo.gae_lambda", ""},
    {"clip_range", "ppo.clip", ""},
    {"clip_coef", "ppo.clip", ""},
    {"clip_param", "ppo.clip", ""},
    {"clip_params", "ppo.clip", ""},
    {"clip_ratio", "ppo.clip", ""},
    {"ratio_clip", "ppo.clip", ""},
    {"clipping_epsilon", "ppo.clip", ""},
    {"e_clip", "ppo.clip", ""},
    {"clip_range_vf", "ppo.clip_value_loss", "true or false; the range is ppo.clip"},
    {"vf_clip_param", "ppo.clip_value_loss", "true or false; the range is ppo.clip"},
    {"clip_vloss", "ppo.clip_value_loss", ""},
    {"clip_value", "ppo.clip_value_loss", ""},
    {"use_clipped_value_loss", "ppo.clip_value_loss", ""},
    {"ent_coef", "ppo.entropy_coefficient", ""},
    {"entropy_coef", "ppo.entropy_coefficient", ""},
    {"entropy_coeff", "ppo.entropy_coefficient", ""},
    {"entropy_cost", "ppo.entropy_coefficient", ""},
    {"entropy_loss_scale", "ppo.entropy_coefficient", ""},
    {"vf_coef", "ppo.value_coefficient", ""},
    {"critic_coef", "ppo.value_coefficient", ""},
    {"value_loss_coef", "ppo.value_coefficient", ""},
    {"vf_loss_coeff", "ppo.value_coefficient", ""},
    {"value_loss_scale", "ppo.value_coefficient", ""},
    {"max_grad_norm", "ppo.max_gradient_norm", ""},
    {"grad_norm", "ppo.max_gradient_norm", ""},
    {"grad_clip", "ppo.max_gradient_norm", ""},
    {"grad_norm_clip", "ppo.max_gradient_norm", ""},
    {"norm_adv", "ppo.normalise_advantages", ""},
    {"normalize_advantage", "ppo.normalise_advantages", ""},
    {"normalize_advantages", "ppo.normalise_advantages", ""},
    {"log_std_init", "network.initial_log_std", ""},
    {"init_noise_std", "network.initial_log_std", "its logarithm"},
    {"lstm_hidden_size", "network.gru_size", ""},
    {"n_lstm_layers", "network.gru_layers", ""},
    {"recurrent_hidden_size", "network.gru_size", ""},
    {"recurrent_hidden_layers", "network.gru_layers", ""},
    {"eval_freq", "evaluation.interval_iterations", "iterations, not steps"},
    {"n_eval_episodes", "evaluation.episodes", ""},
    {"save_freq", "checkpoint.interval_iterations", "iterations, not steps"},
    {"max_episode_steps", "env.time_limit_steps", kControlSteps},
    {"frame_skip", "env.action_repeat", ""},
    {"decimation", "env.action_repeat", ""},
};

/// "--num-envs" and "ppo.num_envs" are "num_envs".
std::string Normalised(const std::string& name) {
  std::string normalised = name.substr(name.rfind('.') + 1);
  normalised.erase(0, std::min(normalised.find_first_not_of('-'), normalised.size()));
  for (char& c : normalised) {
    c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return normalised;
}

}  // namespace

std::vector<OtherName> OtherNames() { return {std::begin(kOtherNames), std::end(kOtherNames)}; }

const OtherName* FindOtherName(const std::string& name) {
  const std::string normalised = Normalised(name);
  const auto* const found =
      std::find_if(std::begin(kOtherNames), std::end(kOtherNames),
                   [&normalised](const OtherName& other) { return normalised == other.name; });
  return found == std::end(kOtherNames) ? nullptr : found;
}

std::string DidYouMean(const OtherName& other, const std::string& spelling) {
  const std::string difference =
      *other.difference == '\0' ? "" : fmt::format(" ({})", other.difference);
  return fmt::format("; did you mean {}{}?", spelling, difference);
}

}  // namespace skein
