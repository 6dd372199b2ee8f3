#pragma once

#include <array>
#include <cstdint>

namespace skein {

/// Why an episode ended (the paper's Table 5, and NonFinite). The order is their precedence.
enum class Termination : std::uint8_t {
  kNone,
  kNonFinite,
  kExtremeState,
  kHighSpeed,
  kLowAltitude,
  kLowSpeed,
  kOverload,
  kResetTarget,    ///< the target was reached: success
  kUnreachTarget,  ///< time limit
};

inline constexpr int kNumTerminations = 9;
inline constexpr std::array<const char*, kNumTerminations> kTerminationNames = {
    "None",     "NonFinite", "ExtremeState", "HighSpeed",    "LowAltitude",
    "LowSpeed", "Overload",  "ResetTarget",  "UnreachTarget"};

}  // namespace skein
