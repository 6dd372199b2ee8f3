// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/derivative_aircraft_file.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "envs/aircraft/aircraft_json.h"
#include "envs/aircraft/aircraft_sections.h"
#include "envs/aircraft/flight_control_file.h"
#include "envs/aircraft/propulsion_file.h"

namespace skein {
namespace {

using nlohmann::json;

/// The sharpest stall whose blend, exponentials of it times angles up to 2.5 rad, stays finite.
constexpr double kSharpestStall = 250;
constexpr double kQuarterTurn_rad = 1.5707963267948966;

void ReadAirframe(Section section, DerivativeAircraft* aircraft) {
  section.ReadPositive("mass_kg", &aircraft->mass_kg);
  section.ReadPositive("Ixx_kg_m2", &aircraft->Ixx_kg_m2);
  section.ReadPositive("Iyy_kg_m2", &aircraft->Iyy_kg_m2);
  section.ReadPositive("Izz_kg_m2", &aircraft->Izz_kg_m2);
  section.Read("Ixz_kg_m2", &aircraft->Ixz_kg_m2);
  section.ReadPositive("wing_area_m2", &aircraft->wing_area_m2);
  section.ReadPositive("span_m", &aircraft->span_m);
  section.ReadPositive("chord_m", &aircraft->chord_m);
  section.ReadFraction("cg_chord_fraction", &aircraft->cg_chord_fraction);
  section.Finish();
  if (aircraft->Ixz_kg_m2 * aircraft->Ixz_kg_m2 >= aircraft->Ixx_kg_m2 * aircraft->Izz_kg_m2) {
    section.Refuse("Ixz_kg_m2", aircraft->Ixz_kg_m2,
                   "smaller: its square below the product of Ixx_kg_m2 and Izz_kg_m2");
  }
}

void ReadLongitudinal(Section section, LongitudinalDerivatives* k) {
  section.Read("CL_0", &k->CL_0);
  section.Read("CL_alpha", &k->CL_alpha);
  section.Read("CL_q", &k->CL_q);
  section.Read("CL_elevator", &k->CL_elevator);
  section.Read("CD_parasitic", &k->CD_parasitic);
  section.Read("CD_q", &k->CD_q);
  section.Read("CD_elevator", &k->CD_elevator);
  section.Read("Cm_0", &k->Cm_0);
  section.Read("Cm_alpha", &k->Cm_alpha);
  section.Read("Cm_q", &k->Cm_q);
  section.Read("Cm_elevator", &k->Cm_elevator);
  section.ReadPositive("oswald_efficiency", &k->oswald_efficiency);
  section.ReadBetween(0, kQuarterTurn_rad, "stall_alpha_rad", &k->stall_alpha_rad);
  section.ReadBetween(0, kSharpestStall, "stall_sharpness", &k->stall_sharpness);
  section.Finish();
}

void ReadLateral(Section section, LateralDerivatives* k) {
  section.Read("CY_beta", &k->CY_beta);
  section.Read("CY_p", &k->CY_p);
  section.Read("CY_r", &k->CY_r);
  section.Read("CY_aileron", &k->CY_aileron);
  section.Read("CY_rudder", &k->CY_rudder);
  section.Read("Cl_beta", &k->Cl_beta);
  section.Read("Cl_p", &k->Cl_p);
  section.Read("Cl_r", &k->Cl_r);
  section.Read("Cl_aileron", &k->Cl_aileron);
  section.Read("Cl_rudder", &k->Cl_rudder);
  section.Read("Cn_beta", &k->Cn_beta);
  section.Read("Cn_p", &k->Cn_p);
  section.Read("Cn_r", &k->Cn_r);
  section.Read("Cn_aileron", &k->Cn_aileron);
  section.Read("Cn_rudder", &k->Cn_rudder);
  section.Finish();
}

void ReadLimits(Section section, FlightLimits* limits) {
  const double infinity = std::numeric_limits<double>::infinity();
  section.ReadBetween(1, infinity, "max_load_factor_g", &limits->max_load_factor_g);
  section.ReadBetween(-infinity, 1, "min_load_factor_g", &limits->min_load_factor_g);
  section.ReadPositive("max_speed_m_s", &limits->max_speed_m_s);
  section.ReadPositive("max_altitude_m", &limits->max_altitude_m);
  section.Finish();
}

}  // namespace

DerivativeAircraft ReadDerivativeAircraft(const std::string& name, std::string_view text,
                                          FlightControlSection flight_control) {
  const std::string where = "aircraft " + name;
  const json file = ParseAircraftJson(text, where);
  Section section(file, where);
  for (const char* key : kNotOfTheModel) section.Skip(key);
  section.Expect({"airframe", "longitudinal", "lateral", "propulsion", "actuators", "limits",
                  "flight_control", "observation_units"});
  DerivativeAircraft aircraft;
  aircraft.name = name;
  ReadAirframe(section.Below("airframe"), &aircraft);
  ReadLongitudinal(section.Below("longitudinal"), &aircraft.longitudinal);
  ReadLateral(section.Below("lateral"), &aircraft.lateral);
  ReadPropulsion(section.Below("propulsion"), &aircraft);
  Section actuators = section.Below("actuators");
  actuators.Read("elevator", &aircraft.elevator);
  actuators.Read("aileron", &aircraft.aileron);
  actuators.Read("rudder", &aircraft.rudder);
  actuators.Finish();
  if (section.Has("limits")) ReadLimits(section.Below("limits"), &aircraft.limits);
  aircraft.has_flight_control = section.Has("flight_control");
  if (!aircraft.has_flight_control && flight_control == FlightControlSection::kRequired) {
    throw Error(where + " lacks flight_control; `skein aircraft tune FILE -o FILE` derives it");
  }
  if (aircraft.has_flight_control) {
    ReadFlightControl(section.Below("flight_control"), &aircraft.flight_control);
  }
  aircraft.units = ReadUnits(section.Below("observation_units"));
  section.Finish();
  return aircraft;
}

}  // namespace skein
