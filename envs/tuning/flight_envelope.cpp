// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/flight_envelope.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "envs/reference/flight_control.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"

namespace skein {
namespace {

constexpr double kAlphaStepDeg = 0.5;
constexpr double kElevatorShare = 0.9;

double LiftAt(const Plant& plant, double altitude_ft, double speed, double alpha_deg) {
  const Air air = AirAt(plant.atmosphere(), altitude_ft);
  const double qbar = 0.5 * air.density_slug_ft3 * speed * speed;
  const double alpha = alpha_deg / kDegPerRad;
  RigidBodyState state = RigidBodyState::Zero();
  state[kU] = speed * std::cos(alpha);
  state[kW] = speed * std::sin(alpha);
  state[kDown] = -altitude_ft;
  state.segment<4>(kQ0) = QuaternionFromEuler({0, alpha, 0});
  Controls controls;
  controls.leading_edge_flap_deg =
      SteadyLeadingEdgeFlap(plant.aircraft(), alpha_deg, qbar, air.pressure_lbf_ft2);
  const auto coefficients = plant.Evaluate(state, controls).coefficients;
  return coefficients[0] * std::sin(alpha) - coefficients[2] * std::cos(alpha);
}

/// Level flight at one altitude, if the aircraft can.
class LevelFlight {
 public:
  LevelFlight(const Plant& plant, const EnvelopeLimits& limits, double altitude_ft,
              double max_alpha_deg)
      : plant_(plant), limits_(limits), altitude_ft_(altitude_ft), max_alpha_deg_(max_alpha_deg) {}

  std::optional<TrimPoint> At(double speed) const {
    TrimRequest request;
    request.altitude_ft = altitude_ft_;
    request.true_airspeed_ft_s = speed;
    try {
      const TrimPoint trim = Trim(plant_, request);
      if (IsFlown(trim, speed)) return trim;
    } catch (const Error&) {
    }
    return std::nullopt;
  }

 private:
  bool IsFlown(const TrimPoint& trim, double speed) const {
    const Aircraft& aircraft = plant_.aircraft();
    const double mach = speed / AirAt(plant_.atmosphere(), altitude_ft_).sound_speed_ft_s;
    const double most = Thrust(aircraft.engine, kMaximumPower, altitude_ft_, mach);
    const Actuator& elevator = aircraft.actuators.elevator;
    const double deflection = trim.controls.elevator_deg;
    return speed <= limits_.max_speed_ft_s && trim.controls.thrust_lbf <= most &&
           mach <= aircraft.engine.mach.back() && trim.alpha_rad * kDegPerRad <= max_alpha_deg_ &&
           deflection >= kElevatorShare * elevator.min_deg &&
           deflection <= kElevatorShare * elevator.max_deg;
  }

  const Plant& plant_;
  const EnvelopeLimits& limits_;
  double altitude_ft_, max_alpha_deg_;
};

/// The end of what is possible between `inside`, where it is, and `outside`, where it is not.
double Edge(const LevelFlight& flight, double inside, double outside) {
  constexpr int kHalvings = 12;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (inside + outside) / 2;
    (flight.At(middle) ? inside : outside) = middle;
  }
  return inside;
}

/// The longest stretch of speeds is taken to be the envelope; it begins near the stall.
std::vector<TrimPoint> TrimsAt(const LevelFlight& flight, double stall_speed, int speeds) {
  constexpr double kFactor = 1.04, kFastest = 30;
  double slowest = 0, fastest = 0, before = stall_speed;
  for (double speed = stall_speed; speed < kFastest * stall_speed; speed *= kFactor) {
    const bool flies = flight.At(speed).has_value();
    if (flies && slowest == 0) slowest = speed == stall_speed ? speed : Edge(flight, speed, before);
    if (flies) fastest = speed;
    if (!flies && slowest > 0) break;
    before = speed;
  }
  if (slowest == 0) return {};
  fastest = Edge(flight, fastest, fastest * kFactor);
  std::vector<TrimPoint> trims;
  for (int i = 0; i < speeds; ++i) {
    const double speed = slowest + (fastest - slowest) * i / (speeds - 1);
    if (const auto trim = flight.At(speed)) trims.push_back(*trim);
  }
  return trims;
}

}  // namespace

GreatestLift FindGreatestLift(const Plant& plant, double altitude_ft, double true_airspeed_ft_s,
                              double alpha_step_deg) {
  GreatestLift greatest;
  const double last = plant.aircraft().aerodynamics.alpha_deg.back();
  for (double alpha_deg = 0; alpha_deg <= last; alpha_deg += alpha_step_deg) {
    const double lift = LiftAt(plant, altitude_ft, true_airspeed_ft_s, alpha_deg);
    if (lift > greatest.coefficient) greatest = {lift, alpha_deg};
  }
  return greatest;
}

std::vector<TrimPoint> FlightEnvelope::AllTrims() const {
  std::vector<TrimPoint> all;
  for (const EnvelopeRow& row : rows) all.insert(all.end(), row.trims.begin(), row.trims.end());
  return all;
}

FlightEnvelope FindEnvelope(const Plant& plant, const EnvelopeLimits& limits, int altitudes,
                            int speeds) {
  FlightEnvelope envelope;
  const Airframe& airframe = plant.aircraft().airframe;
  // Lift coefficients hardly know the speed: any within the tables will do.
  const double any_speed =
      0.5 * plant.aircraft().engine.mach.back() * AirAt(plant.atmosphere(), 0).sound_speed_ft_s;
  envelope.greatest_lift = FindGreatestLift(plant, 0, any_speed, kAlphaStepDeg);
  const double lift = LiftAt(plant, 0, any_speed, 0);
  const double slope = LiftAt(plant, 0, any_speed, 1) - lift;
  envelope.zero_lift_alpha_deg = -lift / slope;
  const double max_alpha =
      envelope.zero_lift_alpha_deg +
      limits.alpha_fraction * (envelope.greatest_lift.alpha_deg - envelope.zero_lift_alpha_deg);
  for (int i = 0; i < altitudes; ++i) {
    EnvelopeRow row;
    row.altitude_ft = altitudes > 1 ? limits.max_altitude_ft * i / (altitudes - 1) : 0;
    const double density = AirAt(plant.atmosphere(), row.altitude_ft).density_slug_ft3;
    row.stall_speed_ft_s = std::sqrt(
        2 * airframe.mass_slug * plant.gravity().At(row.altitude_ft) /
        (density * airframe.wing_area_ft2 * std::max(envelope.greatest_lift.coefficient, 1e-6)));
    const LevelFlight flight(plant, limits, row.altitude_ft, max_alpha);
    row.trims = TrimsAt(flight, row.stall_speed_ft_s, speeds);
    envelope.rows.push_back(std::move(row));
  }
  return envelope;
}

}  // namespace skein
