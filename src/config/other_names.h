// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein {

/// A setting that other PPO implementations call otherwise.
struct SettingOfOthers {
  const char* key;         ///< that has it here
  const char* difference;  ///< of the values; "" if there is none
  const char* names;       ///< elsewhere, in lower case with underscores, blanks between
};

/// Those of Stable-Baselines3, CleanRL, RLlib, rl_games, rsl_rl, skrl, Brax, PufferLib, MAPPO (and
/// so of NeuralPlane and LAG), Gymnasium and Isaac Lab.
std::vector<SettingOfOthers> SettingsOfOthers();

/// Whether `name` is one of `names`, between which there are blanks.
bool IsAmong(const std::string& name, const char* names);

/// A key's or an option's name as keys are written: "--Num-Envs" is "num_envs".
std::string WrittenAsKey(const std::string& name);

/// The setting with the last part of `name`, of a key or an option, among its names: "--num-envs",
/// "ppo.num_envs". Null if there is none.
const SettingOfOthers* FindSettingOfOthers(const std::string& name);

}  // namespace skein
