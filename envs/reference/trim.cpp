// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/trim.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/error.h"
#include "envs/aircraft/aircraft.h"
#include "envs/aircraft/engine.h"
#include "envs/reference/flight_control.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"

namespace skein {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What is solved for, in this order; sideslip is zero.
enum Unknown { kAlpha, kBank, kElevatorDeg, kAileronDeg, kRudderDeg, kThrustLbf };

/// A convincing change of each unknown: differences are taken over a thousandth of it.
const Vector6 kScale = (Vector6() << 0.01, 0.001, 0.1, 0.1, 0.1, 100).finished();
/// The largest change in one iteration: about one cell of the tables.
const Vector6 kLargestStep = (Vector6() << 0.05, 0.05, 4, 4, 4, 5000).finished();

constexpr double kAcceptedResidual = 1e-6;
constexpr double kSoughtResidual = 1e-11;
constexpr int kMaxIterations = 60;
/// Beyond it little of the weight lies across the flight, for a bank to turn sideways.
constexpr double kSteepPathRad = 85 / kDegPerRad;

std::string Describe(const TrimRequest& request) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(),
                "altitude %g ft, speed %g ft/s, flight-path angle %g deg, turn rate %g deg/s",
                request.altitude_ft, request.true_airspeed_ft_s,
                kDegPerRad * request.flight_path_angle_rad, kDegPerRad * request.turn_rate_rad_s);
  std::string where = text.data();
  if (request.pull_up_rate_rad_s != 0) {
    std::snprintf(text.data(), text.size(), ", pull-up %g deg/s",
                  kDegPerRad * request.pull_up_rate_rad_s);
    where += text.data();
  }
  return where;
}

/// Pitch angle that gives the flight-path angle at zero sideslip: Stevens and Lewis, Aircraft
/// Control and Simulation, the rate-of-climb constraint.
double PitchFor(double alpha, double bank, double flight_path_angle) {
  const double a = std::cos(alpha);
  const double b = std::cos(bank) * std::sin(alpha);
  const double climb = std::sin(flight_path_angle);
  // Nearly vertical flight has no pitch for some of what an iteration tries: the nearest is taken.
  const double rest = std::max(0.0, a * a - climb * climb + b * b);
  return std::atan2(a * b + climb * std::sqrt(rest), a * a - climb * climb);
}

/// The steady flight that the unknowns describe, balanced or not.
TrimPoint FlightAt(const Plant& plant, const TrimRequest& request, const Vector6& unknowns) {
  const double speed = request.true_airspeed_ft_s;
  TrimPoint point;
  point.alpha_rad = unknowns[kAlpha];
  point.bank_rad = unknowns[kBank];
  point.pitch_rad = PitchFor(point.alpha_rad, point.bank_rad, request.flight_path_angle_rad);

  point.state.setZero();
  point.state[kU] = speed * std::cos(point.alpha_rad);
  point.state[kW] = speed * std::sin(point.alpha_rad);
  // A turn about the vertical and one about the horizontal across the flight, seen in body axes.
  const double level = request.turn_rate_rad_s * std::cos(point.pitch_rad);
  const double sine = std::sin(point.bank_rad), cosine = std::cos(point.bank_rad);
  point.state[kP] = -request.turn_rate_rad_s * std::sin(point.pitch_rad);
  point.state[kQ] = level * sine + request.pull_up_rate_rad_s * cosine;
  point.state[kR] = level * cosine - request.pull_up_rate_rad_s * sine;
  point.state[kDown] = -request.altitude_ft;
  point.state.segment<4>(kQ0) = QuaternionFromEuler({point.bank_rad, point.pitch_rad, 0});

  const Air air = AirAt(plant.atmosphere(), request.altitude_ft);
  point.controls.thrust_lbf = unknowns[kThrustLbf];
  point.controls.elevator_deg = unknowns[kElevatorDeg];
  point.controls.aileron_deg = unknowns[kAileronDeg];
  point.controls.rudder_deg = unknowns[kRudderDeg];
  point.controls.leading_edge_flap_deg =
      SteadyLeadingEdgeFlap(plant.aircraft(), point.alpha_rad * kDegPerRad,
                            0.5 * air.density_slug_ft3 * speed * speed, air.pressure_lbf_ft2);
  return point;
}

/// What must vanish: accelerations along and about the body axes, ft/s^2 and rad/s^2.
Vector6 Accelerations(const Plant& plant, const TrimRequest& request, const Vector6& unknowns) {
  const TrimPoint point = FlightAt(plant, request, unknowns);
  return plant.Evaluate(point.state, point.controls).state_rate.head<6>();
}

Matrix6 Jacobian(const Plant& plant, const TrimRequest& request, const Vector6& unknowns) {
  Matrix6 jacobian;
  for (int i = 0; i < 6; ++i) {
    const double step = 1e-3 * kScale[i];
    Vector6 ahead = unknowns, behind = unknowns;
    ahead[i] += step;
    behind[i] -= step;
    jacobian.col(i) =
        (Accelerations(plant, request, ahead) - Accelerations(plant, request, behind)) / (2 * step);
  }
  return jacobian;
}

