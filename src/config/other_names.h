// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein {

/// What another PPO implementation calls a setting, the key that has it here, and how the values
/// differ ("" if they do not). Names are in lower case, with underscores.
struct OtherName {
  const char* name;
  const char* key;
  const char* difference;
};

/// Names of settings in Stable-Baselines3, CleanRL, RLlib, rl_games, rsl_rl, skrl, Brax
/// and MAPPO's on-policy, whose names NeuralPlane and LAG have, where they differ from Skein's.
std::vector<OtherName> OtherNames();

/// The entry for the last part of `name`, which may be an option or a key: "--num-envs",
/// "ppo.num_envs". Null if there is none.
const OtherName* FindOtherName(const std::string& name);

/// "; did you mean X?" for what `other` is called here, `spelling` by the place that asks, with how
/// the values differ: "; did you mean ppo.minibatches (their number, not their size)?".
std::string DidYouMean(const OtherName& other, const std::string& spelling);

}  // namespace skein
