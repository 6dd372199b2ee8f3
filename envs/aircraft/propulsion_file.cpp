// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/propulsion_file.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/units.h"

namespace skein {
namespace {

/// What the kernels hold of altitude times Mach number.
constexpr std::size_t kMaxThrustCells = 32;

/// The straight lines from (0, 0) through the knee to (1, 100).
ThrottleGearing GearingThrough(double knee_throttle, double knee_power) {
  ThrottleGearing gearing;
  gearing.military_throttle = knee_throttle;
  gearing.dry_gain = knee_power / knee_throttle;
  gearing.afterburner_gain = (kMaximumPower - knee_power) / (1 - knee_throttle);
  gearing.afterburner_offset = kMaximumPower - gearing.afterburner_gain;
  return gearing;
}

/// A first-order lag, the same at every power.
PowerLag ConstantLag(double rate_per_s) {
  PowerLag lag;
  lag.rate_offset_per_s = lag.min_rate_per_s = lag.max_rate_per_s = rate_per_s;
  return lag;
}

/// Three rising levels within [0, 1].
template <class Levels>
Levels ReadLevels(Section section) {
  Levels level;
  section.Read("idle", &level.idle);
  section.Read("military", &level.military);
  section.Read("maximum", &level.maximum);
  section.Finish();
  if (!(level.idle >= 0)) section.Refuse("idle", level.idle, "zero or more");
  if (!(level.military > level.idle)) section.Refuse("military", level.military, "above idle");
  if (!(level.maximum > level.military)) {
    section.Refuse("maximum", level.maximum, "above military");
  }
  if (!(level.maximum <= 1)) section.Refuse("maximum", level.maximum, "at most 1");
  return level;
}

/// The key `kind`, one of `choices`.
std::string ReadChoice(const std::vector<std::string>& choices, Section* section) {
  std::string kind = section->ReadText("kind");
  std::string known;
  for (const std::string& choice : choices) {
    if (kind == choice) return kind;
    known += (known.empty() ? "" : ", ") + choice;
  }
  throw Error(section->path() + ".kind must be one of " + known);
}

bool IsFinite(const EngineTables& tables) {
  for (const auto* thrusts : {&tables.idle_lbf, &tables.military_lbf, &tables.maximum_lbf}) {
    if (!std::all_of(thrusts->begin(), thrusts->end(), [](double x) { return std::isfinite(x); })) {
      return false;
    }
  }
  return true;
}

/// The keys `max_altitude_m` and `max_mach`, at which tables of thrust end.
double ReadMaxAltitudeFt(Section* section) {
  constexpr double kHighest_m = 30000;
  double altitude_m = 0;
  section->ReadBetween(0, kHighest_m, "max_altitude_m", &altitude_m);
  return altitude_m * kFeetPerMetre;
}

double ReadMaxMach(Section* section) {
  constexpr double kFastest = 1;
  double mach = 0;
  section->ReadBetween(0, kFastest, "max_mach", &mach);
  return mach;
}

/// Either key may be left out.
PropellerCells ReadCells(Section* section) {
  PropellerCells cells;
  if (section->Has("max_altitude_m")) {
    cells.altitude_ft = (ReadMaxAltitudeFt(section) - PropellerCells::kLowestAltitude_ft) /
                        PropellerCells::kAltitudes;
  }
  if (section->Has("max_mach")) cells.mach = ReadMaxMach(section) / PropellerCells::kMachs;
  return cells;
}

ElectricPropulsion ReadElectric(Section* section) {
  ElectricPropulsion electric;
  Propeller& propeller = electric.propeller;
  section->ReadPositive("diameter_m", &propeller.diameter_m);
  section->Read("CT_0", &propeller.CT_0);
  section->Read("CT_1", &propeller.CT_1);
  section->Read("CT_2", &propeller.CT_2);
  section->ReadPositive("CQ_0", &propeller.CQ_0);
  section->Read("CQ_1", &propeller.CQ_1);
  section->Read("CQ_2", &propeller.CQ_2);
  section->ReadPositive("speed_constant_rpm_per_V", &propeller.speed_constant_rpm_per_V);
  section->ReadPositive("resistance_ohm", &propeller.resistance_ohm);
  section->Read("no_load_current_A", &propeller.no_load_current_A);
  section->ReadPositive("max_voltage_V", &propeller.max_voltage_V);
  electric.levels = ReadLevels<PropellerLevels>(section->Below("motor_throttle"));
  electric.cells = ReadCells(section);
  section->Finish();
  // The motor's speed is the root of a quadratic, which there must be.
  if (!IsFinite(TabulateThrust(electric))) {
    section->Refuse("CQ_2", propeller.CQ_2,
                    "smaller: at no speed would the motor turn the propeller");
  }
  return electric;
}

void ReadEngine(Section section, PistonEngine* engine) {
  section.Know({"rated_power_W", "rated_rpm", "altitude_m", "power_fraction"});
  section.ReadPositive("rated_power_W", &engine->rated_power_W);
  section.ReadPositive("rated_rpm", &engine->rated_rpm);
  if (section.Has("altitude_m") || section.Has("power_fraction")) {
    section.ReadAxis("altitude_m", &engine->altitude_m);
    section.Read("power_fraction", {engine->altitude_m.size()}, &engine->power_fraction);
  }
  for (const double fraction : engine->power_fraction) {
    if (!(fraction >= 0)) section.Refuse("power_fraction", fraction, "zero or more");
  }
  section.Finish();
}

void ReadAdvanceRatios(Section* section, PistonEngine* engine) {
  section->ReadAxis("advance_ratio", &engine->advance_ratio);
  const double first = engine->advance_ratio.front();
  if (first != 0) section->Refuse("advance_ratio", first, "zero at its first node");
}

void ReadPropeller(Section section, PistonEngine* engine) {
  section.Know(
      {"diameter_m", "kind", "advance_ratio", "CT", "CP", "efficiency", "slope", "intercept"});
  section.ReadPositive("diameter_m", &engine->diameter_m);
  const std::string kind = ReadChoice({"fixed_pitch", "constant_speed", "polar"}, &section);
  if (kind == "polar") {
    engine->propeller = PropellerModel::kPolar;
    section.ReadPositive("slope", &engine->polar_slope);
    section.Read("intercept", &engine->polar_intercept);
    section.Finish();
    return;
  }
  ReadAdvanceRatios(&section, engine);
  const std::size_t nodes = engine->advance_ratio.size();
  if (kind == "constant_speed") {
    engine->propeller = PropellerModel::kConstantSpeed;
    section.Read("efficiency", {nodes}, &engine->efficiency);
    const double standing = engine->efficiency.front();
    if (standing != 0) section.Refuse("efficiency", standing, "zero where the advance ratio is");
  } else {
    section.Read("CT", {nodes}, &engine->CT);
    section.Read("CP", {nodes}, &engine->CP);
    const double standing = engine->CP.front();
    if (!(standing > 0)) {
      section.Refuse("CP", standing, "above 0 where the advance ratio is zero");
    }
  }
  section.Finish();
}

PistonPropulsion ReadPiston(Section* section) {
  PistonPropulsion piston;
  ReadEngine(section->Below("engine"), &piston.engine);
  ReadPropeller(section->Below("propeller"), &piston.engine);
  piston.levels = ReadLevels<ThrottleLevels>(section->Below("engine_throttle"));
  piston.range = {ReadMaxAltitudeFt(section), ReadMaxMach(section)};
  section->Finish();
  if (!IsFinite(TabulateThrust(piston))) {
    throw Error(section->path() + " gives thrust that is not finite");
  }
  return piston;
}

/// An axis of one width of cells, as the kernels look it up.
std::vector<double> ReadUniformAxis(const char* key, Section* section) {
  constexpr double kRounding = 1e-9;
  std::vector<double> axis;
  section->ReadAxis(key, &axis);
  const double width = (axis.back() - axis.front()) / static_cast<double>(axis.size() - 1);
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const double uniform = axis.front() + width * static_cast<double>(i);
    if (!(std::abs(axis[i] - uniform) <= kRounding * (axis.back() - axis.front()))) {
      section->Refuse(key, axis[i], "at equal distances, here " + std::to_string(uniform));
    }
  }
  return axis;
}

EngineTables ReadJet(Section* section) {
  EngineTables tables;
  const std::vector<double> altitude_m = ReadUniformAxis("altitude_m", section);
  for (const double altitude : altitude_m) tables.altitude_ft.push_back(altitude * kFeetPerMetre);
  tables.mach = ReadUniformAxis("mach", section);
  const std::size_t rows = altitude_m.size(), columns = tables.mach.size();
  if ((rows - 1) * (columns - 1) > kMaxThrustCells) {
    throw Error(section->path() + ": altitude_m and mach make " +
                std::to_string((rows - 1) * (columns - 1)) + " cells; the kernels hold " +
                std::to_string(kMaxThrustCells));
  }
  const auto read = [&](const char* key, std::vector<double>* table) {
    section->Read(key, {rows, columns}, table);
    for (double& thrust : *table) thrust /= kNewtonsPerLbf;
  };
  read("idle_N", &tables.idle_lbf);
  read("maximum_N", &tables.maximum_lbf);
  if (section->Has("military_N")) {
    read("military_N", &tables.military_lbf);
    return tables;
  }
  for (std::size_t i = 0; i < rows * columns; ++i) {
    tables.military_lbf.push_back((tables.idle_lbf[i] + tables.maximum_lbf[i]) / 2);
  }
  return tables;
}

/// The key `kind`, after which it is known which keys there may be.
std::string ReadKind(Section* section) {
  std::string kind =
      section->Has("kind") ? ReadChoice({"electric", "piston", "jet"}, section) : "electric";
  section->Know({"throttle_gearing", "power_rate_per_s", "untrimmed_thrust_N"});
  if (kind == "piston") {
    section->Know({"engine", "propeller", "engine_throttle", "max_altitude_m", "max_mach"});
  } else if (kind == "jet") {
    section->Know({"altitude_m", "mach", "idle_N", "maximum_N", "military_N"});
  } else {
    section->Know({"diameter_m", "CT_0", "CT_1", "CT_2", "CQ_0", "CQ_1", "CQ_2",
                   "speed_constant_rpm_per_V", "resistance_ohm", "no_load_current_A",
                   "max_voltage_V", "motor_throttle", "max_altitude_m", "max_mach"});
  }
  return kind;
}

Propulsion ReadKeysOf(const std::string& kind, Section* section) {
  if (kind == "piston") return ReadPiston(section);
  if (kind == "jet") return ReadJet(section);
  return ReadElectric(section);
}

}  // namespace

void ReadPropulsion(Section section, DerivativeAircraft* aircraft) {
  const std::string kind = ReadKind(&section);
  Section gearing = section.Below("throttle_gearing");
  double knee_throttle = 0, knee_power = 0;
  gearing.ReadBetween(0, 1, "knee_throttle", &knee_throttle);
  gearing.ReadBetween(0, kMaximumPower, "knee_power", &knee_power);
  gearing.Finish();
  aircraft->throttle_gearing = GearingThrough(knee_throttle, knee_power);

  double rate_per_s = 0;
  section.ReadPositive("power_rate_per_s", &rate_per_s);
  aircraft->power_lag = ConstantLag(rate_per_s);
  section.Read("untrimmed_thrust_N", &aircraft->untrimmed_thrust_N);
  // At last: what it reads is looked at as a whole.
  aircraft->propulsion = ReadKeysOf(kind, &section);
  section.Finish();
}

}  // namespace skein
