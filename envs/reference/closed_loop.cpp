// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/closed_loop.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "envs/reference/actuator.h"
#include "envs/state/state.h"

namespace skein {

/// Rigid body and engine power, or their rates.
struct ClosedLoop::Flight {
  RigidBodyState body;
  double power = 0;

  Flight After(double dt, const Flight& rate) const {
    return {body + dt * rate.body, power + dt * rate.power};
  }
};

ClosedLoop::ClosedLoop(const Plant& plant, const TrimPoint& trim, FlightControlMode mode, double dt,
                       int substeps)
    : plant_(plant),
      flight_control_(plant.aircraft(), mode, dt),
      dt_(dt),
      substeps_(substeps),
      state_(trim.state),
      power_(trim.power) {
  surfaces_ = {trim.controls.elevator_deg, trim.controls.aileron_deg, trim.controls.rudder_deg,
               trim.controls.leading_edge_flap_deg};
  previous_command_ = surfaces_;
  const PlantOutput output = plant.Evaluate(trim.state, trim.controls);
  nz_ = output.nz;
  ny_ = output.ny;
  flight_control_state_ = flight_control_.InitialState(Sense(), surfaces_);
}

Eigen::VectorXd ClosedLoop::memory() const {
  const auto angles = [](const SurfaceAngles& a) {
    return Eigen::Vector4d(a.elevator_deg, a.aileron_deg, a.rudder_deg, a.leading_edge_flap_deg);
  };
  Eigen::VectorXd memory(kClosedLoopMemory);
  memory << state_, angles(surfaces_),
      Eigen::Map<const Eigen::VectorXd>(flight_control_state_.data(), kNumFlightControlStates),
      power_, nz_, ny_, angles(previous_command_);
  return memory;
}

void ClosedLoop::set_memory(const Eigen::VectorXd& memory) {
  if (memory.size() != kClosedLoopMemory) {
    throw Error("closed loop: a memory of " + std::to_string(memory.size()) +
                " numbers, but it has " + std::to_string(kClosedLoopMemory));
  }
  const auto angles = [&memory](int at) -> SurfaceAngles {
    return {memory[at], memory[at + 1], memory[at + 2], memory[at + 3]};
  };
  state_ = memory.head<kElevatorMemory>();
  surfaces_ = angles(kElevatorMemory);
  Eigen::Map<Eigen::VectorXd>(flight_control_state_.data(), kNumFlightControlStates) =
      memory.segment<kNumFlightControlStates>(kFlightControlMemory);
  power_ = memory[kPowerMemory];
  nz_ = memory[kNormalAccelerationMemory];
  ny_ = memory[kSideAccelerationMemory];
  previous_command_ = angles(kCommandMemory);
}

AirData ClosedLoop::air() const { return plant_.AirAround(state_, wind_); }

FlightSensors ClosedLoop::Sense() const {
  const AirData measured = air();
  FlightSensors sensors;
  sensors.alpha_deg = measured.alpha_rad * kDegPerRad;
  sensors.roll_rate_deg_s = state_[kP] * kDegPerRad;
  sensors.pitch_rate_deg_s = state_[kQ] * kDegPerRad;
  sensors.yaw_rate_deg_s = state_[kR] * kDegPerRad;
  sensors.nz = nz_;
  sensors.ny = ny_;
  sensors.dynamic_pressure_psf = measured.dynamic_pressure_psf;
  sensors.static_pressure_psf = measured.static_pressure_psf;
  return sensors;
}

void ClosedLoop::Step(const PilotCommands& pilot) {
  const SurfaceAngles wanted = flight_control_.Step(pilot, Sense(), &flight_control_state_);
  const SurfaceAngles command = delayed_ ? previous_command_ : wanted;
  previous_command_ = wanted;

  const Actuators& actuators = plant_.aircraft().actuators;
  surfaces_.elevator_deg =
      StepActuator(actuators.elevator, surfaces_.elevator_deg, command.elevator_deg, dt_);
  surfaces_.aileron_deg =
      StepActuator(actuators.aileron, surfaces_.aileron_deg, command.aileron_deg, dt_);
  surfaces_.rudder_deg =
      StepActuator(actuators.rudder, surfaces_.rudder_deg, command.rudder_deg, dt_);
  surfaces_.leading_edge_flap_deg =
      StepActuator(actuators.leading_edge_flap, surfaces_.leading_edge_flap_deg,
                   command.leading_edge_flap_deg, dt_);

  const double power_command = PowerCommand(plant_.aircraft().throttle_gearing, pilot.throttle);
  for (int i = 0; i < substeps_; ++i) Integrate(dt_ / substeps_, power_command);
}

ClosedLoop::Flight ClosedLoop::RateOf(const Flight& flight, double power_command,
                                      PlantOutput* output) const {
  const AirData measured = plant_.AirAround(flight.body, wind_);
  Controls controls;
  controls.thrust_lbf =
      Thrust(plant_.aircraft().engine, flight.power, -flight.body[kDown], measured.mach);
  controls.elevator_deg = surfaces_.elevator_deg;
  controls.aileron_deg = surfaces_.aileron_deg;
  controls.rudder_deg = surfaces_.rudder_deg;
  controls.leading_edge_flap_deg = surfaces_.leading_edge_flap_deg;
  *output = plant_.Evaluate(flight.body, controls, wind_, air_rates_);
  return {output->state_rate, PowerRate(plant_.aircraft().power_lag, flight.power, power_command)};
}

void ClosedLoop::Integrate(double dt, double power_command) {
  const Flight start{state_, power_};
  PlantOutput output;
  const Flight k1 = RateOf(start, power_command, &output);
  const Flight k2 = RateOf(start.After(dt / 2, k1), power_command, &output);
  const Flight k3 = RateOf(start.After(dt / 2, k2), power_command, &output);
  const Flight k4 = RateOf(start.After(dt, k3), power_command, &output);
  state_ += dt / 6 * (k1.body + 2 * k2.body + 2 * k3.body + k4.body);
  state_.segment<4>(kQ0).normalize();
  power_ += dt / 6 * (k1.power + 2 * k2.power + 2 * k3.power + k4.power);
  nz_ = output.nz;
  ny_ = output.ny;
}

}  // namespace skein
