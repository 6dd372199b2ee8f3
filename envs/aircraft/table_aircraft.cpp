// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/table_aircraft.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "envs/aircraft/aircraft_json.h"
#include "envs/aircraft/aircraft_sections.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/flight_control_file.h"
#include "envs/aircraft/table_lookup.h"

namespace skein {
namespace {

using nlohmann::json;
using Values = std::vector<double>;
using Table = Values AerodynamicTables::*;

/// Axes that a table may have, in their order.
enum class Axes {
  kAlphaBetaElevator,
  kAlphaBetaCoarse,
  kAlphaBeta,
  kFlapBeta,
  kAlpha,
  kFlap,
  kElevator
};

/// A table of the file.
struct Entry {
  const char* name;
  Table table;
  Axes axes;
};

constexpr Entry kTables[] = {
    {"Cx", &AerodynamicTables::Cx, Axes::kAlphaBetaElevator},
    {"Cz", &AerodynamicTables::Cz, Axes::kAlphaBetaElevator},
    {"Cm", &AerodynamicTables::Cm, Axes::kAlphaBetaElevator},
    {"Cn", &AerodynamicTables::Cn, Axes::kAlphaBetaCoarse},
    {"Cl", &AerodynamicTables::Cl, Axes::kAlphaBetaCoarse},
    {"Cy", &AerodynamicTables::Cy, Axes::kAlphaBeta},
    {"Cy_r30", &AerodynamicTables::Cy_r30, Axes::kAlphaBeta},
    {"Cn_r30", &AerodynamicTables::Cn_r30, Axes::kAlphaBeta},
    {"Cl_r30", &AerodynamicTables::Cl_r30, Axes::kAlphaBeta},
    {"Cy_a20", &AerodynamicTables::Cy_a20, Axes::kAlphaBeta},
    {"Cn_a20", &AerodynamicTables::Cn_a20, Axes::kAlphaBeta},
    {"Cl_a20", &AerodynamicTables::Cl_a20, Axes::kAlphaBeta},
    {"Cxq", &AerodynamicTables::Cxq, Axes::kAlpha},
    {"Czq", &AerodynamicTables::Czq, Axes::kAlpha},
    {"Cmq", &AerodynamicTables::Cmq, Axes::kAlpha},
    {"Cyp", &AerodynamicTables::Cyp, Axes::kAlpha},
    {"Cyr", &AerodynamicTables::Cyr, Axes::kAlpha},
    {"Cnr", &AerodynamicTables::Cnr, Axes::kAlpha},
    {"Cnp", &AerodynamicTables::Cnp, Axes::kAlpha},
    {"Clp", &AerodynamicTables::Clp, Axes::kAlpha},
    {"Clr", &AerodynamicTables::Clr, Axes::kAlpha},
};

/// With the leading-edge flap at zero, or increments from its reference to that.
constexpr Entry kFlapTables[] = {
    {"Cx_lef", &AerodynamicTables::Cx_lef, Axes::kFlapBeta},
    {"Cz_lef", &AerodynamicTables::Cz_lef, Axes::kFlapBeta},
    {"Cm_lef", &AerodynamicTables::Cm_lef, Axes::kFlapBeta},
    {"Cy_lef", &AerodynamicTables::Cy_lef, Axes::kFlapBeta},
    {"Cn_lef", &AerodynamicTables::Cn_lef, Axes::kFlapBeta},
    {"Cl_lef", &AerodynamicTables::Cl_lef, Axes::kFlapBeta},
    {"Cy_a20_lef", &AerodynamicTables::Cy_a20_lef, Axes::kFlapBeta},
    {"Cn_a20_lef", &AerodynamicTables::Cn_a20_lef, Axes::kFlapBeta},
    {"Cl_a20_lef", &AerodynamicTables::Cl_a20_lef, Axes::kFlapBeta},
    {"dCxq_lef", &AerodynamicTables::dCxq_lef, Axes::kFlap},
    {"dCzq_lef", &AerodynamicTables::dCzq_lef, Axes::kFlap},
    {"dCmq_lef", &AerodynamicTables::dCmq_lef, Axes::kFlap},
    {"dCyp_lef", &AerodynamicTables::dCyp_lef, Axes::kFlap},
    {"dCyr_lef", &AerodynamicTables::dCyr_lef, Axes::kFlap},
    {"dCnr_lef", &AerodynamicTables::dCnr_lef, Axes::kFlap},
    {"dCnp_lef", &AerodynamicTables::dCnp_lef, Axes::kFlap},
    {"dClp_lef", &AerodynamicTables::dClp_lef, Axes::kFlap},
    {"dClr_lef", &AerodynamicTables::dClr_lef, Axes::kFlap},
};

/// Corrections that a file may leave out, and what they are then.
constexpr struct {
  Entry entry;
  double otherwise;
} kCorrections[] = {
    {{"dCn_beta", &AerodynamicTables::dCn_beta, Axes::kAlpha}, 0},
    {{"dCl_beta", &AerodynamicTables::dCl_beta, Axes::kAlpha}, 0},
    {{"dCm", &AerodynamicTables::dCm, Axes::kAlpha}, 0},
    {{"eta_el", &AerodynamicTables::eta_el, Axes::kElevator}, 1},
};

struct NamedAxis {
  const char* name;
  std::size_t size;
};

/// The section "aerodynamics".
class AerodynamicsReader {
 public:
  AerodynamicsReader(Section section, bool has_flap, AerodynamicTables* tables)
      : section_(std::move(section)), has_flap_(has_flap), t_(*tables) {}

