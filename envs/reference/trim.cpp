// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/trim.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
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
/// From below the stall: there the solution is a few steps away, or there is none.
constexpr int kMaxIterationsFromBelow = 20;
/// Beyond it little of the weight lies across the flight, for a bank to turn sideways.
constexpr double kSteepPathRad = 85 / kDegPerRad;
/// The largest angle of attack, either way, that a search begins with.
constexpr double kMaxFirstAlpha = 0.5;
/// Steps in which the lift curve is looked at; greatest lift is broader.
constexpr double kLiftStepRad = 1 / kDegPerRad;
/// Angles of attack that are nearer to each other belong to one solution, found twice.
constexpr double kSameAlphaRad = 0.01 / kDegPerRad;

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

bool IsSteep(const TrimRequest& request) {
  return std::abs(request.flight_path_angle_rad) > kSteepPathRad;
}

/// Sine of the flight-path angle at zero sideslip.
double ClimbOf(const TrimPoint& point) {
  return std::cos(point.alpha_rad) * std::sin(point.pitch_rad) -
         std::cos(point.bank_rad) * std::sin(point.alpha_rad) * std::cos(point.pitch_rad);
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
TrimPoint Solve(const Plant& plant, const TrimRequest& request, Vector6 unknowns,
                int max_iterations) {
  constexpr int kMaxHalvings = 6;
  // Linear accelerations weigh by g, angular ones by 1 rad/s^2.
  const auto merit = [](const Vector6& f) {
    return std::hypot(f.head<3>().norm() / kGravityFtS2, f.tail<3>().norm());
  };
  Vector6 f = Accelerations(plant, request, unknowns);
  for (int i = 0; i < max_iterations && f.cwiseAbs().maxCoeff() > kSoughtResidual; ++i) {
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
  // The pitch of vertical flight may come out upside down: a dive where a climb was asked for.
  const bool is_reversed =
      IsSteep(request) && std::sin(request.flight_path_angle_rad) * ClimbOf(point) < 0;
  if (!(point.residual < kAcceptedResidual) || is_reversed) {
    if (IsSteep(request)) {
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

TrimPoint SolveWithinLimits(const Plant& plant, const TrimRequest& request, const Vector6& unknowns,
                            int max_iterations = kMaxIterations) {
  TrimPoint point = Solve(plant, request, unknowns, max_iterations);
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

Vector6 UnknownsOf(const TrimPoint& point) {
  Vector6 unknowns;
  unknowns << point.alpha_rad, point.bank_rad, point.controls.elevator_deg,
      point.controls.aileron_deg, point.controls.rudder_deg, point.controls.thrust_lbf;
  return unknowns;
}

/// Whether the wing lifts more at a smaller alpha, with the surfaces where they are; of flight with
/// alpha below zero, whether it then pushes down more.
bool IsBeyondStall(const Plant& plant, const TrimRequest& request, const TrimPoint& point) {
  const double direction = std::copysign(1.0, point.alpha_rad);
  const auto lift = [&](double alpha) {
    Vector6 unknowns = UnknownsOf(point);
    unknowns[kAlpha] = alpha;
    const TrimPoint at = FlightAt(plant, request, unknowns);
    const auto coefficients = plant.Evaluate(at.state, at.controls).coefficients;
    return direction * (coefficients[0] * std::sin(alpha) - coefficients[2] * std::cos(alpha));
  };
  const double found = lift(point.alpha_rad);
  for (double size = std::abs(point.alpha_rad) - kLiftStepRad; size > 0; size -= kLiftStepRad) {
    if (lift(direction * size) > found) return true;
  }
  return false;
}

/// Where to look for flight below the stall: at the alpha that balances the forces across the
/// flight by the aircraft's own lift slope at alpha zero. A lift curve bends down from there on, so
/// that Newton's method comes up to the solution from below and does not cross the stall.
Vector6 GuessBelowStall(const Plant& plant, const TrimRequest& request, double bank) {
  Vector6 unknowns;
  unknowns << 0, bank, 0, 0, 0, 0;
  const auto acceleration_across = [&](double alpha) {
    unknowns[kAlpha] = alpha;
    const Vector6 f = Accelerations(plant, request, unknowns);
    return f[kU] * std::sin(alpha) - f[kW] * std::cos(alpha);
  };
  const double at_zero = acceleration_across(0);
  const double slope = (acceleration_across(kLiftStepRad) - at_zero) / kLiftStepRad;
  unknowns[kAlpha] = slope > 0 ? std::clamp(-at_zero / slope, -kMaxFirstAlpha, kMaxFirstAlpha) : 0;
  const Vector6 f = Accelerations(plant, request, unknowns);
  unknowns[kThrustLbf] = -plant.aircraft().airframe.mass_slug * f[kU];
  return unknowns;
}

/// Nothing near to the vertical, where little is found and stall is not what is in the way.
std::optional<TrimPoint> SolveBelowStall(const Plant& plant, const TrimRequest& request,
                                         double bank) {
  if (IsSteep(request)) return std::nullopt;
  try {
    return SolveWithinLimits(plant, request, GuessBelowStall(plant, request, bank),
                             kMaxIterationsFromBelow);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// From `guess`. Newton's method may cross the stall, to a flight with a larger alpha than need be
/// or to none: then from below the stall, and the first answer stands unless the second is better.
TrimPoint SolveOnEitherSide(const Plant& plant, const TrimRequest& request, const Vector6& guess) {
  TrimPoint first;
  try {
    first = SolveWithinLimits(plant, request, guess);
  } catch (const Error&) {
    const auto second = SolveBelowStall(plant, request, guess[kBank]);
    if (!second || IsBeyondStall(plant, request, *second)) throw;
    return *second;
  }
  if (!IsBeyondStall(plant, request, first)) return first;
  const auto second = SolveBelowStall(plant, request, guess[kBank]);
  const bool is_lower =
      second && std::abs(second->alpha_rad) < std::abs(first.alpha_rad) - kSameAlphaRad;
  return is_lower ? *second : first;
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
  Vector6 guess;
  guess << std::clamp(lift_coefficient / kLiftSlopePerRad, -kMaxFirstAlpha, kMaxFirstAlpha),
      std::atan(lateral_g), -2, 0, 0, 2000;
  return SolveOnEitherSide(plant, request, guess);
}

TrimPoint Trim(const Plant& plant, const TrimRequest& request, const TrimPoint& start) {
  const Vector6 guess = UnknownsOf(start);
  return IsBeyondStall(plant, request, start) ? SolveWithinLimits(plant, request, guess)
                                              : SolveOnEitherSide(plant, request, guess);
}

}  // namespace skein
