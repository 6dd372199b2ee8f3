// SPDX-License-Identifier: Apache-2.0
#include "envs/flight_reset.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "base/choice_error.h"
#include "base/range.h"
#include "envs/air/atmosphere.h"
#include "envs/air/gravity.h"
#include "envs/aircraft/engine.h"
#include "envs/state/attitude.h"

namespace skein {
namespace {

RigidBodyState StraightFlight(double altitude_ft, double true_airspeed_ft_s, double alpha_rad,
                              double bank_rad, double pitch_rad) {
  RigidBodyState state = RigidBodyState::Zero();
  state[kU] = true_airspeed_ft_s * std::cos(alpha_rad);
  state[kW] = true_airspeed_ft_s * std::sin(alpha_rad);
  state[kDown] = -altitude_ft;
  EulerAngles attitude;
  attitude.roll = bank_rad;
  attitude.pitch = pitch_rad;
  state.segment<4>(kQ0) = QuaternionFromEuler(attitude);
  return state;
}

std::optional<TrimTable> SolveTrims(const InitialConfig& initial, const Plant& plant) {
  if (!initial.trimmed) return std::nullopt;
  const Range altitude_ft = initial.drawn_altitude_ft();
  const Range true_airspeed_fps = initial.drawn_true_airspeed_fps();
  try {
    return TrimTable(plant, altitude_ft.min, altitude_ft.max, true_airspeed_fps.min,
                     true_airspeed_fps.max);
  } catch (const Error& error) {
    throw ChoiceError(std::string("flights cannot begin in all of env.initial: ") + error.what());
  }
}

/// Throws ChoiceError if the slowest or the fastest start ends at once, by the Mach number there.
void CheckMach(const EnvConfig& config) {
  const auto mach_at = [&config](double speed_ft_s, double altitude_ft) {
    return speed_ft_s / AirAt(config.atmosphere, altitude_ft).sound_speed_ft_s;
  };
  const auto refuse = [](const char* key, double speed_ft_s, double altitude_ft, double mach,
                         const char* limit) {
    char text[160];
    std::snprintf(text, sizeof text, "%s: %g ft/s at %g ft is Mach %.2f, beyond %s", key,
                  speed_ft_s, altitude_ft, mach, limit);
    throw ChoiceError(text);
  };
  const InitialConfig& initial = config.initial;
  // The higher, the slower is sound.
  const double fastest = mach_at(initial.true_airspeed_fps.max, initial.altitude_ft.max);
  if (fastest > config.termination.max_mach) {
    refuse("env.initial.true_airspeed_max_fps", initial.true_airspeed_fps.max,
           initial.altitude_ft.max, fastest, "env.termination.max_mach");
  }
  const double lowest_ft = initial.drawn_altitude_ft().min;
  const double slowest_fps = initial.drawn_true_airspeed_fps().min;
  const double slowest = mach_at(slowest_fps, lowest_ft);
  const TerminationConfig& limits = config.termination;
  if (slowest < limits.Flown().min_mach) {
    refuse(slowest_fps < initial.true_airspeed_fps.min
               ? "env.initial.training_true_airspeed_min_fps"
               : "env.initial.true_airspeed_min_fps",
           slowest_fps, lowest_ft, slowest,
           slowest < limits.min_mach ? "env.termination.min_mach"
                                     : "env.termination.training_min_mach");
  }
}

}  // namespace

FlightReset::FlightReset(const EnvConfig& config, const Aircraft& aircraft)
    : initial_(config.initial),
      altitude_ft_(initial_.drawn_altitude_ft()),
      true_airspeed_fps_(initial_.drawn_true_airspeed_fps()),
      load_factor_max_(config.starting_load_factor_max()),
      plant_(aircraft, config.atmosphere, 1, config.gravity),
      flight_control_(aircraft, config.flight_control, config.control_interval_s),
      draw_power_(config.draw_power),
      trims_(SolveTrims(config.initial, plant_)) {
  CheckMach(config);
}

TrimmedStart FlightReset::UntrimmedAt(double altitude_ft, double true_airspeed_ft_s) const {
  const RigidBodyState state = StraightFlight(altitude_ft, true_airspeed_ft_s, 0, 0, 0);
  Controls controls;
  controls.thrust_lbf = plant_.aircraft().untrimmed_thrust_lbf;
  const PlantOutput output = plant_.Evaluate(state, controls);
  TrimmedStart start;
  start.power =
      PowerForThrust(plant_.aircraft().engine, controls.thrust_lbf, altitude_ft, output.air.mach);
  start.nz = output.nz;
  start.ny = output.ny;
  return start;
}

void FlightReset::Pull(double pulled_g, RigidBodyState* state, TrimmedStart* start) const {
  Controls controls;
  controls.elevator_deg = start->elevator_deg;
  controls.aileron_deg = start->aileron_deg;
  controls.rudder_deg = start->rudder_deg;
  controls.leading_edge_flap_deg = start->leading_edge_flap_deg;
  const double speed_ft_s = std::hypot((*state)[kU], (*state)[kW]);
  const auto at_alpha = [&](double alpha_rad) {
    RigidBodyState turned = *state;
    turned[kU] = speed_ft_s * std::cos(alpha_rad);
    turned[kW] = speed_ft_s * std::sin(alpha_rad);
    return turned;
  };
  constexpr double kStepRad = 1 / kDegPerRad;
  const double slope = (plant_.Evaluate(at_alpha(start->alpha_rad + kStepRad), controls).nz -
                        plant_.Evaluate(*state, controls).nz) /
                       kStepRad;
  start->alpha_rad += pulled_g / slope;
  start->nz += pulled_g;
  *state = at_alpha(start->alpha_rad);
  // What gravity does not turn by itself, as in a steady turn.
  (*state)[kQ] = pulled_g * kGravityFtS2 / speed_ft_s;
}

FreshFlight FlightReset::Draw(simd::RandomStream* random) const {
  const double altitude_ft = BentInto(altitude_ft_, random->Uniform(), draw_power_);
  const double speed_ft_s = BentInto(true_airspeed_fps_, random->Uniform(), draw_power_);
  TrimmedStart start =
      trims_ ? trims_->At(altitude_ft, speed_ft_s) : UntrimmedAt(altitude_ft, speed_ft_s);
  const auto either_side_rad = [random](double most_deg) {
    const double most_rad = most_deg / kDegPerRad;
    return most_rad > 0 ? random->Uniform(-most_rad, most_rad) : 0;
  };
  const double banked_rad = either_side_rad(initial_.training_bank_max_deg);
  const double pulled_g = load_factor_max_ > 1 ? random->Uniform(0, load_factor_max_ - 1) : 0;
  const double climb_rad = either_side_rad(initial_.training_climb_max_deg);
  const double roll_rad = start.bank_rad + banked_rad;
  RigidBodyState state = StraightFlight(altitude_ft, speed_ft_s, start.alpha_rad, roll_rad,
                                        start.pitch_rad + climb_rad);
  if (pulled_g > 0) Pull(pulled_g, &state, &start);

  const Air air = AirAt(plant_.atmosphere(), altitude_ft);
  FlightSensors sensors;
  sensors.alpha_deg = start.alpha_rad * kDegPerRad;
  sensors.nz = start.nz;
  sensors.ny = start.ny;
  sensors.dynamic_pressure_psf = 0.5 * air.density_slug_ft3 * speed_ft_s * speed_ft_s;
  sensors.static_pressure_psf = air.pressure_lbf_ft2;
  const SurfaceAngles surfaces{start.elevator_deg, start.aileron_deg, start.rudder_deg,
                               start.leading_edge_flap_deg};
  const FlightControlState filters = flight_control_.InitialState(sensors, surfaces);

  FreshFlight flight;
  const auto set = [&flight](int column, double value) {
    flight.columns[static_cast<std::size_t>(column)] = static_cast<float>(value);
  };
  for (int column = 0; column < kNumRigidBody; ++column) set(column, state[column]);
  set(kPower, start.power);
  set(kPowerCommand, start.power);
  set(kElevator, surfaces.elevator_deg);
  set(kAileron, surfaces.aileron_deg);
  set(kRudder, surfaces.rudder_deg);
  set(kLeadingEdgeFlap, surfaces.leading_edge_flap_deg);
  set(kNz, start.nz);
  set(kNy, start.ny);
  for (int i = 0; i < kNumFlightControlStates; ++i) {
    set(kAlphaFilter + i, filters[static_cast<std::size_t>(i)]);
  }
  // Without the climb: pitches that are asked for lie around steady flight.
  flight.start = {altitude_ft, speed_ft_s, start.pitch_rad, 0, roll_rad};
  return flight;
}

}  // namespace skein
