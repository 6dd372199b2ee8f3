// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/f16.h"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/f16_units.h"

namespace skein {
namespace data {
extern const std::string_view f16_aerodynamics;
extern const std::string_view f16_engine;
}  // namespace data

namespace {

using nlohmann::json;

/// Mass and inertia: University of Minnesota nonlinear F-16 model (Russell, 2003), as is the
/// division of aileron increments by the full 21.5 deg, although the tables were measured at 20
/// deg.
Airframe F16Airframe() {
  Airframe airframe;
  airframe.mass_slug = 636.94;
  airframe.wing_area_ft2 = 300;
  airframe.span_ft = 30;
  airframe.chord_ft = 11.32;
  airframe.cg_reference = 0.35;
  airframe.cg = 0.30;
  airframe.Ixx = 9496;
  airframe.Iyy = 55814;
  airframe.Izz = 63100;
  airframe.Ixz = 982;
  airframe.aileron_reference_deg = 21.5;
  airframe.rudder_reference_deg = 30;
  airframe.leading_edge_flap_reference_deg = 25;
  return airframe;
}

/// Bandwidth [1/s], rate limit [deg/s] and position limits [deg]: NASA TP-1538 and the University
/// of Minnesota model, which agree.
Actuators F16Actuators() {
  Actuators actuators;
  actuators.elevator = {20.2, 60, -25, 25};
  actuators.aileron = {20.2, 80, -21.5, 21.5};
  actuators.rudder = {20.2, 120, -30, 30};
  actuators.leading_edge_flap = {7.25, 25, 0, 25};
  return actuators;
}

/// Stevens and Lewis, Aircraft Control and Simulation (after NASA TP-1538), like the tables of
/// thrust. Military power is at a throttle of 0.77, the afterburner above.
ThrottleGearing F16ThrottleGearing() {
  ThrottleGearing gearing;
  gearing.military_throttle = 0.77;
  gearing.dry_gain = 64.94;
  gearing.afterburner_gain = 217.38;
  gearing.afterburner_offset = -117.38;
  return gearing;
}

PowerLag F16PowerLag() {
  PowerLag lag;
  lag.max_rate_per_s = 1;
  lag.min_rate_per_s = 0.1;
  lag.rate_offset_per_s = 1.9;
  lag.rate_slope_per_s = 0.036;
  lag.afterburner_power = 50;
  lag.light_up_power = 60;
  lag.blow_out_power = 40;
  lag.afterburner_rate_per_s = 5;
  return lag;
}

ReferenceUnits F16Units() {
  ReferenceUnits units;
  units.altitude_error_ft = kAltitudeErrorUnitFt;
  units.altitude_ft = kAltitudeUnitFt;
  units.speed_ft_s = kSpeedUnitFtS;
  return units;
}

void Flatten(const json& values, std::vector<double>* flat) {
  if (values.is_array()) {
    for (const json& value : values) Flatten(value, flat);
  } else {
    flat->push_back(values.get<double>());
  }
}

/// Reads the tables of data/f16/aerodynamics.json and checks each against its axes.
class TableReader {
 public:
  explicit TableReader(const json& file) : file_(file) {}

  std::vector<double> Axis(const char* name) const {
    return file_.at("axes").at(name).get<std::vector<double>>();
  }

  std::vector<double> Table(const char* name) const {
    const json& table = file_.at("tables").at(name);
    std::size_t size = 1;
    for (const json& axis : table.at("axes")) {
      size *= file_.at("axes").at(axis.get<std::string>()).size();
    }
    std::vector<double> flat;
    flat.reserve(size);
    Flatten(table.at("values"), &flat);
    if (flat.size() != size) {
      throw Error(std::string("F-16 table ") + name + " has " + std::to_string(flat.size()) +
                  " values where its axes ask for " + std::to_string(size));
    }
    return flat;
  }

