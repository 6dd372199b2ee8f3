// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

struct EnvConfig;

/// The throttle of level flight, which total energy control corrects: at the nodes of a grid of
/// true airspeeds, ft/s, and altitudes, ft, between which it is bilinear, and beyond which it is
/// that of the edge.
struct LevelThrottle {
  static constexpr int kSpeeds = 36, kAltitudes = 7;
  static constexpr double kLeastSpeed = 250, kSpeedStep = 50, kAltitudeStep = 10000;

  /// The same everywhere.
  static LevelThrottle Everywhere(double throttle);

  float at[kAltitudes * kSpeeds];  ///< [altitude][speed]
};

/// That of the trims of the environment's nominal aircraft, in still air: full where it takes more
/// thrust than there is, and below the stall that of the least airspeed that is flown.
LevelThrottle TrimmedLevelThrottle(const EnvConfig& config);

}  // namespace skein
