// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace skein {

/// Why an episode ended: the conditions of the NeuralPlane paper's Table 5, whose code calls the
/// last two ResetTarget and UnreachTarget, and non_finite. The order is their precedence.
enum class Termination : std::uint8_t {
  kNone,
  kNonFinite,
  kExtremeState,
  kHighSpeed,
  kLowAltitude,
  kLowSpeed,
  kOverload,
  kTargetReached,  ///< success
  kTimeLimit,
};

inline constexpr int kNumTerminations = 9;
inline constexpr std::array<const char*, kNumTerminations> kTerminationNames = {
    "none",      "non_finite", "extreme_state",  "high_speed", "low_altitude",
    "low_speed", "overload",   "target_reached", "time_limit"};

}  // namespace skein
