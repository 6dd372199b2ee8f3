// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/aircraft_findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/units.h"
#include "envs/reference/linear_flight.h"
#include "envs/state/state.h"
#include "envs/tuning/linear_modes.h"

namespace skein {
namespace {

/// Text as of printf.
__attribute__((format(printf, 1, 2))) std::string Say(const char* form, ...) {
  std::array<char, 320> text;
  va_list values;
  va_start(values, form);
  std::vsnprintf(text.data(), text.size(), form, values);
  va_end(values);
  return text.data();
}

class Findings {
 public:
  void Error(bool is_wrong, const std::string& text) { Add(is_wrong, Finding::kError, text); }
  void Warn(bool is_odd, const std::string& text) { Add(is_odd, Finding::kWarning, text); }
  std::vector<Finding> Take() { return std::move(findings_); }

 private:
  void Add(bool is_found, Finding::Kind kind, const std::string& text) {
    if (is_found) findings_.push_back({kind, text});
  }

  std::vector<Finding> findings_;
};

/// What an aircraft weighs and measures, in the units of its file.
struct Sizes {
  double mass, wing_area, span, chord, Ixx, Iyy, Izz, Ixz;
  const char *mass_unit, *length_unit, *inertia_unit;  ///< as the keys end
  double kg_per_mass = 1, metres_per_length = 1;
};

Sizes SizesOf(const DerivativeAircraft& a) {
  return {a.mass_kg,   a.wing_area_m2, a.span_m, a.chord_m, a.Ixx_kg_m2, a.Iyy_kg_m2,
          a.Izz_kg_m2, a.Ixz_kg_m2,    "kg",     "m",       "kg_m2"};
}

Sizes SizesOf(const Airframe& a) {
  return {a.mass_slug, a.wing_area_ft2, a.span_ft, a.chord_ft, a.Ixx,      a.Iyy,         a.Izz,
          a.Ixz,       "slug",          "ft",      "slug_ft2", kKgPerSlug, kMetresPerFoot};
}

/// That no principal moment of inertia is above the sum of the other two. One of three is the
/// pitch axis's, as left and right are alike.
void CheckPrincipalInertia(const Sizes& a, Findings* findings) {
  constexpr double kRounding = 1e-9;
  const double mean = (a.Ixx + a.Izz) / 2, half = std::hypot((a.Ixx - a.Izz) / 2, a.Ixz);
  const double least = mean - half, most = mean + half;
  const auto exceeds = [](double moment, double others) {
    return moment > (1 + kRounding) * others;
  };
  const struct {
    const char* name;
    double inertia, others;
  } axes[] = {
      {"Ixx", a.Ixx, a.Iyy + a.Izz}, {"Iyy", a.Iyy, a.Ixx + a.Izz}, {"Izz", a.Izz, a.Ixx + a.Iyy}};
  bool is_said = false;
  for (const auto& axis : axes) {
    const bool is_wrong = exceeds(axis.inertia, axis.others);
    findings->Error(is_wrong,
                    Say("airframe.%s_%s = %g is above the sum of the other two, %g: no body has "
                        "such moments of inertia",
                        axis.name, a.inertia_unit, axis.inertia, axis.others));
    is_said = is_said || is_wrong;
  }
  findings->Error(!is_said && exceeds(most, least + a.Iyy),
                  Say("airframe.Ixz_%s = %g makes principal moments of inertia of %.3g, %.3g and "
                      "%.3g: no body has one above the sum of the other two",
                      a.inertia_unit, a.Ixz, least, a.Iyy, most));
}

/// Radii of gyration over half the span, as Roskam tabulates them (Airplane Design V, appendix B;
/// there pitch and yaw also by the length, which a derivative model does not have): what aircraft
/// from gliders to fighters have, widened by a quarter.
void CheckInertia(const Sizes& a, Findings* findings) {
  const auto ratio = [&](double inertia) { return 2 * std::sqrt(inertia / a.mass) / a.span; };
  const struct {
    const char* name;
    double inertia, low, high;
  } axes[] = {{"Ixx", a.Ixx, 0.13, 0.5}, {"Iyy", a.Iyy, 0.15, 1.1}, {"Izz", a.Izz, 0.22, 1.2}};
  for (const auto& axis : axes) {
    const double found = ratio(axis.inertia);
    findings->Warn(
        found < axis.low || found > axis.high,
        Say("airframe.%s_%s = %g is a radius of gyration of %.2f half spans; aircraft have "
            "%.2f to %.2f",
            axis.name, a.inertia_unit, axis.inertia, found, axis.low, axis.high));
  }
  CheckPrincipalInertia(a, findings);
}

void CheckGeometry(const Sizes& a, Findings* findings) {
  const double mean_chord = a.wing_area / a.span;
  findings->Warn(a.chord < 0.7 * mean_chord || a.chord > 1.6 * mean_chord,
                 Say("airframe.chord_%s = %g, while wing area over span is %.3g", a.length_unit,
                     a.chord, mean_chord));
  const double loading =
      a.mass * a.kg_per_mass * 9.81 / (a.wing_area * a.metres_per_length * a.metres_per_length);
  findings->Warn(loading < 20 || loading > 8000,
                 Say("a wing loading of %.0f N/m2 is that of no aircraft: airframe.mass_%s, "
                     "wing_area_%s2",
                     loading, a.mass_unit, a.length_unit));
}

/// Of its weight and measures.
void CheckSizes(const Sizes& sizes, Findings* findings) {
  CheckGeometry(sizes, findings);
  CheckInertia(sizes, findings);
}

void CheckLongitudinal(const LongitudinalDerivatives& k, Findings* findings) {
  findings->Error(k.CL_alpha <= 0,
                  Say("longitudinal.CL_alpha = %g: lift must grow with alpha", k.CL_alpha));
  findings->Warn(
      k.CL_alpha > 0 && (k.CL_alpha < 1.5 || k.CL_alpha > 7),
      Say("longitudinal.CL_alpha = %g per radian; wings have 1.5 to 7 (per degree?)", k.CL_alpha));
  findings->Error(k.CD_parasitic <= 0,
                  Say("longitudinal.CD_parasitic = %g: an aircraft without drag", k.CD_parasitic));
  findings->Warn(k.CD_parasitic > 0.2,
                 Say("longitudinal.CD_parasitic = %g; aircraft have 0.01 to 0.1", k.CD_parasitic));
  findings->Warn(
      k.oswald_efficiency < 0.5 || k.oswald_efficiency > 1.1,
      Say("longitudinal.oswald_efficiency = %g; wings have 0.6 to 1", k.oswald_efficiency));
  const double margin = k.CL_alpha > 0 ? -k.Cm_alpha / k.CL_alpha : 0;
  findings->Warn(k.Cm_alpha >= 0,
                 Say("longitudinal.Cm_alpha = %g: the static margin is negative, %.1f %% of the "
                     "chord; only flight control keeps it from diverging",
                     k.Cm_alpha, 100 * margin));
  findings->Warn(margin > 0.6, Say("the static margin is %.0f %% of the chord", 100 * margin));
  findings->Error(k.Cm_q >= 0, Say("longitudinal.Cm_q = %g does not damp pitch", k.Cm_q));
  findings->Error(
      k.Cm_elevator >= 0,
      Say("longitudinal.Cm_elevator = %g: elevator down must bring the nose down", k.Cm_elevator));
}

void CheckLateral(const LateralDerivatives& k, Findings* findings) {
  findings->Error(k.Cl_p >= 0, Say("lateral.Cl_p = %g does not damp roll", k.Cl_p));
  findings->Error(k.Cn_r >= 0, Say("lateral.Cn_r = %g does not damp yaw", k.Cn_r));
  findings->Error(
      k.Cl_aileron <= 0,
      Say("lateral.Cl_aileron = %g: positive ailerons roll right, as in books", k.Cl_aileron));
  findings->Error(k.Cn_rudder > 0,
                  Say("lateral.Cn_rudder = %g: positive rudder yaws left", k.Cn_rudder));
  findings->Warn(k.Cn_rudder == 0,
                 "lateral.Cn_rudder = 0: there is no rudder, and `skein aircraft tune` leaves its "
                 "gains 0");
  findings->Warn(k.Cn_beta <= 0, Say("lateral.Cn_beta = %g: no weathercock stability", k.Cn_beta));
  findings->Warn(k.Cl_beta > 0,
                 Say("lateral.Cl_beta = %g: sideslip rolls into the wind", k.Cl_beta));
  findings->Warn(k.CY_beta >= 0,
                 Say("lateral.CY_beta = %g: side force must oppose sideslip", k.CY_beta));
  findings->Warn(k.Cn_aileron > 0.1 * std::abs(k.Cl_aileron),
                 Say("lateral.Cn_aileron = %g: ailerons yaw into the roll; is the sign that of "
                     "ailerons positive to the left?",
                     k.Cn_aileron));
}

/// Derivatives that aircraft do not have near zero. The bounds are judgement: well below a small
/// flying wing's (the Zagi of Beard and McLain) and an airliner's, and above what per-degree
/// numbers, 57 times too small, mostly are.
void CheckPerRadian(const DerivativeAircraft& a, Findings* findings) {
  const LongitudinalDerivatives& pitch = a.longitudinal;
  const LateralDerivatives& roll = a.lateral;
  const struct {
    const char* name;
    double value, sign, least;
  } derivatives[] = {{"longitudinal.Cm_elevator", pitch.Cm_elevator, -1, 0.1},
                     {"lateral.CY_beta", roll.CY_beta, -1, 0.02},
                     {"lateral.Cl_p", roll.Cl_p, -1, 0.05},
                     {"lateral.Cl_aileron", roll.Cl_aileron, 1, 0.005}};
  for (const auto& one : derivatives) {
    const double size = one.sign * one.value;
    findings->Warn(size > 0 && size < one.least,
                   Say("%s = %g per radian; aircraft have %g or more in magnitude (per degree?)",
                       one.name, one.value, one.least));
  }
}

void CheckActuator(const char* surface, const Actuator& actuator, Findings* findings) {
  constexpr double kLeastTravel_deg = 2, kSlowest_deg_s = 5;
  findings->Warn(std::max(-actuator.min_deg, actuator.max_deg) < kLeastTravel_deg,
                 Say("actuators.%s goes from %g to %g deg; surfaces go farther (radians?)", surface,
                     actuator.min_deg, actuator.max_deg));
  findings->Warn(actuator.rate_limit_deg_per_s < kSlowest_deg_s,
                 Say("actuators.%s.rate_limit_deg_per_s = %g; surfaces are faster (radians?)",
                     surface, actuator.rate_limit_deg_per_s));
}

void CheckActuators(const DerivativeAircraft& a, Findings* findings) {
  CheckActuator("elevator", a.elevator, findings);
  CheckActuator("aileron", a.aileron, findings);
  // One that moves nothing may be as it likes.
  if (a.lateral.Cn_rudder != 0) CheckActuator("rudder", a.rudder, findings);
}

/// No propeller gives more power than it takes.
void CheckEfficiency(double advance_ratio, double efficiency, const char* propeller,
                     Findings* findings) {
  constexpr double kUsual = 0.92;
  const std::string found = Say("%s: at the advance ratio %.3g its efficiency is %.2f", propeller,
                                advance_ratio, efficiency);
  findings->Error(efficiency >= 1, found);
  findings->Warn(efficiency > kUsual && efficiency < 1, found + "; propellers reach 0.9");
}

void CheckPropeller(const PistonEngine& engine, Findings* findings) {
  for (std::size_t i = 0; i < engine.advance_ratio.size(); ++i) {
    const double J = engine.advance_ratio[i];
    double efficiency = 0;
    if (!engine.efficiency.empty()) efficiency = engine.efficiency[i];
    if (!engine.CP.empty() && engine.CP[i] > 0) efficiency = J * engine.CT[i] / engine.CP[i];
    CheckEfficiency(J, efficiency, "propulsion.propeller", findings);
  }
}

/// From standing to where its thrust ends: the first advance ratio at which it gives thrust for no
/// torque, or else the one at which it is best.
void CheckPropeller(const Propeller& propeller, Findings* findings) {
  constexpr double kStep = 0.01, kTwoPi = 6.283185307179586477;
  constexpr int kSteps = 300;
  double best = 0, best_at = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double J = kStep * i;
    const double CT = propeller.CT_0 + J * (propeller.CT_1 + J * propeller.CT_2);
    const double CQ = propeller.CQ_0 + J * (propeller.CQ_1 + J * propeller.CQ_2);
    if (!(CT > 0)) break;
    if (!(CQ > 0)) {
      findings->Error(true, Say("propulsion: at the advance ratio %.3g the propeller gives thrust "
                                "(CT = %.3g) and takes no torque (CQ = %.3g)",
                                J, CT, CQ));
      return;
    }
    const double efficiency = J * CT / (kTwoPi * CQ);
    if (efficiency <= best) continue;
    best = efficiency;
    best_at = J;
  }
  CheckEfficiency(best_at, best, "propulsion, the propeller", findings);
}

std::string Where(const TrimPoint& trim) {
  return Say("at %.0f ft and %.1f m/s", -trim.state[kDown],
             trim.state.segment<3>(kU).norm() * kMetresPerFoot);
}

/// Why there is no level flight at a speed.
std::string WhyNot(const Plant& plant, const TuningLimits& limits, double altitude_ft,
                   double speed_ft_s) {
  const double metric = speed_ft_s * kMetresPerFoot;
  TrimRequest request;
  request.altitude_ft = altitude_ft;
  request.true_airspeed_ft_s = speed_ft_s;
  try {
    const TrimPoint trim = Trim(plant, request);
    const double mach = speed_ft_s / AirAt(plant.atmosphere(), altitude_ft).sound_speed_ft_s;
    const double most = Thrust(plant.aircraft().engine, kMaximumPower, altitude_ft, mach);
    if (speed_ft_s > limits.envelope.max_speed_ft_s) {
      return Say("%.1f m/s is above limits.max_speed_m_s", metric);
    }
    if (mach > plant.aircraft().engine.mach.back()) {
      return Say("%.1f m/s is beyond the tables of thrust, which end at Mach %g", metric,
                 plant.aircraft().engine.mach.back());
    }
    if (trim.controls.thrust_lbf > most) {
      return Say("%.1f m/s needs a thrust of %.4g N and there are %.4g N", metric,
                 trim.controls.thrust_lbf * kNewtonsPerLbf, most * kNewtonsPerLbf);
    }
    return Say("%.1f m/s needs alpha %.1f deg and the elevator at %.1f deg, too near their ends",
               metric, trim.alpha_rad * kDegPerRad, trim.controls.elevator_deg);
  } catch (const Error& error) {
    return error.what();
  }
}

/// How fast a mode may grow, doubling in so many seconds, without trouble for a pilot or a policy
/// (MIL-F-8785C, level 3: a spiral in 4 s, an aperiodic divergence of airspeed in 6 s, an
/// oscillatory phugoid in 55 s).
double LeastTimeToDouble(ModeFamily family) {
  switch (family) {
    case ModeFamily::kPhugoid:
      return 20;
    case ModeFamily::kSpiral:
      return 4;
    default:
      return 5;
  }
}

}  // namespace