  void Read() {
    section_.Know({"axes", "tables"});
    ReadAxes(section_.Below("axes"));
    Section tables = section_.Below("tables");
    for (const Entry& entry : kTables) ReadTable(tables, entry);
    for (const auto& [entry, otherwise] : kCorrections) {
      if (tables.Has(entry.name)) {
        ReadTable(tables, entry);
      } else {
        (t_.*entry.table).assign(SizeOf(AxesOf(entry.axes)), otherwise);
      }
    }
    if (has_flap_) {
      for (const Entry& entry : kFlapTables) ReadTable(tables, entry);
    } else {
      FillWithoutFlap();
    }
    tables.Finish();
    section_.Finish();
  }

 private:
  void ReadAxes(Section axes) {
    axes.ReadAxis("alpha_deg", &t_.alpha_deg);
    axes.ReadAxis("beta_deg", &t_.beta_deg);
    axes.ReadAxis("elevator_deg", &t_.elevator_deg);
    t_.elevator_coarse_deg = t_.elevator_deg;
    t_.alpha_lef_deg = t_.alpha_deg;
    if (axes.Has(kCoarse)) {
      axes.ReadAxis(kCoarse, &t_.elevator_coarse_deg);
      coarse_ = kCoarse;
    }
    if (has_flap_ && axes.Has(kFlapAlpha)) {
      axes.ReadAxis(kFlapAlpha, &t_.alpha_lef_deg);
      flap_alpha_ = kFlapAlpha;
    }
    axes.Finish();
  }

  std::vector<NamedAxis> AxesOf(Axes axes) const {
    const NamedAxis alpha{"alpha_deg", t_.alpha_deg.size()}, beta{"beta_deg", t_.beta_deg.size()};
    const NamedAxis elevator{"elevator_deg", t_.elevator_deg.size()};
    const NamedAxis flap{flap_alpha_, t_.alpha_lef_deg.size()};
    switch (axes) {
      case Axes::kAlphaBetaElevator:
        return {alpha, beta, elevator};
      case Axes::kAlphaBetaCoarse:
        return {alpha, beta, {coarse_, t_.elevator_coarse_deg.size()}};
      case Axes::kAlphaBeta:
        return {alpha, beta};
      case Axes::kFlapBeta:
        return {flap, beta};
      case Axes::kAlpha:
        return {alpha};
      case Axes::kFlap:
        return {flap};
      case Axes::kElevator:
        return {elevator};
    }
    return {};
  }

  static std::size_t SizeOf(const std::vector<NamedAxis>& axes) {
    std::size_t size = 1;
    for (const NamedAxis& axis : axes) size *= axis.size;
    return size;
  }

  /// Which of `axes` the table has, which must be in their order.
  static std::vector<bool> AxesGiven(Section& table, const std::vector<NamedAxis>& axes) {
    std::string known;
    for (const NamedAxis& axis : axes)
      known += (known.empty() ? "" : ", ") + std::string(axis.name);
    std::vector<bool> given(axes.size(), false);
    std::size_t next = 0;
    for (const std::string& name : table.ReadTexts("axes")) {
      while (next < axes.size() && name != axes[next].name) ++next;
      if (next == axes.size()) {
        throw Error(table.path() + ".axes must be some of " + known + ", in this order");
      }
      given[next++] = true;
    }
    return given;
  }

  void ReadTable(Section& tables, const Entry& entry) {
    const std::vector<NamedAxis> axes = AxesOf(entry.axes);
    Section table = tables.Below(entry.name);
    const std::vector<bool> given = AxesGiven(table, axes);
    std::vector<std::size_t> shape;
    for (std::size_t i = 0; i < axes.size(); ++i) {
      if (given[i]) shape.push_back(axes[i].size);
    }
    Values values;
    table.Read("values", shape, &values);
    table.Finish();
    t_.*entry.table = Expand(values, axes, given);
  }