/// Newton's method with limited steps. The tables are piecewise linear: across a kink the full step
/// may make things worse, so it is halved until it does not, and then taken as it is.
TrimPoint Solve(const Plant& plant, const TrimRequest& request, Vector6 unknowns) {
  constexpr int kMaxHalvings = 6;
  // Linear accelerations weigh by g, angular ones by 1 rad/s^2.
  const auto merit = [](const Vector6& f) {
    return std::hypot(f.head<3>().norm() / kGravityFtS2, f.tail<3>().norm());
  };
  Vector6 f = Accelerations(plant, request, unknowns);
  for (int i = 0; i < kMaxIterations && f.cwiseAbs().maxCoeff() > kSoughtResidual; ++i) {
    Vector6 step = Jacobian(plant, request, unknowns).fullPivLu().solve(-f);
    step /= std::max(1.0, step.cwiseQuotient(kLargestStep).cwiseAbs().maxCoeff());
    Vector6 next = unknowns + step;
    Vector6 next_f = Accelerations(plant, request, next);
    for (int halving = 0; halving < kMaxHalvings && merit(next_f) > merit(f); ++halving) {
      step *= 0.5;
      next = unknowns + step;
      next_f = Accelerations(plant, request, next);
    }
    if (merit(next_f) >= merit(f) && f.cwiseAbs().maxCoeff() < kAcceptedResidual) break;
    unknowns = next;
    f = next_f;
  }

  TrimPoint point = FlightAt(plant, request, unknowns);
  point.residual = f.cwiseAbs().maxCoeff();
  if (!(point.residual < kAcceptedResidual)) {
    if (std::abs(request.flight_path_angle_rad) > kSteepPathRad) {
      throw Error("no steady flight found at " + Describe(request) +
                  ": this near to the vertical bank hardly moves the weight sideways, and flight "
                  "without sideslip is often not found");
    }
    throw Error("no steady flight found at " + Describe(request) + ": accelerations of " +
                std::to_string(point.residual) + " ft/s^2 or rad/s^2 remain");
  }
  return point;
}

void CheckDeflection(const TrimRequest& request, const char* surface, double deflection_deg,
                     const Actuator& actuator) {
  if (deflection_deg < actuator.min_deg || deflection_deg > actuator.max_deg) {
    throw Error("steady flight at " + Describe(request) + " needs " + surface + " at " +
                std::to_string(deflection_deg) + " deg, beyond its limits of " +
                std::to_string(actuator.min_deg) + " to " + std::to_string(actuator.max_deg));
  }
}

TrimPoint SolveWithinLimits(const Plant& plant, const TrimRequest& request,
                            const Vector6& unknowns) {
  TrimPoint point = Solve(plant, request, unknowns);
  const Actuators& actuators = plant.aircraft().actuators;
  CheckDeflection(request, "the elevator", point.controls.elevator_deg, actuators.elevator);
  CheckDeflection(request, "the ailerons", point.controls.aileron_deg, actuators.aileron);
  CheckDeflection(request, "the rudder", point.controls.rudder_deg, actuators.rudder);
  const Air air = AirAt(plant.atmosphere(), request.altitude_ft);
  point.power =
      PowerForThrust(plant.aircraft().engine, point.controls.thrust_lbf, request.altitude_ft,
                     request.true_airspeed_ft_s / air.sound_speed_ft_s);
  return point;
}

}  // namespace

TrimPoint Trim(const Plant& plant, const TrimRequest& request) {
  if (!(request.true_airspeed_ft_s > 0)) {
    throw Error("a trim needs a speed above zero; asked for " + Describe(request));
  }
  const Airframe& airframe = plant.aircraft().airframe;
  const double speed = request.true_airspeed_ft_s;
  const double density = AirAt(plant.atmosphere(), request.altitude_ft).density_slug_ft3;
  const double gravity = plant.gravity().At(request.altitude_ft);
  const double lateral_g =
      speed * request.turn_rate_rad_s * std::cos(request.flight_path_angle_rad) / gravity;
  const double upward_g = 1 + speed * request.pull_up_rate_rad_s / gravity;
  const double lift_coefficient = airframe.mass_slug * gravity *
                                  std::copysign(std::hypot(upward_g, lateral_g), upward_g) /
                                  (0.5 * density * speed * speed * airframe.wing_area_ft2);
  // A wing of this aspect ratio lifts about 4 per radian.
  constexpr double kLiftSlopePerRad = 4;
  constexpr double kMaxFirstAlpha = 0.5;
  Vector6 guess;
  guess << std::clamp(lift_coefficient / kLiftSlopePerRad, -kMaxFirstAlpha, kMaxFirstAlpha),
      std::atan(lateral_g), -2, 0, 0, 2000;
  return SolveWithinLimits(plant, request, guess);
}

TrimPoint Trim(const Plant& plant, const TrimRequest& request, const TrimPoint& start) {
  Vector6 guess;
  guess << start.alpha_rad, start.bank_rad, start.controls.elevator_deg, start.controls.aileron_deg,
      start.controls.rudder_deg, start.controls.thrust_lbf;
  return SolveWithinLimits(plant, request, guess);
}

}  // namespace skein
