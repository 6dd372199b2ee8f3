// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "envs/control_step.h"
#include "envs/tasks/task_errors.h"
#include "python/bindings/shown_state.h"

namespace skein {

/// Remembers each aircraft's shown state at the end of a policy step, or of its episode if that
/// came before, the task's errors there, and the targets with which the policy step began: what
/// reward and termination of a user's own are made of. Padding and aircraft that begin anew do not
/// touch it.
class LastStates final : public ControlStepObserver {
 public:
  /// Of policy steps of `control_steps`, in which targets are `num_targets` numbers.
  LastStates(int num_aircraft, int num_targets, int control_steps);

  /// kShownColumns, then the errors, normalised and without noise, then the targets.
  std::size_t num_columns() const { return kNumStateColumns + num_targets_; }
  /// As rows [num_columns()][num_aircraft].
  std::vector<float> Columns() const;

  /// A policy step begins.
  void Begin();
  void See(const ControlStep& step) override;

 private:
  static constexpr std::size_t kNumStateColumns = kShownColumns.size() + kNumTaskErrors;

  template <typename Write>
  static void ForEachState(const ControlStep& step, const Write& write);
  float* ColumnAt(std::size_t column, int aircraft) {
    return columns_.data() + column * stride_ + static_cast<std::size_t>(aircraft);
  }
  void KeepTargets(const ControlStep& step);
  void KeepStates(const ControlStep& step);
  void KeepEnds(const ControlStep& step);

  std::size_t num_aircraft_, num_targets_;
  int control_steps_;
  std::size_t stride_;              ///< between columns
  std::vector<std::uint8_t> over_;  ///< the aircraft's episode ended earlier in the policy step
  std::vector<int> seen_;           ///< control steps of the block that begins at the aircraft
  std::vector<float> columns_;
};

}  // namespace skein
