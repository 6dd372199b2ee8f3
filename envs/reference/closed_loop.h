// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/reference/flight_control.h"
#include "envs/reference/plant.h"
#include "envs/reference/trim.h"

namespace skein {

/// Where a closed loop's memory has what: the rigid body first, in the order of its state.
enum ClosedLoopMemory : int {
  kElevatorMemory = 13,  ///< and ailerons, rudder, flap
  kFlightControlMemory = kElevatorMemory + 4,
  kPowerMemory = kFlightControlMemory + kNumFlightControlStates,
  kNormalAccelerationMemory,
  kSideAccelerationMemory,
  kCommandMemory,  ///< surface commands of the last step, as the surfaces
  kClosedLoopMemory = kCommandMemory + 4
};

/// The whole aircraft in double precision, as a pilot flies it: flight control system, actuators,
/// engine and rigid body. The specification of one control step of the vectorised environment:
///   1. sensors: air data and rates of the present state; specific forces, as accelerometers read
///      them, of the last Runge-Kutta stage of the step before, or in the first step those of the
///      trim;
///   2. flight control, and power command from the throttle;
///   3. actuators, by the exact response over the step;
///   4. RK4 of rigid body and engine power together. At every stage thrust is that of the stage's
///      power, altitude and Mach number; the surfaces stand where the actuators have moved
///      them.
class ClosedLoop {
 public:
  /// Starts at rest in `trim`, with power as far as the engine has it. `dt` is the control
  /// interval, s; it is integrated in `substeps` steps. Keeps a reference to `plant`.
  ClosedLoop(const Plant& plant, const TrimPoint& trim, FlightControlMode mode, double dt,
             int substeps = 1);
  ClosedLoop(Plant&&, const TrimPoint&, FlightControlMode, double, int = 1) = delete;

  /// One control step.
  void Step(const PilotCommands& pilot);

  /// Makes surface commands reach the actuators one control step late, as a computer's delay would.
  void set_delayed(bool delayed) { delayed_ = delayed; }

  /// The air's velocity from now on, north, east, down, ft/s, and its angular rates, body axes,
  /// rad/s; zero at first. The aircraft keeps its velocity over ground.
  void set_wind(const Eigen::Vector3d& wind,
                const Eigen::Vector3d& air_rates = Eigen::Vector3d::Zero()) {
    wind_ = wind;
    air_rates_ = air_rates;
  }

  /// All that the next step depends on, as ClosedLoopMemory lays it out.
  Eigen::VectorXd memory() const;
  /// Goes on from there. Throws Error on another size.
  void set_memory(const Eigen::VectorXd& memory);

  /// At the end of the last step.
  const RigidBodyState& state() const { return state_; }
  RigidBodyState& mutable_state() { return state_; }           ///< to fly on from elsewhere
  const SurfaceAngles& surfaces() const { return surfaces_; }  ///< where the actuators stand
  /// Of the filters and integrators.
  const FlightControlState& flight_control_state() const { return flight_control_state_; }
  double power() const { return power_; }  ///< of the engine, 0..100
  double nz() const { return nz_; }        ///< what the accelerometers read, g
  double ny() const { return ny_; }        ///< what the accelerometers read, g
  AirData air() const;                     ///< of the present state in the present wind

 private:
  struct Flight;  // what is integrated
  FlightSensors Sense() const;
  Flight RateOf(const Flight& flight, double power_command, PlantOutput* output) const;
  void Integrate(double dt, double power_command);

  const Plant& plant_;
  FlightControl flight_control_;
  double dt_;
  int substeps_;
  bool delayed_ = false;
  Eigen::Vector3d wind_ = Eigen::Vector3d::Zero(), air_rates_ = Eigen::Vector3d::Zero();
  RigidBodyState state_;
  double power_ = 0;
  double nz_ = 1, ny_ = 0;
  SurfaceAngles surfaces_;
  SurfaceAngles previous_command_;
  FlightControlState flight_control_state_;
};

}  // namespace skein
