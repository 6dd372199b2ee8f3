// SPDX-License-Identifier: Apache-2.0
#include "train/export/flight_control_trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "envs/aircraft/registry.h"
#include "envs/reference/closed_loop.h"
#include "simd/random.h"

namespace skein {
namespace {

/// Laws that read along in a closed loop, rounded to float32: what moves the aircraft is the loop's
/// own.
class RecordedFlight {
 public:
  RecordedFlight(const Plant& plant, const TrimPoint& trim, double dt)
      : laws_(plant.aircraft(), FlightControlMode::kFull, dt),
        loop_(plant, trim, FlightControlMode::kFull, dt) {}

  void Step(const PilotCommands& pilot, bool begins, FlightControlTrace* trace) {
    const PilotCommands sticks{pilot.throttle, Rounded(pilot.pitch), Rounded(pilot.roll),
                               Rounded(pilot.yaw)};
    const FlightSensors sensors = Sense();
    const SurfaceAngles positions = begins ? RoundedPositions() : SurfaceAngles{};
    if (begins) state_ = laws_.InitialState(sensors, positions);
    const SurfaceAngles commands = laws_.Step(sticks, sensors, &state_);
    for (const double input :
         {begins ? 1.0 : 0.0, sticks.pitch, sticks.roll, sticks.yaw, sensors.alpha_deg,
          sensors.roll_rate_deg_s, sensors.pitch_rate_deg_s, sensors.yaw_rate_deg_s, sensors.nz,
          sensors.ny, sensors.dynamic_pressure_psf, sensors.static_pressure_psf,
          positions.elevator_deg, positions.aileron_deg, positions.rudder_deg,
          positions.leading_edge_flap_deg}) {
      trace->inputs.push_back(static_cast<float>(input));
    }
    for (const double command : {commands.elevator_deg, commands.aileron_deg, commands.rudder_deg,
                                 commands.leading_edge_flap_deg}) {
      trace->commands.push_back(static_cast<float>(command));
    }
    loop_.Step(pilot);
  }

 private:
  /// As the trace will hold it: every form of the laws then reads the same.
  static double Rounded(double value) { return static_cast<float>(value); }

  FlightSensors Sense() const {
    const AirData air = loop_.air();
    FlightSensors sensors;
    sensors.alpha_deg = Rounded(air.alpha_rad * kDegPerRad);
    sensors.roll_rate_deg_s = Rounded(loop_.state()[kP] * kDegPerRad);
    sensors.pitch_rate_deg_s = Rounded(loop_.state()[kQ] * kDegPerRad);
    sensors.yaw_rate_deg_s = Rounded(loop_.state()[kR] * kDegPerRad);
    sensors.nz = Rounded(loop_.nz());
    sensors.ny = Rounded(loop_.ny());
    sensors.dynamic_pressure_psf = Rounded(air.dynamic_pressure_psf);
    sensors.static_pressure_psf = Rounded(air.static_pressure_psf);
    return sensors;
  }

  SurfaceAngles RoundedPositions() const {
    const SurfaceAngles& surfaces = loop_.surfaces();
    return {Rounded(surfaces.elevator_deg), Rounded(surfaces.aileron_deg),
            Rounded(surfaces.rudder_deg), Rounded(surfaces.leading_edge_flap_deg)};
  }

  FlightControl laws_;
  ClosedLoop loop_;
  FlightControlState state_{};
};

}  // namespace

FlightControlTrace RecordFlightControl(const EnvConfig& env, int flights, int steps,
                                       std::uint64_t seed) {
  const Plant plant(LoadAircraft(env.aircraft), env.atmosphere, 1, env.gravity);
  const int redrawn_after = static_cast<int>(std::lround(1 / env.control_interval_s));
  FlightControlTrace trace;
  for (int flight = 0; flight < flights; ++flight) {
    simd::RandomKey key;
    key.seed = seed;
    key.a = static_cast<std::uint32_t>(flight);
    key.purpose = simd::RandomPurpose::kActionNoise;
    simd::RandomStream random(key);
    TrimRequest request;
    request.altitude_ft = random.Uniform(env.initial.altitude_ft.min, env.initial.altitude_ft.max);
    request.true_airspeed_ft_s =
        random.Uniform(env.initial.true_airspeed_fps.min, env.initial.true_airspeed_fps.max);
    RecordedFlight recorded(plant, Trim(plant, request), env.control_interval_s);
    PilotCommands pilot;
    for (int step = 0; step < steps; ++step) {
      if (step % redrawn_after == 0) {
        pilot = {random.Uniform(0, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                 random.Uniform(-1, 1)};
      }
      recorded.Step(pilot, step == 0, &trace);
    }
  }
  return trace;
}

double LargestError(const FlightControlTrace& trace, const Actuators& actuators,
                    const std::vector<float>& commands) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (commands.size() != trace.commands.size()) return kInfinite;
  const std::array<double, FlightControlTrace::kCommands> largest_deg = {
      actuators.elevator.max_deg, actuators.aileron.max_deg, actuators.rudder.max_deg,
      actuators.leading_edge_flap.max_deg};
  double largest = 0;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const double error = std::abs(static_cast<double>(commands[i]) - trace.commands[i]) /
                         largest_deg[i % largest_deg.size()];
    if (!std::isfinite(error)) return kInfinite;
    largest = std::max(largest, error);
  }
  return largest;
}

}  // namespace skein
