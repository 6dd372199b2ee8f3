// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <utility>

#include "envs/tuning/closed_loop_model.h"
#include "envs/tuning/frequency_response.h"

namespace skein {

/// Where a loop of flight control is broken: at the command to one actuator, with the others
/// closed.
enum class LoopBreak { kElevator, kAileron, kRudder };
inline constexpr std::array<std::pair<LoopBreak, const char*>, 3> kLoopBreaks{
    {{LoopBreak::kElevator, "elevator"},
     {LoopBreak::kAileron, "aileron"},
     {LoopBreak::kRudder, "rudder"}}};

/// From the command that the actuator gets to the negative of what flight control then commands: a
/// loop that closes with negative feedback. Sampling and hold are part of it.
SampledSystem BreakLoop(const Plant& plant, const TrimPoint& trim, LoopBreak where, double dt);

/// How far a stable loop is from instability. Infinite where nothing is in the way.
struct LoopMargins {
  /// By how much the gain may rise, and fall, dB; both above 0. Only loops that make an unstable
  /// aircraft stable have a finite second one.
  double gain_up_db = std::numeric_limits<double>::infinity();
  double gain_down_db = std::numeric_limits<double>::infinity();
  /// By how much the phase may fall or rise, both above 0: the least over all frequencies of gain
  /// one, and there.
  double phase_deg = std::numeric_limits<double>::infinity();
  double crossover_rad_s = 0;
  double gain_up_rad_s = 0;  ///< frequency of gain_up_db
  /// The delay that takes the phase margin: the least over those frequencies.
  double delay_s = std::numeric_limits<double>::infinity();
};

/// Of a loop that closes with negative feedback and is stable then; of one that is not the figures
/// say nothing.
LoopMargins FindLoopMargins(const SampledSystem& loop);

}  // namespace skein
