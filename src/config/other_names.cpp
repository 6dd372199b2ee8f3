// SPDX-License-Identifier: Apache-2.0
#include "src/config/other_names.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace skein {
namespace {

constexpr char kControlSteps[] =
    "control steps of all aircraft, env.action_repeat to a policy step";
constexpr char kIterations[] = "iterations, not steps";
constexpr char kNumber[] = "the number of minibatches, not their size";
constexpr char kSetsRate[] = "it sets the learning rate";
constexpr char kHalfSquare[] = "of half the squared error";
constexpr char kEach[] = "of actor and critic each";
constexpr char kOfGru[] = "of a GRU";

constexpr OtherName kOtherNames[] = {
    {"total_timesteps", "run.total_steps", kControlSteps},
    {"num_timesteps", "run.total_steps", kControlSteps},
    {"num_env_steps", "run.total_steps", kControlSteps},
    {"timesteps", "run.total_steps", kControlSteps},
    {"max_frames", "run.total_steps", kControlSteps},
    {"max_iterations", "run.total_steps",
     "control steps: num_aircraft x rollout_steps x action_repeat an iteration"},
    {"max_epochs", "run.total_steps",
     "control steps: num_aircraft x rollout_steps x action_repeat an iteration"},
    {"num_envs", "ppo.num_aircraft", ""},
    {"n_envs", "ppo.num_aircraft", ""},
    {"num_actors", "ppo.num_aircraft", ""},
    {"n_rollout_threads", "ppo.num_aircraft", ""},
    {"num_envs_per_env_runner", "ppo.num_aircraft", ""},
    {"n_steps", "ppo.rollout_steps", ""},
    {"num_steps", "ppo.rollout_steps", ""},
    {"num_steps_per_env", "ppo.rollout_steps", ""},
    {"horizon_length", "ppo.rollout_steps", ""},
    {"rollout_fragment_length", "ppo.rollout_steps", ""},
    {"rollout_length", "ppo.rollout_steps", ""},
    {"unroll_length", "ppo.rollout_steps", ""},
    {"buffer_size", "ppo.rollout_steps", ""},
    {"rollouts", "ppo.rollout_steps", ""},
    {"train_batch_size", "ppo.rollout_steps", "of each aircraft"},
    {"train_batch_size_per_learner", "ppo.rollout_steps", "of each aircraft"},
    {"seq_length", "ppo.chunk_length", ""},
    {"seq_len", "ppo.chunk_length", ""},
    {"max_seq_len", "ppo.chunk_length", ""},
    {"sequence_length", "ppo.chunk_length", ""},
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
    {"batch_size", "ppo.minibatches", kNumber},
    {"minibatch_size", "ppo.minibatches", kNumber},
    {"sgd_minibatch_size", "ppo.minibatches", kNumber},
    {"lr", "ppo.learning_rate", ""},
    {"actor_lr", "ppo.learning_rate", ""},
    {"policy_learning_rate", "ppo.learning_rate", ""},
    {"critic_lr", "ppo.critic_learning_rate", ""},
    {"value_learning_rate", "ppo.critic_learning_rate", ""},
    {"anneal_lr", "ppo.final_learning_rate_fraction",
     "the share left at the end; 0 needs ppo.learning_rate_decay=linear"},
    {"lr_schedule", "ppo.learning_rate_decay",
     "linear or exponential; ppo.target_kl adapts the rate"},
    {"use_linear_lr_decay", "ppo.learning_rate_decay",
     "linear or exponential; ppo.target_kl adapts the rate"},
    {"desired_kl", "ppo.target_kl", ""},
    {"kl_target", "ppo.target_kl", kSetsRate},
    {"kl_threshold", "ppo.target_kl", kSetsRate},
    {"opti_eps", "ppo.adam_epsilon", ""},
    {"discount_factor", "ppo.gamma", ""},
    {"discounting", "ppo.gamma", ""},
    {"lam", "ppo.gae_lambda", ""},
    {"lambda", "ppo.gae_lambda", ""},
    {"lambda_", "ppo.gae_lambda", ""},
    {"tau", "ppo.gae_lambda", ""},
    {"clip_range", "ppo.clip", ""},
    {"clip_coef", "ppo.clip", ""},
    {"clip_param", "ppo.clip", ""},
    {"clip_params", "ppo.clip", ""},
    {"clip_ratio", "ppo.clip", ""},
    {"ratio_clip", "ppo.clip", ""},
    {"clipping_epsilon", "ppo.clip", ""},
    {"e_clip", "ppo.clip", ""},
    {"clip_range_vf", "ppo.clip_value_loss",
     "true or false: it clips the value's change, by ppo.clip"},
    {"vf_clip_param", "ppo.clip_value_loss",
     "true or false: it clips the value's change, by ppo.clip"},
    {"clip_vloss", "ppo.clip_value_loss",
     "true or false: it clips the value's change, by ppo.clip"},
    {"clip_value", "ppo.clip_value_loss",
     "true or false: it clips the value's change, by ppo.clip"},
    {"value_clip", "ppo.clip_value_loss",
     "true or false: it clips the value's change, by ppo.clip"},
    {"use_clipped_value_loss", "ppo.clip_value_loss",
     "true or false: it clips the value's change, by ppo.clip"},
    {"clip_predicted_values", "ppo.clip_value_loss",
     "true or false: it clips the value's change, by ppo.clip"},
    {"ent_coef", "ppo.entropy_coefficient", ""},
    {"entropy_coef", "ppo.entropy_coefficient", ""},
    {"entropy_coeff", "ppo.entropy_coefficient", ""},
    {"entropy_cost", "ppo.entropy_coefficient", ""},
    {"entropy_loss_scale", "ppo.entropy_coefficient", ""},
    {"vf_coef", "ppo.value_coefficient", kHalfSquare},
    {"critic_coef", "ppo.value_coefficient", kHalfSquare},
    {"value_loss_coef", "ppo.value_coefficient", kHalfSquare},
    {"vf_loss_coeff", "ppo.value_coefficient", kHalfSquare},
    {"value_loss_scale", "ppo.value_coefficient", kHalfSquare},
    {"max_grad_norm", "ppo.max_gradient_norm", kEach},
    {"grad_norm", "ppo.max_gradient_norm", kEach},
    {"grad_clip", "ppo.max_gradient_norm", kEach},
    {"grad_norm_clip", "ppo.max_gradient_norm", kEach},
    {"norm_adv", "ppo.normalise_advantages", ""},
    {"normalize_advantage", "ppo.normalise_advantages", ""},
    {"normalize_advantages", "ppo.normalise_advantages", ""},
    {"normalize_value", "ppo.popart", "true or false"},
    {"use_popart", "ppo.popart", "true or false"},
    {"use_valuenorm", "ppo.popart", "true or false"},
    {"log_std_init", "network.initial_log_std", ""},
    {"init_noise_std", "network.initial_log_std", "the logarithm of the deviation"},
    {"init_std", "network.initial_log_std", "the logarithm of the deviation"},
    {"recurrent_hidden_size", "network.gru_size", ""},
    {"lstm_hidden_size", "network.gru_size", kOfGru},
    {"lstm_cell_size", "network.gru_size", kOfGru},
    {"rnn_hidden_size", "network.gru_size", kOfGru},
    {"rnn_hidden_dim", "network.gru_size", kOfGru},
    {"recurrent_hidden_layers", "network.gru_layers", ""},
    {"recurrent_n", "network.gru_layers", ""},
    {"n_lstm_layers", "network.gru_layers", kOfGru},
    {"rnn_num_layers", "network.gru_layers", kOfGru},
    {"layer_n", "network.hidden_layers", "before the GRU, and as many behind it"},
    {"gain", "network.actor_head_scale", ""},
    {"eval_freq", "evaluation.interval_iterations", kIterations},
    {"eval_interval", "evaluation.interval_iterations", kIterations},
    {"evaluation_interval", "evaluation.interval_iterations", kIterations},
    {"n_eval_episodes", "evaluation.episodes", ""},
    {"eval_episodes", "evaluation.episodes", ""},
    {"save_freq", "checkpoint.interval_iterations", kIterations},
    {"save_frequency", "checkpoint.interval_iterations", kIterations},
    {"save_interval", "checkpoint.interval_iterations", kIterations},
    {"checkpoint_interval", "checkpoint.interval_iterations", kIterations},
    {"max_episode_steps", "env.time_limit_steps",
     "control steps; at the limit a flight fails, unless env.truncate_at_time_limit"},
    {"time_limit_bootstrap", "env.truncate_at_time_limit", "true or false"},
    {"frame_skip", "env.action_repeat", ""},
    {"decimation", "env.action_repeat", ""},
    {"reward_scaling", "env.reward_scale", ""},
};

}  // namespace

std::vector<OtherName> OtherNames() { return {std::begin(kOtherNames), std::end(kOtherNames)}; }

std::string WrittenAsKey(const std::string& name) {
  std::string written = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  for (char& c : written) {
    c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return written;
}

const OtherName* FindOtherName(const std::string& name) {
  const std::string written = WrittenAsKey(name);
  const std::string last_part = written.substr(written.rfind('.') + 1);
  const auto* const found =
      std::find_if(std::begin(kOtherNames), std::end(kOtherNames),
                   [&last_part](const OtherName& other) { return last_part == other.name; });
  return found == std::end(kOtherNames) ? nullptr : found;
}

}  // namespace skein
