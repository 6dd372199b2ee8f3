// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "envs/env_config.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// What a policy observed and did in flights, one after the other: what every form of it is held
/// to.
struct PolicyTrace {
  int observation_size = 0, action_size = 0;
  std::vector<float> observations;  ///< row-major [steps][observation_size]
  std::vector<float> actions;       ///< row-major [steps][action_size], clipped
  std::vector<float> begins;        ///< [steps], 1 where an episode begins: the state is zeroed

  int steps() const { return static_cast<int>(begins.size()); }
};

/// `flights` flights of `steps` policy steps each with the mean action, a new episode beginning
/// wherever one ends, in `env` as the policy flies it (RecurrentPolicy::EnvironmentFor). Throws
/// Error if the policy was not made for it.
PolicyTrace RecordTrace(const RecurrentPolicy& policy, const EnvConfig& env, int flights, int steps,
                        std::uint64_t seed);

/// The largest absolute difference between `actions`, as of the trace, and the trace's own;
/// infinite if one of them is not finite, or their number is another.
double LargestError(const PolicyTrace& trace, const std::vector<float>& actions);

}  // namespace skein
