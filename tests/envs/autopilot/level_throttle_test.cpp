// SPDX-License-Identifier: Apache-2.0
#include "envs/autopilot/level_throttle.h"

#include <cmath>
#include <limits>

#include "envs/aircraft/engine.h"
#include "envs/autopilot/tecs-inl.h"
#include "envs/configured_aircraft.h"
#include "envs/env_config.h"
#include "envs/reference/trim.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

constexpr Tolerance kRounding{1e-6, "float32 rounding of 1"};
constexpr Tolerance kBetweenNodes{0.03, "a bilinear throttle between trims 50 ft/s apart"};

EnvConfig WithDragRise() {
  EnvConfig config;
  config.drag_rises = config.thrust_grows = true;
  return config;
}

double TrimmedAt(const EnvConfig& config, double speed, double altitude) {
  const Plant plant(ConfiguredAircraft(config), config.atmosphere, 1, config.gravity);
  return ThrottleForPower(plant.aircraft().throttle_gearing, Trim(plant, {altitude, speed}).power);
}

TEST(LevelThrottleTest, IsThatOfTrimsAtItsNodes) {
  for (const EnvConfig& config : {EnvConfig(), WithDragRise()}) {
    const LevelThrottle level = TrimmedLevelThrottle(config);
    for (const double speed : {600, 900, 1100, 1300}) {
      EXPECT_NEAR(LevelThrottleAt(level, speed, 20000.0), TrimmedAt(config, speed, 20000),
                  kRounding);
    }
  }
}

TEST(LevelThrottleTest, IsCloseToThatOfTrimsBetween) {
  const LevelThrottle level = TrimmedLevelThrottle(EnvConfig());
  for (const double speed : {625, 875, 1175}) {
    EXPECT_NEAR(LevelThrottleAt(level, speed, 17000.0), TrimmedAt(EnvConfig(), speed, 17000),
                kBetweenNodes);
  }
}

TEST(LevelThrottleTest, IsFullWhereThereIsTooLittleThrust) {
  EXPECT_EQ(LevelThrottleAt(TrimmedLevelThrottle(WithDragRise()), 1500.0, 0.0), 1);
}

TEST(LevelThrottleTest, IsThatOfTheEdgeBeyondItAndOfTheFirstNodeIfNothingIsKnown) {
  const LevelThrottle level = TrimmedLevelThrottle(EnvConfig());
  EXPECT_EQ(LevelThrottleAt(level, 50.0, 0.0), LevelThrottleAt(level, 250.0, 0.0));
  EXPECT_EQ(LevelThrottleAt(level, 9000.0, 0.0), LevelThrottleAt(level, 2000.0, 0.0));
  EXPECT_EQ(LevelThrottleAt(level, 1000.0, 90000.0), LevelThrottleAt(level, 1000.0, 60000.0));
  EXPECT_EQ(LevelThrottleAt(level, 1000.0, -500.0), LevelThrottleAt(level, 1000.0, 0.0));
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(LevelThrottleAt(level, unknown, unknown), LevelThrottleAt(level, 250.0, 0.0));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