 private:
  const json& file_;
};

AerodynamicTables F16Aerodynamics() {
  const json file = json::parse(data::f16_aerodynamics);
  const TableReader reader(file);
  AerodynamicTables t;
  t.alpha_deg = reader.Axis("alpha_deg");
  t.alpha_lef_deg = reader.Axis("alpha_lef_deg");
  t.beta_deg = reader.Axis("beta_deg");
  t.elevator_deg = reader.Axis("elevator_deg");
  t.elevator_coarse_deg = reader.Axis("elevator_coarse_deg");

  const struct {
    const char* name;
    std::vector<double> AerodynamicTables::*table;
  } tables[] = {
      {"Cx", &AerodynamicTables::Cx},
      {"Cz", &AerodynamicTables::Cz},
      {"Cm", &AerodynamicTables::Cm},
      {"Cn", &AerodynamicTables::Cn},
      {"Cl", &AerodynamicTables::Cl},
      {"Cy", &AerodynamicTables::Cy},
      {"Cy_r30", &AerodynamicTables::Cy_r30},
      {"Cn_r30", &AerodynamicTables::Cn_r30},
      {"Cl_r30", &AerodynamicTables::Cl_r30},
      {"Cy_a20", &AerodynamicTables::Cy_a20},
      {"Cn_a20", &AerodynamicTables::Cn_a20},
      {"Cl_a20", &AerodynamicTables::Cl_a20},
      {"Cx_lef", &AerodynamicTables::Cx_lef},
      {"Cz_lef", &AerodynamicTables::Cz_lef},
      {"Cm_lef", &AerodynamicTables::Cm_lef},
      {"Cy_lef", &AerodynamicTables::Cy_lef},
      {"Cn_lef", &AerodynamicTables::Cn_lef},
      {"Cl_lef", &AerodynamicTables::Cl_lef},
      {"Cy_a20_lef", &AerodynamicTables::Cy_a20_lef},
      {"Cn_a20_lef", &AerodynamicTables::Cn_a20_lef},
      {"Cl_a20_lef", &AerodynamicTables::Cl_a20_lef},
      {"Cxq", &AerodynamicTables::Cxq},
      {"Czq", &AerodynamicTables::Czq},
      {"Cmq", &AerodynamicTables::Cmq},
      {"Cyp", &AerodynamicTables::Cyp},
      {"Cyr", &AerodynamicTables::Cyr},
      {"Cnr", &AerodynamicTables::Cnr},
      {"Cnp", &AerodynamicTables::Cnp},
      {"Clp", &AerodynamicTables::Clp},
      {"Clr", &AerodynamicTables::Clr},
      {"dCxq_lef", &AerodynamicTables::dCxq_lef},
      {"dCzq_lef", &AerodynamicTables::dCzq_lef},
      {"dCmq_lef", &AerodynamicTables::dCmq_lef},
      {"dCyp_lef", &AerodynamicTables::dCyp_lef},
      {"dCyr_lef", &AerodynamicTables::dCyr_lef},
      {"dCnr_lef", &AerodynamicTables::dCnr_lef},
      {"dCnp_lef", &AerodynamicTables::dCnp_lef},
      {"dClp_lef", &AerodynamicTables::dClp_lef},
      {"dClr_lef", &AerodynamicTables::dClr_lef},
      {"dCn_beta", &AerodynamicTables::dCn_beta},
      {"dCl_beta", &AerodynamicTables::dCl_beta},
      {"dCm", &AerodynamicTables::dCm},
      {"eta_el", &AerodynamicTables::eta_el},
  };
  for (const auto& entry : tables) t.*entry.table = reader.Table(entry.name);
  return t;
}

EngineTables F16Engine() {
  const json file = json::parse(data::f16_engine);
  EngineTables t;
  t.altitude_ft = file.at("altitude_ft").get<std::vector<double>>();
  t.mach = file.at("mach").get<std::vector<double>>();
  Flatten(file.at("idle_lbf"), &t.idle_lbf);
  Flatten(file.at("military_lbf"), &t.military_lbf);
  Flatten(file.at("maximum_lbf"), &t.maximum_lbf);
  const std::size_t size = t.altitude_ft.size() * t.mach.size();
  if (t.idle_lbf.size() != size || t.military_lbf.size() != size || t.maximum_lbf.size() != size) {
    throw Error("F-16 thrust tables do not have " + std::to_string(size) +
                " values each, as their axes ask for");
  }
  return t;
}

/// JSBSim's F-16: thrust of its F100-PW-229 at sea level over that at Mach 1.
MachFunction F16ThrustGrowth() { return {{1, 1.2, 1.4, 1.6, 2}, {1, 1.069, 1.154, 1.259, 1.49}}; }

/// JSBSim's F-16: the increment of drag by the Mach number (CDmach).
MachFunction F16DragRise() { return {{0.81, 1.1, 1.8}, {0, 0.023, 0.015}}; }

}  // namespace

Aircraft F16() {
  Aircraft aircraft;
  aircraft.name = "f16";
  aircraft.airframe = F16Airframe();
  aircraft.actuators = F16Actuators();
  aircraft.throttle_gearing = F16ThrottleGearing();
  aircraft.power_lag = F16PowerLag();
  aircraft.units = F16Units();
  aircraft.untrimmed_thrust_lbf = 2000;  // the NeuralPlane paper's start
  try {
    aircraft.aerodynamics = F16Aerodynamics();
    aircraft.engine = F16Engine();
    aircraft.engine.growth = F16ThrustGrowth();
    aircraft.drag_rise = F16DragRise();
  } catch (const json::exception& error) {
    throw Error(std::string("the embedded F-16 data cannot be read: ") + error.what());
  }
  return aircraft;
}

}  // namespace skein
