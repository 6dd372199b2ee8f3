// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/trim_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "envs/tuning/flight_envelope.h"

namespace skein {
namespace {

// Thrust is linear in power between table entries: what the inverse leaves is rounding.
constexpr double kThrustToleranceLbf = 1e-3;
constexpr double kAlphaStepDeg = 1;

double MachOf(const Plant& plant, const TrimRequest& request) {
  return request.true_airspeed_ft_s /
         AirAt(plant.atmosphere(), request.altitude_ft).sound_speed_ft_s;
}

/// Adds what is wrong with `value` if it lies outside the axis; `form` shows one of the axis.
void AppendOutside(const std::vector<double>& axis, double value, const char* below,
                   const char* above, const char* form, std::vector<std::string>* limits) {
  if (value < axis.front()) {
    limits->push_back(fmt::format("is {} the engine's tables, which begin at ", below) +
                      fmt::format(fmt::runtime(form), axis.front()));
  }
  if (value > axis.back()) {
    limits->push_back(fmt::format("is {} the engine's tables, which end at ", above) +
                      fmt::format(fmt::runtime(form), axis.back()));
  }
}

std::vector<std::string> OutsideEngineTables(const Plant& plant, const TrimRequest& request) {
  const EngineTables& engine = plant.aircraft().engine;
  std::vector<std::string> limits;
  AppendOutside(engine.altitude_ft, request.altitude_ft, "below", "above", "{} ft", &limits);
  AppendOutside(engine.mach, MachOf(plant, request), "slower than", "faster than", "Mach {}",
                &limits);
  return limits;
}

}  // namespace

std::vector<std::string> ExceededLimits(const Plant& plant, const TrimRequest& request,
                                        const TrimPoint& trim) {
  std::vector<std::string> limits;
  const EngineTables& engine = plant.aircraft().engine;
  const double mach = MachOf(plant, request), needed = trim.controls.thrust_lbf;
  // The trim's power is the nearest that the engine has; its thrust tells whether that is enough.
  const double available = Thrust(engine, trim.power, request.altitude_ft, mach);
  if (std::abs(available - needed) > kThrustToleranceLbf) {
    limits.push_back(
        needed > available
            ? fmt::format("needs more thrust than the engine has ({:.1f} of {:.1f} lbf)", needed,
                          available)
            : fmt::format("needs less thrust than the engine gives when idle ({:.1f} "
                          "of {:.1f} lbf)",
                          needed, available));
  }
  const std::vector<double>& alpha_deg = plant.aircraft().aerodynamics.alpha_deg;
  const double alpha = trim.alpha_rad * kDegPerRad;
  if (alpha < alpha_deg.front() || alpha > alpha_deg.back()) {
    limits.push_back(fmt::format("has alpha outside the aerodynamic tables ({} to {} deg)",
                                 alpha_deg.front(), alpha_deg.back()));
  }
  for (std::string& limit : OutsideEngineTables(plant, request)) limits.push_back(std::move(limit));
  return limits;
}

std::vector<std::string> BelowStall(const Plant& plant, const TrimRequest& request) {
  const Airframe& airframe = plant.aircraft().airframe;
  const double speed = request.true_airspeed_ft_s;
  const double lateral_g = speed * request.turn_rate_rad_s / kGravityFtS2;
  const double weight_lbf = airframe.mass_slug * kGravityFtS2 *
                            std::cos(request.flight_path_angle_rad) * std::hypot(1, lateral_g);
  const GreatestLift lift = FindGreatestLift(plant, request.altitude_ft, speed, kAlphaStepDeg);
  const double density = AirAt(plant.atmosphere(), request.altitude_ft).density_slug_ft3;
  const double stall_speed = std::sqrt(
      2 * weight_lbf / (density * airframe.wing_area_ft2 * std::max(lift.coefficient, 1e-9)));
  if (speed >= stall_speed) return {};
  return {
      fmt::format("is below stall speed: at {} ft the wing carries the weight from {:.0f} ft/s "
                  "on (lift coefficient {:.2f} at alpha {:.0f} deg)",
                  request.altitude_ft, stall_speed, lift.coefficient, lift.alpha_deg)};
}

std::vector<std::string> LimitsOnTheWay(const Plant& plant, const TrimRequest& request) {
  if (!(request.true_airspeed_ft_s > 0)) return {};
  std::vector<std::string> limits = BelowStall(plant, request);
  for (std::string& limit : OutsideEngineTables(plant, request)) limits.push_back(std::move(limit));
  return limits;
}

TrimPoint TrimOrExplain(const Plant& plant, const TrimRequest& request) {
  try {
    return Trim(plant, request);
  } catch (const Error& error) {
    const std::vector<std::string> limits = LimitsOnTheWay(plant, request);
    if (limits.empty()) throw;
    throw Error(fmt::format("{}: this flight {}", error.what(), fmt::join(limits, ", and ")));
  }
}

}  // namespace skein
