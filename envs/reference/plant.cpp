// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/plant.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "envs/aircraft/table_lookup.h"
#include "envs/reference/aerodynamics.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"

namespace skein {
namespace {

/// Keeps flow angles and dimensionless rates defined at rest, ft/s.
constexpr double kMinAirspeedFtS = 0.01;

/// Angular acceleration from moments L, M, N about the body axes, for a body that is symmetric
/// about its x-z plane and carries the angular momentum of its engine along x.
Eigen::Vector3d AngularAcceleration(const Airframe& a, const Eigen::Vector3d& rates,
                                    const Eigen::Vector3d& moments) {
  const double p = rates.x(), q = rates.y(), r = rates.z();
  const double h = a.engine_angular_momentum;
  const double determinant = a.Ixx * a.Izz - a.Ixz * a.Ixz;
  // Gyroscopic moments, in the axes of the moments.
  const double L = moments.x() + (a.Iyy - a.Izz) * q * r + a.Ixz * p * q;
  const double M = moments.y() + (a.Izz - a.Ixx) * p * r - a.Ixz * (p * p - r * r) - h * r;
  const double N = moments.z() + (a.Ixx - a.Iyy) * p * q - a.Ixz * q * r + h * q;
  return {(a.Izz * L + a.Ixz * N) / determinant, M / a.Iyy, (a.Ixz * L + a.Ixx * N) / determinant};
}

}  // namespace

AirData MeasureAir(AtmosphereModel atmosphere, const RigidBodyState& state,
                   const Eigen::Vector3d& wind, double density_factor) {
  const Eigen::Vector3d velocity = state.segment<3>(kU) - BodyFromNed(state.segment<4>(kQ0)) * wind;
  const Air air = AirAt(atmosphere, -state[kDown]);
  const double speed = std::max(velocity.norm(), kMinAirspeedFtS);
  AirData data;
  data.true_airspeed_ft_s = speed;
  data.alpha_rad = std::atan2(velocity.z(), velocity.x());
  data.beta_rad = std::asin(std::clamp(velocity.y() / speed, -1.0, 1.0));
  data.mach = speed / air.sound_speed_ft_s;
  data.dynamic_pressure_psf = 0.5 * density_factor * air.density_slug_ft3 * speed * speed;
  data.static_pressure_psf = density_factor * air.pressure_lbf_ft2;
  return data;
}

Plant::Plant(Aircraft aircraft, AtmosphereModel atmosphere, double density_factor,
             const Gravity& gravity)
    : aircraft_(std::move(aircraft)),
      atmosphere_(atmosphere),
      density_factor_(density_factor),
      gravity_(gravity) {}

Plant Plant::WithFlightControl(const FlightControlGains& gains) const {
  Plant plant = *this;
  plant.aircraft_.flight_control = gains;
  return plant;
}

PlantOutput Plant::Evaluate(const RigidBodyState& state, const Controls& controls,
                            const Eigen::Vector3d& wind, const Eigen::Vector3d& air_rates) const {
  const Airframe& airframe = aircraft_.airframe;
  const Eigen::Vector3d velocity = state.segment<3>(kU);
  const Eigen::Vector3d rates = state.segment<3>(kP);
  const Eigen::Vector4d quaternion = state.segment<4>(kQ0);
  const Eigen::Matrix3d body_from_ned = BodyFromNed(quaternion);

  PlantOutput output;
  const AirData& air = output.air = AirAround(state, wind);
  const Eigen::Vector3d damped = rates - air_rates;

  AerodynamicCondition condition;
  condition.alpha_deg = air.alpha_rad * kDegPerRad;
  condition.beta_deg = air.beta_rad * kDegPerRad;
  condition.elevator_deg = controls.elevator_deg;
  condition.aileron_deg = controls.aileron_deg;
  condition.rudder_deg = controls.rudder_deg;
  condition.leading_edge_flap_deg = controls.leading_edge_flap_deg;
  condition.p_hat = damped.x() * airframe.span_ft / (2 * air.true_airspeed_ft_s);
  condition.q_hat = damped.y() * airframe.chord_ft / (2 * air.true_airspeed_ft_s);
  condition.r_hat = damped.z() * airframe.span_ft / (2 * air.true_airspeed_ft_s);
  output.coefficients = EvaluateAerodynamics(aircraft_, condition);

  if (aircraft_.drag_rises) output.coefficients[0] -= ValueAt(aircraft_.drag_rise, air.mach);

  const double qbar_S = air.dynamic_pressure_psf * airframe.wing_area_ft2;
  Eigen::Vector3d force = qbar_S * output.coefficients.head<3>();
  force.x() += controls.thrust_lbf;
  const Eigen::Vector3d lengths(airframe.span_ft, airframe.chord_ft, airframe.span_ft);
  const Eigen::Vector3d moments = qbar_S * lengths.cwiseProduct(output.coefficients.tail<3>());

  const Eigen::Vector3d specific_force = force / airframe.mass_slug;
  const Eigen::Vector3d gravity = gravity_.At(-state[kDown]) * body_from_ned.col(2);
  output.nx = specific_force.x() / kGravityFtS2;
  output.ny = specific_force.y() / kGravityFtS2;
  output.nz = -specific_force.z() / kGravityFtS2;

  output.state_rate.segment<3>(kU) = specific_force + gravity - rates.cross(velocity);
  output.state_rate.segment<3>(kP) = AngularAcceleration(airframe, rates, moments);
  output.state_rate.segment<3>(kNorth) = body_from_ned.transpose() * velocity;
  // q' = q * (0, p, q, r) / 2, a product of quaternions.
  const Eigen::Vector3d vector = quaternion.tail<3>();
  output.state_rate[kQ0] = -0.5 * vector.dot(rates);
  output.state_rate.segment<3>(kQx) = 0.5 * (quaternion[0] * rates + vector.cross(rates));
  return output;
}

RigidBodyState Plant::StepRk4(const RigidBodyState& state, const Controls& controls, double dt,
                              const Eigen::Vector3d& wind) const {
  const auto rate = [&](const RigidBodyState& at) {
    return Evaluate(at, controls, wind).state_rate;
  };
  const RigidBodyState k1 = rate(state);
  const RigidBodyState k2 = rate(state + dt / 2 * k1);
  const RigidBodyState k3 = rate(state + dt / 2 * k2);
  const RigidBodyState k4 = rate(state + dt * k3);
  RigidBodyState next = state + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  next.segment<4>(kQ0).normalize();
  return next;
}

}  // namespace skein
