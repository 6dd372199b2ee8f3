// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "envs/env_config.h"

namespace skein {

/// What a flight control system read and commanded in flights, one after the other, by the float64
/// laws: what every other form of the laws is held to.
struct FlightControlTrace {
  static constexpr int kInputs = 16, kCommands = 4;
  /// Row-major [steps][kInputs]: 1 where a flight begins; stick commands pitch, roll, yaw;
  /// FlightSensors in their order; where a flight begins the surfaces' positions, else zeros.
  std::vector<float> inputs;
  std::vector<float> commands;  ///< row-major [steps][kCommands], SurfaceAngles

  int steps() const { return static_cast<int>(inputs.size()) / kInputs; }
};

/// `flights` flights of `steps` control steps each of the aircraft of `env`, from trims within
/// `env.initial`, under random sticks, full to either side, that are drawn anew every second.
/// Throws Error where there is no trim.
FlightControlTrace RecordFlightControl(const EnvConfig& env, int flights, int steps,
                                       std::uint64_t seed);

/// The largest absolute difference of `commands` from the trace's, as a fraction of each surface's
/// largest deflection; infinite if one of them is not finite, or their number is another.
double LargestError(const FlightControlTrace& trace, const Actuators& actuators,
                    const std::vector<float>& commands);

}  // namespace skein
