// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "envs/aircraft/aircraft.h"
#include "envs/env_config.h"
#include "envs/env_storage.h"
#include "envs/flight_metric_sums.h"
#include "envs/flight_reset.h"
#include "envs/kernels/flight_control_kernel.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/low_level_flight.h"
#include "envs/plant/plant_draw.h"
#include "envs/policy.h"
#include "envs/privileged_observation.h"
#include "envs/step_output.h"
#include "envs/tasks/reward_and_termination.h"
#include "envs/tasks/task.h"
#include "envs/wind/wind.h"

namespace skein {

/// What happens to blocks of an environment's aircraft: episodes begin, are observed, stepped and
/// ended. Blocks lie with the caller; different ones may be stepped from different threads at once.
class EnvStepper {
 public:
  /// Throws Error on a configuration that cannot be flown, and on a low-level policy that does not
  /// fit it. `low_level` may be null. `first_aircraft` is VecEnv's.
  EnvStepper(const EnvConfig& config, std::uint64_t seed, int num_aircraft,
             std::shared_ptr<const Policy> low_level, int first_aircraft);

  const EnvConfig& config() const { return config_; }
  int first_aircraft() const { return first_aircraft_; }
  const Task& task() const { return *task_; }
  /// What must be remembered of each aircraft.
  EnvColumns columns() const;
  int observation_size() const { return task_->observation_layout().size(); }
  int action_size() const { return low_level_ == nullptr ? kActionSize : kHighLevelActionSize; }
  /// Null without a low-level policy.
  LowLevelFlight* low_level() { return low_level_.get(); }
  const LowLevelFlight* low_level() const { return low_level_.get(); }

  void SetHandlingWeight(double weight) { costs_ = config_.reward.Times(weight); }

  /// VecEnv::SetConditionShare.
  void SetConditionShare(double share);
  /// VecEnv::SetTimeLimitShare.
  void SetTimeLimitShare(double share);

  /// Begins the given episode of the block's `i`-th aircraft.
  void BeginEpisode(const EnvBlock& block, int i, std::int32_t episode);

  /// Begins the episode that follows the one under way, of which nothing is measured any more.
  void BeginNextEpisode(const EnvBlock& block, int i) {
    metric_sums_[block.index].Begin(i);
    const std::uint32_t next = static_cast<std::uint32_t>(block.episode[i]) + 1;
    BeginEpisode(block, i, static_cast<std::int32_t>(next));
  }

  /// Writes the block's observations, row-major, noise included.
  void Observe(const EnvBlock& block, float* observation) const;

  const PrivilegedObservation& privileged() const { return privileged_; }
  /// Writes what no policy observes, row-major [block.count][privileged().size()].
  void ObservePrivileged(const EnvBlock& block, float* rows) const;

  /// One policy step. `action` and `output` point at the block's first aircraft; `ahead` is the
  /// memory that the caller works on next. Padding lanes are left to the caller.
  void Step(const EnvBlock& block, const float* action, const StepOutput& output,
            MemoryAhead ahead);

  /// All `num_blocks` blocks of the environment hold new flights: no episode under way has metrics.
  void ResetMetrics(std::size_t num_blocks);

 private:
  struct Scratch;
  struct SensedState;

  /// What keys the random numbers of the block's `i`-th aircraft.
  std::uint32_t KeyOf(const EnvBlock& block, int i) const {
    return static_cast<std::uint32_t>(first_aircraft_ + block.first_aircraft + i);
  }
  ObservationNoise NoiseOf(const EnvBlock& block) const;
  GustKeys GustKeysOf(const EnvBlock& block) const;
  void BeginPlant(const EnvBlock& block, int i) const;
  /// What the clock of the `i`-th aircraft's episode begins with.
  std::int32_t FirstClock(const EnvBlock& block, int i) const;
  int LongestFlightSteps() const;
  PlantDraw PlantOf(simd::RandomStream* random) const;
  Tile Sensed(const EnvBlock& block, SensedState& state) const;
  void ObserveSample(const EnvBlock& block, float* observation) const;
  bool MayFreeze(const EnvBlock& block) const;
  void FreezeSensors(const EnvBlock& block) const;
  PilotColumns Commands(const EnvBlock& block, int step, Scratch& scratch) const;
  const float* StickActions(const EnvBlock& block, const float* action, int step, Scratch& scratch);
  void ComputeReward(const EnvBlock& block, const float* action, const float* policy_action,
                     ControlStepObserver* observer, Scratch& scratch) const;
  void SubtractCosts(const EnvBlock& block, const float* policy_action, Scratch& scratch) const;
  void AdvanceTargets(const EnvBlock& block, Scratch& scratch) const;
  void DrawTargets(const EnvBlock& block, const Scratch& scratch) const;
  void DrawTarget(const EnvBlock& block, int i) const;
  void ObserveEnds(const EnvBlock& block, Scratch& scratch, const StepOutput& output) const;
  void RestartEnded(const EnvBlock& block, const Scratch& scratch, const StepOutput& output);

  EnvConfig config_;
  std::uint64_t seed_;
  int first_aircraft_;
  std::unique_ptr<Task> task_;
  Aircraft aircraft_;
  std::shared_ptr<const KernelAircraft> kernel_aircraft_;
  FlightControlConstants flight_control_;
  TerminationLimits limits_;
  bool remembers_actions_;
  ProgressRules progress_;
  HandlingCosts costs_;
  // What episodes draw from: narrower than config_ has it while SetConditionShare says so.
  FlightReset reset_;
  Wind wind_;
  PlantConfig drawn_plant_;
  double most_noise_;
  PrivilegedObservation privileged_;
  std::unique_ptr<LowLevelFlight> low_level_;
  /// By block, of its episodes under way: no part of the environment's state.
  std::vector<FlightMetricSums> metric_sums_;
};

}  // namespace skein
