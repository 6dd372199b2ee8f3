// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein {

/// What another PPO implementation calls a setting, the key that has it here, and how the values
/// differ ("" if they do not).
struct OtherName {
  const char* name;  ///< in lower case, with underscores
  const char* key;
  const char* difference;
};

/// Names of settings in Stable-Baselines3, CleanRL, RLlib, rl_games, rsl_rl, skrl, Brax, PufferLib,
/// MAPPO (and so in NeuralPlane and LAG), Gymnasium and Isaac Lab, where they differ from Skein's.
std::vector<OtherName> OtherNames();

/// A key's or an option's name as keys are written: "--Num-Envs" is "num_envs".
std::string WrittenAsKey(const std::string& name);

/// The entry for the last part of `name`, of a key or an option: "--num-envs", "ppo.num_envs".
/// Null if there is none.
const OtherName* FindOtherName(const std::string& name);

}  // namespace skein
