#pragma once

#include <cstdint>
#include <memory>

#include "envs/actions.h"
#include "envs/dynamics/state.h"
#include "envs/env_config.h"
#include "envs/pilot.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"
#include "simd/aligned_vector.h"

namespace skein {

/// What a planner decides: pitch, yaw and speed that the controller is to reach.
inline constexpr int kPlannerActionSize = 3;

/// The lower level of a hierarchy: a frozen controller that flies aircraft to the pitch, yaw and
/// speed that a planner asks for, as it does in the Control task, and what it remembers of each.
/// Aircraft of different tiles may be guided from different threads at once.
class GuidedFlight {
 public:
  /// Aircraft that one call may guide.
  static constexpr int kMaxCount = 128;

  /// What a block of aircraft needs during one decision of the planner; `stick` holds the
  /// controller's newest actions, row-major, not clipped. Lies with the caller.
  struct alignas(64) Decision {
    float target[kPlannerActionSize][kMaxCount];
    float error[kNumTaskErrors][kMaxCount];
    float observation[kMaxCount * kObservationSize];
    float stick[kMaxCount * kActionSize];
  };

  /// Throws Error if the controller does not take the Control task's observations, or gives no
  /// stick actions.
  GuidedFlight(const EnvConfig& config, int num_aircraft, std::shared_ptr<const Pilot> controller);

  /// Floats that the controller remembers of an aircraft, and where they lie; zeros at the
  /// beginning of an episode.
  int memory_size() const { return memory_size_; }
  float* memory(int aircraft) { return memory_.data() + Offset(aircraft); }
  /// A new episode of the aircraft begins.
  void Forget(int aircraft);

  /// Takes a planner's actions, row-major [flight.count][kPlannerActionSize], clipped to [-1, 1]:
  /// what each aircraft is to reach, from where it is now. An action that is not finite makes its
  /// aircraft's kU NaN, so that its episode ends as NonFinite.
  void Plan(const float* action, Tile flight, Decision& decision) const;

  /// Whether the controller decides anew ahead of this control step of the planner's decision.
  bool Decides(int control_step) const { return control_step % controller_->action_repeat() == 0; }

  /// The controller sees the aircraft, which are `first_aircraft` and those that follow, and leaves
  /// its actions in `decision.stick`. Noise is that of the aircraft's own observation.
  void Decide(const KernelAircraft& aircraft, Tile flight, const ObservationNoise& noise,
              Decision& decision);

 private:
  std::size_t Offset(int aircraft) const {
    return static_cast<std::size_t>(aircraft) * static_cast<std::size_t>(memory_size_);
  }

  PlannerConfig planner_;
  std::unique_ptr<Task> control_;
  std::shared_ptr<const Pilot> controller_;
  int memory_size_;
  AlignedVector<float> memory_;  ///< [num_aircraft][memory_size]
};

}  // namespace skein
