// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "base/aligned_vector.h"
#include "envs/actions.h"
#include "envs/env_config.h"
#include "envs/policy.h"
#include "envs/state/state.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"

namespace skein {

/// What a high-level policy decides: pitch, yaw and speed that the low-level policy is to reach.
inline constexpr int kHighLevelActionSize = 3;

/// The lower level of a hierarchy: a frozen low-level policy that flies aircraft to the pitch, yaw
/// and speed that a high-level policy asks for, as it does in the Control task, and what it
/// remembers of each. Aircraft of different tiles may be guided from different threads at once.
class GuidedFlight {
 public:
  /// Aircraft that one call may guide.
  static constexpr int kMaxCount = 128;

  /// What a block of aircraft needs during one policy step of the high-level policy; `stick` holds
  /// the low-level policy's newest actions, row-major, not clipped. Lies with the caller.
  struct alignas(64) PolicyStep {
    float target[kHighLevelActionSize][kMaxCount];
    float error[kNumTaskErrors][kMaxCount];
    float observation[kMaxCount * kObservationSize];
    float stick[kMaxCount * kActionSize];
  };

  /// Throws Error if the low-level policy does not take the Control task's observations, or gives
  /// no stick actions.
  GuidedFlight(const EnvConfig& config, int num_aircraft, std::shared_ptr<const Policy> low_level);

  /// Floats that are remembered of an aircraft, by the low-level policy and of what it saw for the
  /// high-level policy, and where they lie; zeros at the beginning of an episode.
  int memory_size() const { return low_level_->state_size() + observation_sums_size_; }
  float* memory(int aircraft, int index) {
    const int of_low_level = low_level_->state_size();
    return index < of_low_level ? state(aircraft) + index
                                : observation_sums(aircraft) + (index - of_low_level);
  }
  /// A new episode of the aircraft begins.
  void Forget(int aircraft);

  /// Whether the high-level policy sees means of looks.
  bool averages() const { return observation_sums_size_ > 0; }

  /// Takes a high-level policy's actions, row-major [flight.count][kPlannerActionSize], clipped to
  /// [-1, 1]: what each aircraft is to reach, from where it is now. An action that is not finite
  /// makes its aircraft's kU NaN, so that its episode ends as non_finite.
  void Plan(const float* action, Tile flight, PolicyStep& policy_step) const;

  /// Whether the low-level policy decides anew ahead of this control step of the high-level
  /// policy's policy step.
  bool IsPolicyStep(int control_step) const {
    return control_step % low_level_->action_repeat() == 0;
  }

  /// The low-level policy sees the aircraft, which are `first_aircraft` and those that follow, and
  /// leaves its actions in `policy step.stick`. Noise is that of the aircraft's own observation.
  void Act(const KernelAircraft& aircraft, Tile flight, const ObservationNoise& noise,
           PolicyStep& policy_step);

  /// Begins the high-level policy's means anew for the `count` aircraft from `first` on: it has
  /// seen what came before.
  void ResetObservationMean(int first, int count);
  /// Adds to them what the low-level policy has just seen, with the high-level policy's errors in
  /// place of the low-level policy's: kNumTaskErrors columns kMaxCount apart.
  void AccumulateObservations(int first, int count, const float* errors,
                              const PolicyStep& policy_step);
  /// Turns observations of now, row-major, into means over all looks, this one included.
  void Average(int first, int count, float* observation) const;

 private:
  float* state(int aircraft) {
    return state_.data() + static_cast<std::ptrdiff_t>(aircraft) * low_level_->state_size();
  }
  float* observation_sums(int aircraft) {
    return observation_sums_.data() +
           static_cast<std::ptrdiff_t>(aircraft) * observation_sums_size_;
  }

  HighLevelConfig high_level_;
  std::unique_ptr<Task> control_;
  std::shared_ptr<const Policy> low_level_;
  int observation_sums_size_;   ///< 0 if the high-level policy sees the last look alone
  AlignedVector<float> state_;  ///< the low-level policy's, [num_aircraft][its state_size]
  AlignedVector<float>
      observation_sums_;  ///< sums of looks and their number, [num_aircraft][looks_size]
};

}  // namespace skein