std::vector<Finding> CheckAirframe(const Airframe& airframe) {
  Findings findings;
  CheckSizes(SizesOf(airframe), &findings);
  return findings.Take();
}

std::vector<Finding> CheckDerivatives(const DerivativeAircraft& aircraft) {
  Findings findings;
  CheckSizes(SizesOf(aircraft), &findings);
  CheckLongitudinal(aircraft.longitudinal, &findings);
  CheckLateral(aircraft.lateral, &findings);
  CheckPerRadian(aircraft, &findings);
  CheckActuators(aircraft, &findings);
  if (const auto* piston = std::get_if<PistonPropulsion>(&aircraft.propulsion)) {
    CheckPropeller(piston->engine, &findings);
  }
  if (const auto* electric = std::get_if<ElectricPropulsion>(&aircraft.propulsion)) {
    CheckPropeller(electric->propeller, &findings);
  }
  return findings.Take();
}

std::vector<Finding> CheckEnvelope(const Plant& plant, const TuningLimits& limits,
                                   const FlightEnvelope& envelope) {
  constexpr double kUsualSlowest = 1.7;
  Findings findings;
  for (const EnvelopeRow& row : envelope.rows) {
    const bool is_ground = row.altitude_ft == 0;
    if (row.trims.empty()) {
      std::string reasons;
      for (const double factor : {1.3, 1.8, 2.5}) {
        reasons += (reasons.empty() ? "" : "; ") +
                   WhyNot(plant, limits, row.altitude_ft, factor * row.stall_speed_ft_s);
      }
      const std::string text =
          Say("there is no level flight at %.0f ft: ", row.altitude_ft) + reasons;
      findings.Error(is_ground, text);
      findings.Warn(!is_ground, text);
      continue;
    }
    const double slowest = row.trims.front().state.segment<3>(kU).norm();
    findings.Warn(is_ground && slowest > kUsualSlowest * row.stall_speed_ft_s,
                  Say("level flight begins at %.1f m/s, %.1f times the stall speed: ",
                      slowest * kMetresPerFoot, slowest / row.stall_speed_ft_s) +
                      WhyNot(plant, limits, 0, 0.97 * slowest));
  }
  return findings.Take();
}

