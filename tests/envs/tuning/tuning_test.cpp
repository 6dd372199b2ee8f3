// SPDX-License-Identifier: Apache-2.0
// The tuning of flight control: its search, the linear closed loop that it looks at, and what it
// makes of aircraft whose own gains it does not see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "envs/aircraft/flight_control_file.h"
#include "envs/aircraft/registry.h"
#include "envs/aircraft/units.h"
#include "envs/state/state.h"
#include "envs/tuning/closed_loop_model.h"
#include "envs/tuning/gain_tuning.h"
#include "envs/tuning/handling.h"
#include "envs/tuning/pattern_search.h"
#include "envs/tuning/trial_flight.h"
#include "tests/envs/aerosonde_model.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStandard1976;

TrimPoint LevelAt(const Plant& plant, double speed_m_s) {
  TrimRequest request;
  request.true_airspeed_ft_s = speed_m_s * kFeetPerMetre;
  return Trim(plant, request);
}

TuningLimits LimitsUpTo(double altitude_ft) {
  TuningLimits limits;
  limits.envelope.max_speed_ft_s = 1000;
  limits.envelope.max_altitude_ft = altitude_ft;
  return limits;
}

TEST(PatternSearch, FindsTheLeastOfABowl) {
  constexpr Tolerance kLastFactor{0.1, "the factor at which the search ends, in logarithms"};
  const auto bowl = [](const std::vector<double>& x) {
    return std::pow(std::log(x[0] / 3), 2) + 4 * std::pow(std::log(x[1] / 0.02), 2);
  };
  const std::vector<double> least = SearchPattern(bowl, {1, 1});
  EXPECT_NEAR(std::log(least[0] / 3), 0, kLastFactor);
  EXPECT_NEAR(std::log(least[1] / 0.02), 0, kLastFactor);
}

// A small step flown by the closed loop is the linear model's.
TEST(ClosedLoopModel, StepsAsTheClosedLoopFlies) {
  constexpr Tolerance kLinear{0.03, "of a small step, relative to the largest"};
  const Plant plant(LoadAircraft("aerosonde"), kAtmosphere);
  const TrimPoint trim = LevelAt(plant, 25);
  constexpr double kStick = 0.01;
  const auto compare = [&](LoopAxis axis, int column, const Sticks& sticks,
                           const std::vector<double> TrialFlight::*flown, double unit) {
    const ClosedLoopModel model = LineariseClosedLoop(plant, trim, axis, kTrialInterval, false);
    const std::vector<double> linear = model.StepResponse(0, column, 1.5);
    const TrialFlight flight = FlyTrial(plant, trim, 1.5, sticks);
    const TrialFlight rest = FlyTrial(plant, trim, 1.5, HandsOff());
    const double largest = kStick * Peak(linear) * unit;
    for (std::size_t i = 0; i < linear.size(); ++i) {
      EXPECT_NEAR(((flight.*flown)[i] - (rest.*flown)[i]) / largest,
                  kStick * linear[i] * unit / largest, kLinear)
          << i;
    }
  };
  compare(LoopAxis::kLongitudinal, kNormalAccelerationMemory, Held(kStick, 0, 0), &TrialFlight::nz,
          1);
  compare(LoopAxis::kLateral, kP, Held(0, kStick, 0), &TrialFlight::p, kDegPerRad);
}

TEST(ClosedLoopModel, DampingRatioIsThatOfTheMode) {
  EXPECT_EQ(DampingRatio({-2, 0}), 1);
  EXPECT_EQ(DampingRatio({2, 0}), -1);
  EXPECT_DOUBLE_EQ(DampingRatio({-3, 4}), 0.6);
}

