#pragma once

#include <cstdint>
#include <memory>

#include "envs/actions.h"
#include "envs/state/state.h"
#include "envs/env_config.h"
#include "envs/policy.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"
#include "base/aligned_vector.h"

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

  /// Floats that are remembered of an aircraft, by the controller and of what it saw for the
  /// planner, and where they lie; zeros at the beginning of an episode.
  int memory_size() const { return controller_->state_size() + looks_size_; }
  float* memory(int aircraft, int index) {
    const int of_controller = controller_->state_size();
    return index < of_controller ? state(aircraft) + index
                                 : looks(aircraft) + (index - of_controller);
  }
  /// A new episode of the aircraft begins.
  void Forget(int aircraft);

  /// Whether the planner sees means of looks.
  bool averages() const { return looks_size_ > 0; }

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

  /// Begins the planner's means anew for the `count` aircraft from `first` on: it has seen what
  /// came before.
  void ForgetLooks(int first, int count);
  /// Adds to them what the controller has just seen, with the planner's errors in place of the
  /// controller's: kNumTaskErrors columns kMaxCount apart.
  void AddLooks(int first, int count, const float* errors, const Decision& decision);
  /// Turns observations of now, row-major, into means over all looks, this one included.
  void Average(int first, int count, float* observation) const;

 private:
  float* state(int aircraft) {
    return state_.data() + static_cast<std::ptrdiff_t>(aircraft) * controller_->state_size();
  }
  float* looks(int aircraft) {
    return looks_.data() + static_cast<std::ptrdiff_t>(aircraft) * looks_size_;
  }

  PlannerConfig planner_;
  std::unique_ptr<Task> control_;
  std::shared_ptr<const Pilot> controller_;
  int looks_size_;              ///< 0 if the planner sees the last look alone
  AlignedVector<float> state_;  ///< the controller's, [num_aircraft][its state_size]
  AlignedVector<float> looks_;  ///< sums of looks and their number, [num_aircraft][looks_size]
};

}  // namespace skein