std::vector<Finding> CheckDrag(const Plant& plant, const FlightEnvelope& envelope,
                               const std::string& cause) {
  double least = 0;
  std::string where;
  for (const TrimPoint& trim : envelope.AllTrims()) {
    const auto coefficients = plant.Evaluate(trim.state, trim.controls).coefficients;
    const double drag =
        -coefficients[0] * std::cos(trim.alpha_rad) - coefficients[2] * std::sin(trim.alpha_rad);
    if (drag >= least) continue;
    least = drag;
    where = Where(trim);
  }
  Findings findings;
  findings.Error(!where.empty(), where + Say(" drag is negative, CD = %.3g", least) + cause);
  return findings.Take();
}

std::vector<Finding> CheckModes(const Plant& plant, const FlightEnvelope& envelope) {
  Findings findings;
  for (const TrimPoint& trim : envelope.AllTrims()) {
    for (const FlightMode& mode :
         FindFlightModes(LineariseFlight(plant, trim, FlapMotion::kFixed))) {
      const double time = mode.time_to_double_s();
      findings.Warn(time < LeastTimeToDouble(mode.family),
                    Say("%s the mode \"%s\" has a time to double of %.1f s without flight control",
                        Where(trim).c_str(), mode.name.c_str(), time));
    }
  }
  return findings.Take();
}

