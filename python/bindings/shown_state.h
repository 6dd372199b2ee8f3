// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "envs/control_step.h"
#include "envs/state/state.h"
#include "envs/tasks/task_errors.h"

namespace skein {

struct NamedColumn {
  int column;
  const char* name;
};

/// What of the state (envs/state/state.h) is shown to Python: all that is physical.
inline constexpr std::array<NamedColumn, 24> kShownColumns = {
    {{kU, "u_fps"},
     {kV, "v_fps"},
     {kW, "w_fps"},
     {kP, "p_rad_s"},
     {kQ, "q_rad_s"},
     {kR, "r_rad_s"},
     {kNorth, "north_ft"},
     {kEast, "east_ft"},
     {kDown, "down_ft"},
     {kQ0, "q0"},
     {kQx, "qx"},
     {kQy, "qy"},
     {kQz, "qz"},
     {kPower, "power_percent"},
     {kPowerCommand, "power_command_percent"},
     {kElevator, "elevator_deg"},
     {kAileron, "aileron_deg"},
     {kRudder, "rudder_deg"},
     {kLeadingEdgeFlap, "leading_edge_flap_deg"},
     {kNz, "nz_g"},
     {kNy, "ny_g"},
     {kWindNorth, "wind_north_fps"},
     {kWindEast, "wind_east_fps"},
     {kWindDown, "wind_down_fps"}}};

/// Remembers each aircraft's shown state at the end of a policy step, or of its episode if that
/// came before, and the task's errors there: what reward and termination of a user's own are made
/// of. Padding and aircraft that begin anew do not touch it.
class LastStates final : public ControlStepObserver {
 public:
  static constexpr std::size_t kNumRows = kShownColumns.size() + kNumTaskErrors;

  explicit LastStates(std::size_t num_aircraft)
      : over_(num_aircraft), columns_(kNumRows * num_aircraft) {}

  /// A policy step begins.
  void Begin() { std::fill(over_.begin(), over_.end(), std::uint8_t{0}); }

  void See(const ControlStep& step) override {
    for (int i = 0; i < step.state.count; ++i) {
      const auto aircraft = static_cast<std::size_t>(step.first_aircraft + i);
      if (over_[aircraft] != 0) continue;
      over_[aircraft] = step.termination[i] != 0 ? 1 : 0;
      float* out = columns_.data() + aircraft;
      for (const NamedColumn& shown : kShownColumns) {
        const bool is_stored = shown.column < kNumColumns || step.state.windy;
        *out = is_stored ? step.state[shown.column][i] : 0;
        out += over_.size();
      }
      for (std::size_t k = 0; k < kNumTaskErrors; ++k, out += over_.size()) {
        *out = step.errors[k * step.error_stride + static_cast<std::size_t>(i)];
      }
    }
  }

  /// [kNumRows][num_aircraft]: kShownColumns, then the errors, normalised and without noise.
  const std::vector<float>& columns() const { return columns_; }

 private:
  std::vector<std::uint8_t> over_;
  std::vector<float> columns_;
};

}  // namespace skein
