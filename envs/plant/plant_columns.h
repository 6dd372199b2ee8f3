// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/state/state.h"

namespace skein {

/// The columns of one aircraft's drawn plant, float32, as the kernels use them: of the nominal
/// plant factors are 1, shifts 0. They keep their values for an episode, but those of the frozen
/// sensor.
enum PlantColumn : int {
  kPlantInverseMass,
  kPlantInverseInertia,  ///< factors of 1 / mass and 1 / moment of inertia
  kPlantCgShift,         ///< chords by which the cg lies further aft
  kPlantAxialForce,      ///< factor of static Cx
  kPlantNormalForce,     ///< of static Cz
  kPlantPitchingMoment,  ///< of static Cm
  kPlantLateral,         ///< of static Cy, Cl and Cn, the increments by the surfaces included
  kPlantElevator,        ///< deflection that acts over the true one
  kPlantAileron,         ///< the same over kPlantLateral, which multiplies its increments, too
  kPlantRudder,          ///< likewise
  kPlantDamping,         ///< factor of all derivatives by p, q and r
  kPlantThrust,          ///< factor of thrust
  kPlantPowerRate,       ///< factor of the rate of power
  kPlantEngineMomentum,  ///< slug ft^2/s in all, over the factor of inertia
  kPlantDensity,         ///< factor of the air's density
  kPlantPitchStick,      ///< factors of stick commands
  kPlantRollStick,
  kPlantYawStick,
  kPlantActuatorRate,     ///< factor of the largest step of an actuator
  kPlantElevatorReached,  ///< fraction of the way to the command in one control step
  kPlantAileronReached,
  kPlantRudderReached,
  kPlantFlapReached,
  kPlantActionDelay,       ///< control steps
  kPlantObservationDelay,  ///< control steps
  kPlantFrozenSensor,      ///< index in kFreezingSensors, or -1: none
  kPlantFreezeStep,        ///< control step at which it freezes; kNeverFreezes if not or no more
  kPlantIsFrozen,          ///< 1 once it is
  kPlantHeld,              ///< what it then shows: the sensor's one or two observed numbers
  kPlantHeldSecond,
  kNumPlantColumns,

  // Only where sensors have biases or scale errors: one for each observed number but the errors
  // (PackSensorError).
  kPlantSensorErrors = kNumPlantColumns,
  kNumSensedNumbers = 19,
  kNumPlantColumnsWithSensors = kPlantSensorErrors + kNumSensedNumbers
};

/// Beyond every clock, control steps: those are int32.
inline constexpr float kNeverFreezes = 4e9f;

/// A sensor that may freeze: the one or two observed numbers that it gives
/// (envs/tasks/observation.h).
struct FreezingSensor {
  int first, count;
};
/// Altitude, equivalent airspeed, alpha, beta, p, q, r. The attitude does not freeze: without it
/// there is nothing left to fly by.
inline constexpr FreezingSensor kFreezingSensors[] = {{3, 1},  {8, 1},  {9, 2}, {11, 2},
                                                      {13, 1}, {14, 1}, {15, 1}};
inline constexpr int kNumFreezingSensors = 7;

/// The drawn plants of a tile's aircraft. Without columns all are nominal.
struct PlantTile {
  Tile columns;  ///< of PlantColumn; their stride is that of the flight's
  bool has_sensor_errors = false;

  bool is_drawn() const { return columns.base != nullptr; }
  float* operator[](int column) const { return columns[column]; }
};

}  // namespace skein
