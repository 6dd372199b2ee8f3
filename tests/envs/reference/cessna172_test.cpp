// SPDX-License-Identifier: Apache-2.0
// The Cessna 172 against its handbook: Pilot's Operating Handbook, 1978 Skyhawk, model 172N,
// performance at 2300 lb. And its flight control, which `skein aircraft tune` made.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/registry.h"
#include "envs/state/state.h"
#include "envs/tuning/flight_envelope.h"
#include "envs/tuning/handling.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kFeetPerSecondPerKnot = 1.687809857;

class Cessna172 : public ::testing::Test {
 protected:
  static EnvelopeLimits Limits(double altitude_ft) {
    EnvelopeLimits limits;
    limits.max_speed_ft_s = 160 * kFeetPerSecondPerKnot;
    limits.max_altitude_ft = altitude_ft;
    return limits;
  }

  /// Rate of climb, ft/min, at full throttle from a level trim.
  double Climb(const TrimPoint& trim) const {
    const double speed = trim.state.segment<3>(kU).norm(), altitude_ft = -trim.state[kDown];
    const double mach = speed / AirAt(plant_.atmosphere(), altitude_ft).sound_speed_ft_s;
    const double excess =
        Thrust(plant_.aircraft().engine, 100, altitude_ft, mach) - trim.controls.thrust_lbf;
    return 60 * speed * excess / (plant_.aircraft().airframe.mass_slug * kGravityFtS2);
  }

  const Plant plant_{LoadAircraft("cessna172"), AtmosphereModel::kStandard1976};
};

TEST_F(Cessna172, PerformsAsItsHandbookSays) {
  constexpr Tolerance kSpeed{4, "knots: other sources for wing, drag and propeller"};
  constexpr Tolerance kClimb{100, "ft/min, a fifth of a per cent of the weight in drag each"};
  const FlightEnvelope envelope = FindEnvelope(plant_, Limits(0), 1, 12);
  const EnvelopeRow& ground = envelope.rows[0];
  ASSERT_FALSE(ground.trims.empty());
  EXPECT_NEAR(ground.stall_speed_ft_s / kFeetPerSecondPerKnot, 50, kSpeed);
  EXPECT_NEAR(ground.trims.back().state.segment<3>(kU).norm() / kFeetPerSecondPerKnot, 125, kSpeed);
  double climb = 0;
  for (const TrimPoint& trim : ground.trims) climb = std::max(climb, Climb(trim));
  EXPECT_NEAR(climb, 770, kClimb);
}

// By hand from the derivatives of its file, at sea level and 98 ft/s, 15 % above the stall: lift
// and thrust carry the weight, drag is thrust, and the elevator holds the moment.
TEST_F(Cessna172, TrimsNearItsStallAsItsDerivativesSay) {
  constexpr Tolerance kAlpha{0.02, "deg, between the nodes of alpha and where lift begins to bend"};
  constexpr Tolerance kElevator{0.02, "deg, by alpha"};
  constexpr Tolerance kThrust{1, "lbf, drag between the nodes of alpha"};
  constexpr double kWeight = 1043.3 / 14.59390294 * kGravityFtS2;
  constexpr double kFeetPerMetre = 1 / 0.3048;
  constexpr double kQbarS = 0.5 * 0.00237689 * 98 * 98 * 16.165 * kFeetPerMetre * kFeetPerMetre;
  constexpr double kInduced = 1 / (3.14159265358979 * 0.8 * 10.912 * 10.912 / 16.165);
  double alpha = 0, elevator = 0, thrust = 0;
  for (int i = 0; i < 100; ++i) {
    elevator = (-0.015 - 0.89 * alpha) / 1.28;
    const double wing_lift = 0.31 + 5.143 * alpha;
    thrust = kQbarS * (0.031 + kInduced * wing_lift * wing_lift) / std::cos(alpha);
    const double lift = (kWeight - thrust * std::sin(alpha)) / kQbarS;
    alpha = (lift - 0.31 - 0.43 * elevator) / 5.143;
  }
  TrimRequest request;
  request.true_airspeed_ft_s = 98;
  const TrimPoint trim = Trim(plant_, request);
  EXPECT_NEAR(trim.alpha_rad * kDegPerRad, alpha * kDegPerRad, kAlpha);
  EXPECT_NEAR(trim.controls.elevator_deg, elevator * kDegPerRad, kElevator);
  EXPECT_NEAR(trim.controls.thrust_lbf, thrust, kThrust);
}

// Service ceiling, where it climbs 100 ft/min: 14,200 ft.
TEST_F(Cessna172, StillClimbsAtItsCeiling) {
  const FlightEnvelope envelope = FindEnvelope(plant_, Limits(14200), 2, 12);
  double climb = 0;
  for (const TrimPoint& trim : envelope.rows[1].trims) climb = std::max(climb, Climb(trim));
  EXPECT_GT(climb, 50);
  EXPECT_LT(climb, 250);
}

TEST_F(Cessna172, FliesThroughItsFlightControl) {
  const std::vector<TrimPoint> trims = FindEnvelope(plant_, Limits(14000), 3, 4).AllTrims();
  ASSERT_GE(trims.size(), 4u);
  for (const TrimPoint& trim : trims) {
    SCOPED_TRACE(std::to_string(-trim.state[kDown]) + " ft, " +
                 std::to_string(trim.state.segment<3>(kU).norm()) + " ft/s");
    const Handling handling = AssessHandling(plant_, trim);
    EXPECT_GT(std::min(handling.pitch_damping, handling.lateral_damping), 0.3);
    EXPECT_GT(handling.delayed_damping, 0.1);
    EXPECT_GT(handling.time_to_double_s, 8);
    EXPECT_TRUE(handling.settles);
    EXPECT_FALSE(handling.departs);
    EXPECT_LT(handling.max_alpha_deg, 15.5);  // the stall is at 15
    EXPECT_LE(handling.max_load_factor_g, 3.8);
    EXPECT_GE(handling.min_load_factor_g, -1.52);
    EXPECT_GT(handling.roll_rate_deg_s, 25);
  }
}

}  // namespace
}  // namespace skein