std::vector<Finding> CheckHandling(const TuningLimits& limits, double stall_alpha_deg,
                                   const TrimPoint& trim, const Handling& handling) {
  constexpr double kPoorDamping = 0.25, kFast_s = 4;
  Findings findings;
  const std::string where = Where(trim) + " ";
  const double damping = std::min(handling.pitch_damping, handling.lateral_damping);
  findings.Error(damping < 0, where + "flight control makes the aircraft unstable: damping " +
                                  Say("%.2f", damping));
  findings.Warn(damping >= 0 && damping < kPoorDamping,
                where + Say("the closed loop is poorly damped: %.2f", damping));
  findings.Warn(damping >= 0 && handling.delayed_damping < 0,
                where + "one control step of delay makes the closed loop unstable");
  findings.Error(handling.time_to_double_s < kFast_s,
                 where + Say("the closed loop diverges, with a time to double of %.1f s",
                             handling.time_to_double_s));
  findings.Error(handling.departs, where + "full sticks make it depart");
  findings.Warn(!handling.settles, where + "a push does not settle hands off within 7 s");
  findings.Warn(handling.max_alpha_deg > stall_alpha_deg,
                where + Say("full sticks stall it: alpha %.1f deg, the stall is at %.1f",
                            handling.max_alpha_deg, stall_alpha_deg));
  findings.Warn(handling.max_load_factor_g > limits.max_load_factor_g ||
                    handling.min_load_factor_g < limits.min_load_factor_g,
                where + Say("full sticks go to %.1f and %.1f g, the limits are %.1f and %.1f",
                            handling.max_load_factor_g, handling.min_load_factor_g,
                            limits.max_load_factor_g, limits.min_load_factor_g));
  return findings.Take();
}

}  // namespace skein