/// That no trim of its envelope departs, stalls or goes beyond the limits, and that all settle.
void ExpectGoodHandling(const Plant& plant, const TuningLimits& limits) {
  const FlightEnvelope envelope = FindEnvelope(plant, limits.envelope, 2, 4);
  ASSERT_GE(envelope.AllTrims().size(), 4u);
  for (const TrimPoint& trim : envelope.AllTrims()) {
    SCOPED_TRACE(std::to_string(-trim.state[kDown]) + " ft, " +
                 std::to_string(trim.state.segment<3>(kU).norm() * kMetresPerFoot) + " m/s");
    const Handling handling = AssessHandling(plant, trim);
    EXPECT_GT(std::min(handling.pitch_damping, handling.lateral_damping), 0.25);
    EXPECT_GT(handling.delayed_damping, 0);
    EXPECT_GT(handling.time_to_double_s, 4);
    EXPECT_TRUE(handling.settles);
    EXPECT_FALSE(handling.departs);
    EXPECT_LE(handling.max_alpha_deg, envelope.greatest_lift.alpha_deg);
    EXPECT_LE(handling.max_load_factor_g, limits.max_load_factor_g);
    EXPECT_GE(handling.min_load_factor_g, limits.min_load_factor_g);
  }
}

Plant Tuned(const DerivativeAircraft& model, const TuningLimits& limits) {
  Aircraft aircraft = MakeAircraft(model);
  aircraft.flight_control = {};
  aircraft.flight_control = TuneFlightControl(Plant(aircraft, kAtmosphere), limits);
  return Plant(aircraft, kAtmosphere);
}

TEST(TuneFlightControl, MakesTheAerosondeFly) {
  const TuningLimits limits = LimitsUpTo(4000);
  ExpectGoodHandling(Tuned(AerosondeModel(), limits), limits);
}

// The search halves a gain that is best at zero without end, to what no file may hold.
TEST(TuneFlightControl, GivesGainsThatAFileCanHold) {
  const Plant plant = Tuned(AerosondeModel(), LimitsUpTo(13000));
  const nlohmann::json section = FlightControlJson(plant.aircraft().flight_control);
  FlightControlGains read;
  EXPECT_NO_THROW(ReadFlightControl(Section(section, "tuned"), &read));
  EXPECT_EQ(read.pitch_rate_gain_g_s_per_deg, 0) << "it damps its pitch by itself";
}

/// An unmanned aircraft of 5 kg whose slowest level flight is near its stall.
DerivativeAircraft Kite() {
  DerivativeAircraft kite = AerosondeModel();
  kite.mass_kg = 5;
  kite.Ixx_kg_m2 = 0.36;
  kite.Iyy_kg_m2 = 0.42;
  kite.Izz_kg_m2 = 0.72;
  kite.Ixz_kg_m2 = 0.03;
  kite.wing_area_m2 = 0.55;
  kite.span_m = 2.1;
  kite.chord_m = 0.27;
  kite.cg_chord_fraction = 0.3;
  kite.longitudinal = {0.25, 4.9, 7, 0.36, 0.035, 0, 0, 0.04, -0.75, -12.5, -1.05, 0.85, 0.25, 50};
  kite.lateral = {-0.4, -0.02, 0.2,   0,     0.17,  -0.06, -0.46, 0.11,
                  0.2,  0.005, 0.065, -0.03, -0.09, -0.01, -0.07};
  ElectricPropulsion electric;
  electric.propeller = {0.38, 0.1, -0.06, -0.11, 0.0055, 0.004, -0.0165, 400, 0.04, 1.2, 22.2};
  electric.levels = {0.3, 0.7, 1};
  kite.propulsion = electric;
  const Actuator surface{25, 300, -25, 25};
  kite.elevator = kite.aileron = kite.rudder = surface;
  return kite;
}

