// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/trim_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/choice_error.h"
#include "envs/aircraft/engine.h"
#include "envs/tuning/flight_envelope.h"

namespace skein {
namespace {

// Thrust is linear in power between table entries: what the inverse leaves is rounding.
constexpr double kThrustToleranceLbf = 1e-3;
constexpr double kAlphaStepDeg = 0.5;

double MachOf(const Plant& plant, const TrimRequest& request) {
  return request.true_airspeed_ft_s /
         AirAt(plant.atmosphere(), request.altitude_ft).sound_speed_ft_s;
}

/// Adds what is wrong with `value` if it lies outside the axis; `form` shows one of the axis.
void AppendOutside(const std::vector<double>& axis, double value, const char* below,
                   const char* above, const char* form, std::vector<ExceededLimit>* limits) {
  if (value < axis.front()) {
    limits->push_back({FlightLimit::kEngineTables,
                       fmt::format("is {} the engine's tables, which begin at ", below) +
                           fmt::format(fmt::runtime(form), axis.front())});
  }
  if (value > axis.back()) {
    limits->push_back({FlightLimit::kEngineTables,
                       fmt::format("is {} the engine's tables, which end at ", above) +
                           fmt::format(fmt::runtime(form), axis.back())});
  }
}

std::vector<ExceededLimit> OutsideEngineTables(const Plant& plant, const TrimRequest& request) {
  const EngineTables& engine = plant.aircraft().engine;
  std::vector<ExceededLimit> limits;
  AppendOutside(engine.altitude_ft, request.altitude_ft, "below", "above", "{:.0f} ft", &limits);
  AppendOutside(engine.mach, MachOf(plant, request), "slower than", "faster than", "Mach {:.6g}",
                &limits);
  return limits;
}

/// A wing that has stalled may carry the weight, too, as a plate that leans on thrust.
std::vector<ExceededLimit> BeyondStall(const Plant& plant, const TrimRequest& request,
                                       const TrimPoint& trim) {
  const GreatestLift lift =
      FindGreatestLift(plant, request.altitude_ft, request.true_airspeed_ft_s, kAlphaStepDeg);
  const double alpha_deg = trim.alpha_rad * kDegPerRad;
  if (alpha_deg <= lift.alpha_deg + kAlphaStepDeg) return {};
  return {{FlightLimit::kStall,
           fmt::format("is beyond the stall (alpha {:.1f} deg; the wing has its greatest lift "
                       "coefficient, {:.2f}, at {:.1f} deg)",
                       alpha_deg, lift.coefficient, lift.alpha_deg)}};
}

}  // namespace

std::vector<std::string> WordsOf(const std::vector<ExceededLimit>& limits) {
  std::vector<std::string> words;
  for (const ExceededLimit& limit : limits) words.push_back(limit.words);
  return words;
}

std::vector<ExceededLimit> ExceededLimits(const Plant& plant, const TrimRequest& request,
                                          const TrimPoint& trim) {
  std::vector<ExceededLimit> limits;
  const EngineTables& engine = plant.aircraft().engine;
  const double mach = MachOf(plant, request), needed = trim.controls.thrust_lbf;
  // The trim's power is the nearest that the engine has; its thrust tells whether that is enough.
  const double available = Thrust(engine, trim.power, request.altitude_ft, mach);
  if (std::abs(available - needed) > kThrustToleranceLbf) {
    limits.push_back(
        needed > available
            ? ExceededLimit{FlightLimit::kThrust,
                            fmt::format("needs more thrust than the engine has ({:.6g} of {:.6g} "
                                        "lbf: short by {:.6g} lbf at full throttle)",
                                        needed, available, needed - available)}
            : ExceededLimit{FlightLimit::kIdle,
                            fmt::format("needs less thrust than the engine gives when idle ({:.6g} "
                                        "of {:.6g} lbf: {:.6g} lbf too much)",
                                        needed, available, available - needed)});
  }
  const std::vector<double>& alpha_deg = plant.aircraft().aerodynamics.alpha_deg;
  const double alpha = trim.alpha_rad * kDegPerRad;
  if (alpha < alpha_deg.front() || alpha > alpha_deg.back()) {
    limits.push_back({FlightLimit::kAlphaTables,
                      fmt::format("has alpha outside the aerodynamic tables ({} to {} deg)",
                                  alpha_deg.front(), alpha_deg.back())});
  }
  if (!limits.empty()) {  // what a stalled wing lacks it lacks because it has stalled
    std::vector<ExceededLimit> stall = BeyondStall(plant, request, trim);
    limits.insert(limits.begin(), stall.begin(), stall.end());
  }
  for (ExceededLimit& limit : OutsideEngineTables(plant, request))
    limits.push_back(std::move(limit));
  return limits;
}

std::vector<ExceededLimit> BelowStall(const Plant& plant, const TrimRequest& request) {
  const Airframe& airframe = plant.aircraft().airframe;
  const double speed = request.true_airspeed_ft_s;
  const double climb = std::cos(request.flight_path_angle_rad);
  const double gravity = plant.gravity().At(request.altitude_ft);
  const double lateral_g = climb * speed * request.turn_rate_rad_s / gravity;
  const double upward_g = climb + speed * request.pull_up_rate_rad_s / gravity;
  const double load = std::hypot(upward_g, lateral_g);
  const double carried_lbf = load * airframe.mass_slug * gravity;
  const GreatestLift lift = FindGreatestLift(plant, request.altitude_ft, speed, kAlphaStepDeg);
  const double density = AirAt(plant.atmosphere(), request.altitude_ft).density_slug_ft3;
  const double stall_speed = std::sqrt(
      2 * carried_lbf / (density * airframe.wing_area_ft2 * std::max(lift.coefficient, 1e-9)));
  if (speed >= stall_speed) return {};
  const std::string times = std::abs(load - 1) < 0.005 ? "" : fmt::format("{:.3g} times ", load);
  return {{FlightLimit::kStall,
           fmt::format("is below stall speed: at {} ft the wing carries {}the weight from {:.0f} "
                       "ft/s on (lift coefficient {:.2f} at alpha {:.1f} deg)",
                       request.altitude_ft, times, stall_speed, lift.coefficient, lift.alpha_deg)}};
}

std::vector<ExceededLimit> LimitsOnTheWay(const Plant& plant, const TrimRequest& request) {
  if (!(request.true_airspeed_ft_s > 0)) return {};
  std::vector<ExceededLimit> limits = BelowStall(plant, request);
  for (ExceededLimit& limit : OutsideEngineTables(plant, request))
    limits.push_back(std::move(limit));
  return limits;
}

TrimPoint TrimOrExplain(const Plant& plant, const TrimRequest& request) {
  try {
    return Trim(plant, request);
  } catch (const Error& error) {
    const std::vector<std::string> limits = WordsOf(LimitsOnTheWay(plant, request));
    if (limits.empty()) throw ChoiceError(error.what());
    throw ChoiceError(fmt::format("this flight {}; {}", fmt::join(limits, ", and "), error.what()));
  }
}

}  // namespace skein
