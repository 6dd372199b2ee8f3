// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/termination_config.h"

#include <algorithm>

#include "base/field_list.h"

namespace skein {
namespace {

/// Beyond it the weight to blame for a reward that is too large would be this one.
constexpr double kMostLateRewardFactor = 1000;

}  // namespace

void ListFields(TerminationConfig& config, FieldList& list) {
  list.AddRange("alpha", "deg", &config.alpha_deg, {-180, 180},
                "extreme_state below this angle of attack",
                "extreme_state above this angle of attack");
  list.AddRange("beta", "deg", &config.beta_deg, {-90, 90},
                "extreme_state below this sideslip angle",
                "extreme_state above this sideslip angle");
  list.Add("max_mach", &config.max_mach, Bounds::Positive(), "high_speed above this Mach number");
  list.Add("min_mach", &config.min_mach, Bounds::NotNegative(), "low_speed below this Mach number");
  list.Add("min_altitude_ft", &config.min_altitude_ft, Bounds::Any(),
           "low_altitude below this altitude");
  list.Add("max_load_factor_g", &config.max_load_factor, Bounds::Positive(),
           "overload above this load factor");
  list.Add("failure_reward", &config.failure_reward, Bounds::Any(), "reward for ending at a limit");
  list.Add("late_reward_factor", &config.late_reward_factor, {0, kMostLateRewardFactor},
           "the reward for ending at the time limit, and of a mission for a target that it misses, "
           "is so many times failure_reward; without an effect where env.truncate_at_time_limit "
           "leaves both without a reward")
      .OffUnless(config.late_reward_factor != 1);
  list.Add("success_reward", &config.success_reward, Bounds::Any(),
           "reward for reaching the target");
  list.Add("training_min_mach", &config.training_min_mach, Bounds::NotNegative(),
           "in training low_speed below this Mach number, if it is higher; 0: no other")
      .TrainingOnly()
      .OffUnless(config.training_min_mach > 0);
  list.Add("training_min_altitude_ft", &config.training_min_altitude_ft, {0, 60000},
           "in training low_altitude below this altitude, if it is higher; 0: no other")
      .TrainingOnly()
      .OffUnless(config.training_min_altitude_ft > 0);
}

TerminationConfig TerminationConfig::Flown() const {
  TerminationConfig flown = *this;
  flown.min_mach = std::max(min_mach, training_min_mach);
  if (training_min_altitude_ft > 0) {
    flown.min_altitude_ft = std::max(min_altitude_ft, training_min_altitude_ft);
  }
  return flown;
}

}  // namespace skein