// However far full sticks stall it, alpha's limiter leaves level flight alone.
TEST(TuneFlightControl, LimitsNoLevelFlight) {
  constexpr double kClearDeg = 0.4;  // 0.5 less the rounding of gains to three digits
  const TuningLimits limits = LimitsUpTo(13000);
  const Plant plant = Tuned(Kite(), limits);
  const FlightControlGains& gains = plant.aircraft().flight_control;
  EXPECT_LE(gains.alpha_onset_deg, gains.alpha_limit_deg);
  const std::vector<TrimPoint> trims = FindEnvelope(plant, limits.envelope, 2, 4).AllTrims();
  ASSERT_GE(trims.size(), 8u);
  for (const TrimPoint& trim : trims) {
    EXPECT_GT(gains.alpha_onset_deg, trim.alpha_rad * kDegPerRad);
    EXPECT_GT(gains.alpha_limit_deg, trim.alpha_rad * kDegPerRad + kClearDeg);
    const Handling handling = AssessHandling(plant, trim);
    EXPECT_GT(std::min(handling.pitch_damping, handling.lateral_damping), 0.25);
    EXPECT_FALSE(handling.departs);
  }
}

TEST(TuneFlightControl, LeavesNoGainsOfYawWithoutARudder) {
  DerivativeAircraft wing = AerosondeModel();
  wing.lateral.CY_rudder = wing.lateral.Cl_rudder = wing.lateral.Cn_rudder = 0;
  const TuningLimits limits = LimitsUpTo(4000);
  const Plant plant = Tuned(wing, limits);
  const FlightControlGains& gains = plant.aircraft().flight_control;
  for (const double gain :
       {gains.max_pedal_rudder_deg, gains.yaw_rate_gain_s,
        gains.lateral_acceleration_gain_deg_per_g, gains.aileron_rudder_interconnect_per_deg,
        gains.interconnect_min, gains.interconnect_max}) {
    EXPECT_EQ(gain, 0);
  }
  EXPECT_GT(gains.roll_rate_gain_s, 0);
  const std::vector<TrimPoint> trims = FindEnvelope(plant, limits.envelope, 2, 4).AllTrims();
  ASSERT_GE(trims.size(), 8u);
  for (const TrimPoint& trim : trims) {
    const Handling handling = AssessHandling(plant, trim);
    // Nothing adds to the Dutch roll's own damping.
    EXPECT_GT(std::min(handling.pitch_damping, handling.lateral_damping), 0.1);
    EXPECT_FALSE(handling.departs);
  }
}

// The same aircraft four times as large, by Froude's scaling: lengths 4, speeds 2, masses 64.
TEST(TuneFlightControl, ScalesWithTheAircraft) {
  DerivativeAircraft large = AerosondeModel();
  large.mass_kg *= 64;
  for (double* inertia : {&large.Ixx_kg_m2, &large.Iyy_kg_m2, &large.Izz_kg_m2, &large.Ixz_kg_m2}) {
    *inertia *= 1024;
  }
  large.wing_area_m2 *= 16;
  large.span_m *= 4;
  large.chord_m *= 4;
  EngineTables engine = TabulateThrust(large.propulsion);
  for (auto* thrusts : {&engine.idle_lbf, &engine.military_lbf, &engine.maximum_lbf}) {
    for (double& thrust : *thrusts) thrust *= 64;
  }
  for (double& mach : engine.mach) mach *= 2;
  large.propulsion = engine;
  const TuningLimits limits = LimitsUpTo(4000);
  ExpectGoodHandling(Tuned(large, limits), limits);
}

TEST(TuneFlightControl, StabilisesWhatIsNotStable) {
  DerivativeAircraft unstable = AerosondeModel();
  unstable.longitudinal.Cm_alpha = 0.1;
  const TuningLimits limits = LimitsUpTo(0);
  const Plant plant = Tuned(unstable, limits);
  EXPECT_GT(plant.aircraft().flight_control.alpha_to_elevator, 0);
  const std::vector<TrimPoint> trims = FindEnvelope(plant, limits.envelope, 1, 4).AllTrims();
  ASSERT_GE(trims.size(), 4u);
  // Full sticks at its slowest are too much for it, as `skein aircraft tune` then says.
  for (const TrimPoint& trim : trims) {
    const Handling handling = AssessHandling(plant, trim);
    EXPECT_GT(std::min(handling.pitch_damping, handling.lateral_damping), 0.25);
    EXPECT_GT(handling.time_to_double_s, 4);
    EXPECT_TRUE(handling.settles);
  }
}

}  // namespace
}  // namespace skein