  /// Row-major values on all axes from those on the axes that are given.
  static Values Expand(const Values& values, const std::vector<NamedAxis>& axes,
                       const std::vector<bool>& given) {
    Values all(SizeOf(axes));
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::size_t rest = i, from = 0, stride = 1;
      for (std::size_t axis = axes.size(); axis-- > 0;) {
        if (given[axis]) {
          from += rest % axes[axis].size * stride;
          stride *= axes[axis].size;
        }
        rest /= axes[axis].size;
      }
      all[i] = values[from];
    }
    return all;
  }

  /// The rows of `table`, which ends in an elevator axis, at an elevator of zero.
  static Values AtNoElevator(const Values& table, const Values& elevator_deg) {
    const GridCell zero = Locate(elevator_deg, 0);
    Values rows;
    for (std::size_t i = 0; i < table.size(); i += elevator_deg.size()) {
      rows.push_back(Interpolate(table.data() + i, zero, 1));
    }
    return rows;
  }

  /// A flap that changes nothing.
  void FillWithoutFlap() {
    t_.Cx_lef = AtNoElevator(t_.Cx, t_.elevator_deg);
    t_.Cz_lef = AtNoElevator(t_.Cz, t_.elevator_deg);
    t_.Cm_lef = AtNoElevator(t_.Cm, t_.elevator_deg);
    t_.Cn_lef = AtNoElevator(t_.Cn, t_.elevator_coarse_deg);
    t_.Cl_lef = AtNoElevator(t_.Cl, t_.elevator_coarse_deg);
    t_.Cy_lef = t_.Cy;
    t_.Cy_a20_lef = t_.Cy_a20;
    t_.Cn_a20_lef = t_.Cn_a20;
    t_.Cl_a20_lef = t_.Cl_a20;
    for (const Entry& entry : kFlapTables) {
      if (entry.axes == Axes::kFlap) (t_.*entry.table).assign(t_.alpha_deg.size(), 0);
    }
  }

  static constexpr const char* kCoarse = "elevator_coarse_deg";
  static constexpr const char* kFlapAlpha = "alpha_lef_deg";

