// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
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

/// What a high-level policy sets: pitch, yaw and speed that the low-level policy is to reach.
inline constexpr int kHighLevelActionSize = 3;

/// The lower level of a hierarchy: a frozen low-level policy that flies aircraft to the pitch, yaw
/// and speed that a high-level policy sets, as it does in the Control task, and its memory of each.
/// Aircraft of different tiles may be flown from different threads at once.
class LowLevelFlight {
 public:
  /// Aircraft that one call may fly.
  static constexpr int kMaxCount = 128;

  /// What a block of aircraft needs during a high-level policy's policy step. It lies with the
  /// caller.
  struct alignas(64) Scratch {
    /// What the low-level policy is to reach: columns of pitch, rad, yaw, rad, and speed, ft/s.
    Tile targets(int count) { return {target[0], kMaxCount, count}; }

    float target[kHighLevelActionSize][kMaxCount];
    float error[kNumTaskErrors][kMaxCount];
    float observation[kMaxCount * kObservationSize];
    /// The low-level policy's newest, row-major, not clipped.
    float action[kMaxCount * kActionSize];
  };

  /// Throws Error if the low-level policy does not take the Control task's observations, or has
  /// other actions than throttle and sticks.
  LowLevelFlight(const EnvConfig& config, int num_aircraft,
                 std::shared_ptr<const Policy> low_level);

  /// 32-bit words that are remembered of an aircraft: the low-level policy's state, and the sums of
  /// its observations for the high-level policy. All zero at the beginning of an episode.
  std::size_t memory_words() const;
  void SaveMemory(int aircraft, std::uint32_t* words) const;
  void RestoreMemory(int aircraft, const std::uint32_t* words);

  /// A new episode of the aircraft begins.
  void Reset(int aircraft);

  /// Whether the high-level policy observes means.
  bool averages_observations() const { return observation_sums_size_ > 0; }

  /// Takes a high-level policy's actions, row-major [flight.count][kHighLevelActionSize]: what each
  /// aircraft is to reach, from where its sensors show it, `sensed`: the low-level policy's first
  /// errors are then what was asked for, however late the sensors are. Their bias, scale and
  /// freezing spare targets as they spare errors. Actions are clipped to [-1, 1].
  /// One that is not finite makes its aircraft's kU in `flight` NaN, so that its episode ends as
  /// non_finite.
  void SetTargets(const float* action, Tile flight, Tile sensed, Scratch& scratch) const;

  /// Whether a policy step of the low-level policy begins with this control step, counted from the
  /// beginning of the high-level policy's.
  bool IsPolicyStep(int control_step) const {
    return control_step % low_level_->action_repeat() == 0;
  }

  /// One policy step of the low-level policy for the aircraft `first` and those that follow: leaves
  /// its actions in `scratch.action`. `flight` is what their sensors show; noise and plants are
  /// those of the aircraft's own observation.
  void Act(int first, const KernelAircraft& aircraft, Tile flight, const ObservationNoise& noise,
           const PlantTile& plants, Scratch& scratch);

  /// Begins the high-level policy's means anew for the `count` aircraft from `first` on: it has
  /// observed what came before.
  void ResetObservationMean(int first, int count);
  /// Adds to them the low-level policy's last observations, with the high-level policy's errors in
  /// place of the low-level policy's: kNumTaskErrors columns kMaxCount apart.
  void AccumulateObservations(int first, int count, const float* errors, const Scratch& scratch);
  /// Turns the present observations, row-major, into means over all samples, this one included.
  void AverageObservations(int first, int count, float* observation) const;

 private:
  std::size_t StateBegin(int aircraft) const;
  std::size_t SumsBegin(int aircraft) const;

  HighLevelConfig high_level_;
  std::unique_ptr<Task> control_;
  std::shared_ptr<const Policy> low_level_;
  int observation_sums_size_;   ///< 0 if the high-level policy observes the last sample alone
  AlignedVector<float> state_;  ///< the low-level policy's, [num_aircraft][its state_size]
  /// Sums of observations and their number, [num_aircraft][observation_sums_size_].
  AlignedVector<float> observation_sums_;
};

}  // namespace skein
