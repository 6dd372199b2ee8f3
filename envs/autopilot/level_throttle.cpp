// SPDX-License-Identifier: Apache-2.0
#include "envs/autopilot/level_throttle.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "envs/configured_aircraft.h"
#include "envs/reference/trim.h"

namespace skein {
namespace {

/// Nothing where no steady flight is possible.
std::optional<float> TrimmedThrottle(const Plant& plant, double altitude_ft, double speed) {
  try {
    const TrimPoint point = Trim(plant, {altitude_ft, speed});
    return static_cast<float>(ThrottleForPower(plant.aircraft().throttle_gearing, point.power));
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

LevelThrottle LevelThrottle::Everywhere(double throttle) {
  LevelThrottle level;
  std::fill(std::begin(level.at), std::end(level.at), static_cast<float>(throttle));
  return level;
}

LevelThrottle TrimmedLevelThrottle(const EnvConfig& config) {
  const Plant plant(ConfiguredAircraft(config), config.atmosphere, 1, config.gravity);
  LevelThrottle level;
  for (int row = 0; row < LevelThrottle::kAltitudes; ++row) {
    float next = 1;  // the throttle of the next faster flight
    for (int column = LevelThrottle::kSpeeds - 1; column >= 0; --column) {
      const double speed = LevelThrottle::kLeastSpeed + column * LevelThrottle::kSpeedStep;
      next = TrimmedThrottle(plant, row * LevelThrottle::kAltitudeStep, speed).value_or(next);
      level.at[row * LevelThrottle::kSpeeds + column] = next;
    }
  }
  return level;
}

}  // namespace skein
