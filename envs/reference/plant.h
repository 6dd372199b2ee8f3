// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "envs/air/atmosphere.h"
#include "envs/air/gravity.h"
#include "envs/aircraft/aircraft.h"

namespace skein {

/// u v w [ft/s], p q r [rad/s], north east down [ft], q0 qx qy qz: the order of
/// envs/state/state.h.
using RigidBodyState = Eigen::Matrix<double, 13, 1>;

/// What acts on the airframe: thrust along body x and surface positions (signs:
/// docs/reference/conventions.md).
struct Controls {
  double thrust_lbf = 0;
  double elevator_deg = 0, aileron_deg = 0, rudder_deg = 0, leading_edge_flap_deg = 0;
};

/// What a flight through the air is measured by.
struct AirData {
  double true_airspeed_ft_s = 0;
  double alpha_rad = 0, beta_rad = 0;
  double mach = 0;
  double dynamic_pressure_psf = 0;
  double static_pressure_psf = 0;
};

/// Air data of a rigid-body state, in still air or in one that moves by `wind` (north, east, down,
/// ft/s). Density and with it pressure are `density_factor` times the model's.
AirData MeasureAir(AtmosphereModel atmosphere, const RigidBodyState& state,
                   const Eigen::Vector3d& wind = Eigen::Vector3d::Zero(),
                   double density_factor = 1);

/// One evaluation of the equations of motion.
struct PlantOutput {
  RigidBodyState state_rate;  ///< time derivative of the state
  /// Cx, Cy, Cz, Cl, Cm, Cn about the cg, damping and controls included.
  Eigen::Matrix<double, 6, 1> coefficients;
  AirData air;
  double nx = 0, ny = 0, nz = 0;  ///< specific forces, g: Fx/(m g), Fy/(m g), -Fz/(m g)
};

/// The plain float64 aircraft: the specification that the SIMD kernels are tested against, and what
/// trim and linearisation use. Equations 1 to 17 of the NeuralPlane paper; no actuators, engine lag
/// or flight control.
class Plant {
 public:
  /// Of any aircraft, flown in any atmosphere, whose density is `density_factor` times the model's.
  Plant(Aircraft aircraft, AtmosphereModel atmosphere, double density_factor = 1,
        const Gravity& gravity = {});

  /// The same plant, whose aircraft has other gains of flight control.
  Plant WithFlightControl(const FlightControlGains& gains) const;

  const Aircraft& aircraft() const { return aircraft_; }      ///< as given
  AtmosphereModel atmosphere() const { return atmosphere_; }  ///< as given
  const Gravity& gravity() const { return gravity_; }         ///< as given

  /// Air data in the plant's air.
  AirData AirAround(const RigidBodyState& state, const Eigen::Vector3d& wind) const {
    return MeasureAir(atmosphere_, state, wind, density_factor_);
  }

  /// `wind` is the air's velocity, north, east, down, ft/s; `air_rates` are its angular rates, body
  /// axes, rad/s, to which the aircraft's are relative in the damping.
  PlantOutput Evaluate(const RigidBodyState& state, const Controls& controls,
                       const Eigen::Vector3d& wind = Eigen::Vector3d::Zero(),
                       const Eigen::Vector3d& air_rates = Eigen::Vector3d::Zero()) const;

  /// One classic RK4 step of `dt` seconds with controls and wind held; the quaternion is
  /// renormalised after it.
  RigidBodyState StepRk4(const RigidBodyState& state, const Controls& controls, double dt,
                         const Eigen::Vector3d& wind = Eigen::Vector3d::Zero()) const;

 private:
  Aircraft aircraft_;
  AtmosphereModel atmosphere_;
  double density_factor_;
  Gravity gravity_;
};

}  // namespace skein
