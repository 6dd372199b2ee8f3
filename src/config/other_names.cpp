// SPDX-License-Identifier: Apache-2.0
#include "src/config/other_names.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

namespace skein {
namespace {

constexpr char kIterations[] = "iterations, not steps";
constexpr char kOfGru[] = "of a GRU";

constexpr SettingOfOthers kSettings[] = {
    {"run.total_steps", "control steps of all aircraft, env.action_repeat to a policy step",
     "total_timesteps num_timesteps num_env_steps timesteps max_frames"},
    {"run.total_steps", "control steps: num_aircraft x rollout_steps x action_repeat an iteration",
     "max_iterations max_epochs"},
    {"ppo.num_aircraft", "",
     "num_envs n_envs num_actors n_rollout_threads num_envs_per_env_runner"},
    {"ppo.rollout_steps", "",
     "n_steps num_steps num_steps_per_env horizon_length rollout_fragment_length rollout_length "
     "unroll_length buffer_size rollouts"},
    {"ppo.rollout_steps", "of each aircraft", "train_batch_size train_batch_size_per_learner"},
    {"ppo.chunk_length", "",
     "seq_length seq_len max_seq_len sequence_length data_chunk_length bptt_horizon"},
    {"ppo.epochs", "",
     "n_epochs num_epochs update_epochs mini_epochs ppo_epoch num_learning_epochs learning_epochs "
     "num_sgd_iter num_updates_per_batch"},
    {"ppo.minibatches", "", "num_minibatches num_mini_batches num_mini_batch mini_batches"},
    {"ppo.minibatches", "the number of minibatches, not their size",
     "batch_size minibatch_size sgd_minibatch_size"},
    {"ppo.learning_rate", "", "lr actor_lr policy_learning_rate"},
    {"ppo.critic_learning_rate", "", "critic_lr value_learning_rate"},
    {"ppo.final_learning_rate_fraction",
     "the share left at the end; 0 needs ppo.learning_rate_decay=linear", "anneal_lr"},
    {"ppo.learning_rate_decay", "linear or exponential; ppo.target_kl adapts the rate",
     "lr_schedule use_linear_lr_decay"},
    {"ppo.target_kl", "", "desired_kl"},
    {"ppo.target_kl", "it sets the learning rate", "kl_target kl_threshold"},
    {"ppo.adam_epsilon", "", "opti_eps"},
    {"ppo.gamma", "", "discount_factor discounting"},
    {"ppo.gae_lambda", "", "lam lambda lambda_ tau"},
    {"ppo.clip", "",
     "clip_range clip_coef clip_param clip_params clip_ratio ratio_clip clipping_epsilon e_clip"},
    {"ppo.clip_value_loss", "true or false: it clips the value's change, by ppo.clip",
     "clip_range_vf vf_clip_param clip_vloss clip_value value_clip use_clipped_value_loss "
     "clip_predicted_values"},
    {"ppo.entropy_coefficient", "",
     "ent_coef entropy_coef entropy_coeff entropy_cost entropy_loss_scale"},
    {"ppo.value_coefficient", "of half the squared error",
     "vf_coef critic_coef value_loss_coef vf_loss_coeff value_loss_scale"},
    {"ppo.max_gradient_norm", "of actor and critic each",
     "max_grad_norm grad_norm grad_clip grad_norm_clip"},
    {"ppo.normalise_advantages", "", "norm_adv normalize_advantage normalize_advantages"},
    {"ppo.popart", "true or false", "normalize_value use_popart use_valuenorm"},
    {"network.initial_log_std", "", "log_std_init"},
    {"network.initial_log_std", "the logarithm of the deviation", "init_noise_std init_std"},
    {"network.gru_size", "", "recurrent_hidden_size"},
    {"network.gru_size", kOfGru, "lstm_hidden_size lstm_cell_size rnn_hidden_size rnn_hidden_dim"},
    {"network.gru_layers", "", "recurrent_hidden_layers recurrent_n"},
    {"network.gru_layers", kOfGru, "n_lstm_layers rnn_num_layers"},
    {"network.hidden_layers", "before the GRU, and as many behind it", "layer_n"},
    {"network.actor_head_scale", "", "gain"},
    {"evaluation.interval_iterations", kIterations, "eval_freq eval_interval evaluation_interval"},
    {"evaluation.episodes", "", "n_eval_episodes eval_episodes"},
    {"checkpoint.interval_iterations", kIterations,
     "save_freq save_frequency save_interval checkpoint_interval"},
    {"env.time_limit_steps",
     "control steps; at the limit a flight fails, unless env.truncate_at_time_limit",
     "max_episode_steps"},
    {"env.truncate_at_time_limit", "true or false", "time_limit_bootstrap"},
    {"env.action_repeat", "", "frame_skip decimation"},
    {"env.reward_scale", "", "reward_scaling"},
};

}  // namespace

std::vector<SettingOfOthers> SettingsOfOthers() {
  return {std::begin(kSettings), std::end(kSettings)};
}

bool IsAmong(const std::string& name, const char* names) {
  std::istringstream words(names);
  return std::count(std::istream_iterator<std::string>(words), {}, name) > 0;
}

std::string WrittenAsKey(const std::string& name) {
  std::string written = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  for (char& c : written) {
    c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return written;
}

const SettingOfOthers* FindSettingOfOthers(const std::string& name) {
  const std::string written = WrittenAsKey(name);
  const std::string last_part = written.substr(written.rfind('.') + 1);
  const auto* const found = std::find_if(
      std::begin(kSettings), std::end(kSettings),
      [&last_part](const SettingOfOthers& setting) { return IsAmong(last_part, setting.names); });
  return found == std::end(kSettings) ? nullptr : found;
}

}  // namespace skein