  Section section_;
  bool has_flap_;
  AerodynamicTables& t_;
  const char* coarse_ = "elevator_deg";
  const char* flap_alpha_ = "alpha_deg";
};

void ReadAirframe(Section section, bool has_flap, Airframe* airframe) {
  section.ReadPositive("mass_slug", &airframe->mass_slug);
  section.ReadPositive("wing_area_ft2", &airframe->wing_area_ft2);
  section.ReadPositive("span_ft", &airframe->span_ft);
  section.ReadPositive("chord_ft", &airframe->chord_ft);
  section.Read("cg_reference_chord_fraction", &airframe->cg_reference);
  section.ReadFraction("cg_chord_fraction", &airframe->cg);
  section.ReadPositive("Ixx_slug_ft2", &airframe->Ixx);
  section.ReadPositive("Iyy_slug_ft2", &airframe->Iyy);
  section.ReadPositive("Izz_slug_ft2", &airframe->Izz);
  section.Read("Ixz_slug_ft2", &airframe->Ixz);
  section.ReadPositive("aileron_reference_deg", &airframe->aileron_reference_deg);
  section.ReadPositive("rudder_reference_deg", &airframe->rudder_reference_deg);
  if (has_flap) {
    section.ReadPositive("leading_edge_flap_reference_deg",
                         &airframe->leading_edge_flap_reference_deg);
  }
  section.Finish();
  if (airframe->Ixz * airframe->Ixz >= airframe->Ixx * airframe->Izz) {
    section.Refuse("Ixz_slug_ft2", airframe->Ixz,
                   "smaller: its square below the product of Ixx_slug_ft2 and Izz_slug_ft2");
  }
}

/// {"mach": [...], KEY: [...]}
MachFunction ReadMachFunction(Section section, const char* key) {
  MachFunction function;
  section.ReadAxis("mach", &function.mach);
  section.Read(key, {function.mach.size()}, &function.value);
  section.Finish();
  return function;
}

void ReadGearing(Section section, ThrottleGearing* gearing) {
  section.ReadBetween(0, 1, "military_throttle", &gearing->military_throttle);
  section.ReadPositive("dry_gain", &gearing->dry_gain);
  section.ReadPositive("afterburner_gain", &gearing->afterburner_gain);
  section.Read("afterburner_offset", &gearing->afterburner_offset);
  section.Finish();
  constexpr double kRounding = 0.1;  // the F-16's stages meet within 0.0012, as published
  const double dry = PowerCommand(*gearing, gearing->military_throttle);
  const double lit =
      gearing->afterburner_gain * gearing->military_throttle + gearing->afterburner_offset;
  if (!(std::abs(lit - dry) <= kRounding)) {
    section.Refuse("afterburner_offset", gearing->afterburner_offset,
                   "such that both stages give the same power at military_throttle");
  }
  if (!(PowerCommand(*gearing, 1) <= kMaximumPower + kRounding)) {
    section.Refuse("afterburner_gain", gearing->afterburner_gain,
                   "such that full throttle gives a power of 100 at most");
  }
}

void ReadPowerLag(Section section, PowerLag* lag) {
  section.ReadPositive("max_rate_per_s", &lag->max_rate_per_s);
  section.ReadPositive("min_rate_per_s", &lag->min_rate_per_s);
  section.Read("rate_offset_per_s", &lag->rate_offset_per_s);
  section.Read("rate_slope_per_s", &lag->rate_slope_per_s);
  if (section.Has("afterburner")) {
    Section second = section.Below("afterburner");
    second.ReadPositive("power", &lag->afterburner_power);
    second.ReadPositive("light_up_power", &lag->light_up_power);
    second.ReadPositive("blow_out_power", &lag->blow_out_power);
    second.ReadPositive("rate_per_s", &lag->afterburner_rate_per_s);
    second.Finish();
  }
  section.Finish();
  if (!(lag->min_rate_per_s <= lag->max_rate_per_s)) {
    section.Refuse("min_rate_per_s", lag->min_rate_per_s, "at most max_rate_per_s");
  }
}

void ReadEngine(Section section, Aircraft* aircraft) {
  section.Know({"altitude_ft", "mach", "idle_lbf", "military_lbf", "maximum_lbf", "growth",
                "throttle_gearing", "power_lag", "untrimmed_thrust_lbf"});
  EngineTables& tables = aircraft->engine;
  section.ReadAxis("altitude_ft", &tables.altitude_ft);
  section.ReadAxis("mach", &tables.mach);
  const std::vector<std::size_t> shape = {tables.altitude_ft.size(), tables.mach.size()};
  section.Read("idle_lbf", shape, &tables.idle_lbf);
  section.Read("military_lbf", shape, &tables.military_lbf);
  section.Read("maximum_lbf", shape, &tables.maximum_lbf);
  if (section.Has("growth")) tables.growth = ReadMachFunction(section.Below("growth"), "factor");
  ReadGearing(section.Below("throttle_gearing"), &aircraft->throttle_gearing);
  ReadPowerLag(section.Below("power_lag"), &aircraft->power_lag);
  section.Read("untrimmed_thrust_lbf", &aircraft->untrimmed_thrust_lbf);
  section.Finish();
}

/// Unlike the other surfaces a flap may move to one side only.
void ReadFlapActuator(Section section, Actuator* flap) {
  section.ReadPositive("bandwidth_per_s", &flap->bandwidth_per_s);
  section.ReadPositive("rate_limit_deg_per_s", &flap->rate_limit_deg_per_s);
  section.Read("min_deg", &flap->min_deg);
  section.ReadPositive("max_deg", &flap->max_deg);
  section.Finish();
  if (!(flap->min_deg <= 0)) section.Refuse("min_deg", flap->min_deg, "zero or less");
}

constexpr const char* kFlap = "leading_edge_flap";

void ReadActuators(Section section, bool has_flap, Actuators* actuators) {
  section.Read("elevator", &actuators->elevator);
  section.Read("aileron", &actuators->aileron);
  section.Read("rudder", &actuators->rudder);
  if (has_flap) ReadFlapActuator(section.Below(kFlap), &actuators->leading_edge_flap);
  section.Finish();
}

}  // namespace

Aircraft ReadTableAircraft(const std::string& name, std::string_view text) {
  const std::string where = "aircraft " + name;
  const json file = ParseAircraftJson(text, where);
  Section section(file, where);
  for (const char* key : kNotOfTheModel) section.Skip(key);
  section.Expect({"airframe", "aerodynamics", "drag_rise", "engine", "actuators", "flight_control",
                  "observation_units"});
  Aircraft aircraft;
  aircraft.name = name;
  const bool has_flap = section.Below("actuators").Has(kFlap);
  ReadAirframe(section.Below("airframe"), has_flap, &aircraft.airframe);
  AerodynamicsReader(section.Below("aerodynamics"), has_flap, &aircraft.aerodynamics).Read();
  if (section.Has("drag_rise")) {
    aircraft.drag_rise = ReadMachFunction(section.Below("drag_rise"), "CD");
  }
  ReadEngine(section.Below("engine"), &aircraft);
  ReadActuators(section.Below("actuators"), has_flap, &aircraft.actuators);
  if (has_flap) {
    ReadFlightControlWithFlap(section.Below("flight_control"), &aircraft.flight_control);
  } else {
    ReadFlightControl(section.Below("flight_control"), &aircraft.flight_control);
    LeaveOutFlap(&aircraft);
  }
  aircraft.units = ReadUnits(section.Below("observation_units"));
  section.Finish();
  return aircraft;
}

}  // namespace skein
