// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/table_aircraft.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "envs/aircraft/f16.h"
#include "envs/aircraft/registry.h"
#include "envs/reference/aerodynamics.h"
#include "tests/error_message.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using nlohmann::json;

json F16File() { return json::parse(AircraftText("f16")); }

std::string ErrorAfter(const std::function<void(json*)>& change) {
  json file = F16File();
  change(&file);
  return MessageOf([&] { ReadTableAircraft("mine", file.dump()); });
}

TEST(TableAircraft, ErrorsNameTheField) {
  EXPECT_EQ(ErrorAfter([](json*) {}), "");
  const auto at = [](const char* pointer, const json& value) {
    return ErrorAfter([&](json* file) { (*file)[json::json_pointer(pointer)] = value; });
  };
  EXPECT_EQ(at("/aerodynamics/axes/beta_deg", {-30, 0, 0, 30}),
            "aircraft mine.aerodynamics.axes.beta_deg[2] is 0, but must be above the number before "
            "it, 0");
  EXPECT_EQ(at("/aerodynamics/axes/beta_deg", {0}),
            "aircraft mine.aerodynamics.axes.beta_deg must be a list of 2 to 64 numbers");
  EXPECT_EQ(at("/aerodynamics/axes/alpha_deg", json::array_t(65, 1)),
            "aircraft mine.aerodynamics.axes.alpha_deg must be a list of 2 to 64 numbers");
  EXPECT_EQ(at("/aerodynamics/tables/Cx/values/3", {1, 2}),
            "aircraft mine.aerodynamics.tables.Cx.values[3] must be a list of 19 lists, not of 2");
  EXPECT_EQ(at("/aerodynamics/tables/Cx/values/3/4/1", "x"),
            "aircraft mine.aerodynamics.tables.Cx.values[3][4][1] must be a number");
  EXPECT_EQ(
      at("/aerodynamics/tables/eta_el/values", json::array_t(4, 1)),
      "aircraft mine.aerodynamics.tables.eta_el.values must be a list of 5 numbers, not of 4");
  EXPECT_EQ(at("/aerodynamics/tables/Cyp/axes", {"beta_deg"}),
            "aircraft mine.aerodynamics.tables.Cyp.axes must be some of alpha_deg, in this order");
  for (const json& other : {json(), json::object(), json("alpha_deg"), json{1}}) {
    EXPECT_EQ(at("/aerodynamics/tables/Cyp/axes", other),
              "aircraft mine.aerodynamics.tables.Cyp.axes must be a list of texts");
  }
  EXPECT_EQ(at("/aerodynamics/tables/Clq", json::object()),
            "aircraft mine.aerodynamics.tables has the unknown key Clq");
  EXPECT_EQ(at("/engine/idle_lbf/0/0", 1e300),
            "aircraft mine.engine.idle_lbf[0][0] is 1e+300, but must be zero or between 1e-12 and "
            "1e+12 in magnitude");
  EXPECT_EQ(
      at("/engine/throttle_gearing/afterburner_offset", 500),
      "aircraft mine.engine.throttle_gearing.afterburner_offset is 500, but must be such that both "
      "stages give the same power at military_throttle");
  EXPECT_EQ(ErrorAfter([](json* file) {
              json& gearing = file->at("engine").at("throttle_gearing");
              gearing["afterburner_gain"] = 300;
              gearing["afterburner_offset"] = -181;
            }),
            "aircraft mine.engine.throttle_gearing.afterburner_gain is 300, but must be such that "
            "full throttle gives a power of 100 at most");
  EXPECT_EQ(at("/airframe/mass_slug", 0),
            "aircraft mine.airframe.mass_slug is 0, but must be above 0");
  EXPECT_EQ(at("/airframe/cg_chord_fraction", 30),
            "aircraft mine.airframe.cg_chord_fraction is 30, but must be above 0 and at most 1");
  EXPECT_EQ(at("/flight_control/yaw_lead", {1, 2, -3}),
            "aircraft mine.flight_control.yaw_lead is -3, but must be above 0 in a0: the filter "
            "never comes to rest");
  EXPECT_EQ(at("/flight_control/pitch_rate_washout", {1, 0, 0}),
            "aircraft mine.flight_control.pitch_rate_washout is 0, but must be above 0 in a0: the "
            "filter never comes to rest");
  EXPECT_EQ(ErrorAfter([](json* file) { file->at("aerodynamics").at("tables").erase("Cmq"); }),
            "aircraft mine.aerodynamics.tables lacks Cmq");
  EXPECT_EQ(ErrorAfter([](json* file) {
              json& gearing = file->at("engine").at("throttle_gearing");
              gearing.erase("dry_gain");
              gearing["dry_gian"] = 64.94;
            }),
            "aircraft mine.engine.throttle_gearing has the unknown key dry_gian; did you mean "
            "dry_gain?");
  const auto renamed = [](const char* section, const char* from, const char* to) {
    return ErrorAfter([&](json* file) {
      json& values = file->at(section);
      values[to] = values.at(from);
      values.erase(from);
    });
  };
  EXPECT_EQ(renamed("engine", "power_lag", "power_lags"),
            "aircraft mine.engine has the unknown key power_lags; did you mean power_lag?");
  EXPECT_EQ(renamed("aerodynamics", "tables", "table"),
            "aircraft mine.aerodynamics has the unknown key table; did you mean tables?");
  EXPECT_EQ(ErrorAfter([](json* file) {
              file->at("airframe").erase("wing_area_ft2");
              file->at("airframe")["wing_area_m2"] = 27.87;
            }),
            "aircraft mine.airframe lacks wing_area_ft2 (it has wing_area_m2: another unit)");
}

TEST(TableAircraft, ATableOnFewerAxesIsConstantAlongTheOthers) {
  json file = F16File();
  json& tables = file["aerodynamics"]["tables"];
  const std::size_t alphas = file["aerodynamics"]["axes"]["alpha_deg"].size();
  json by_alpha = json::array();
  for (std::size_t i = 0; i < alphas; ++i) by_alpha.push_back(static_cast<double>(i));
  tables["Cx"] = {{"axes", {"alpha_deg"}}, {"values", by_alpha}};
  tables["Cz"] = {{"axes", {"elevator_deg"}}, {"values", {1, 2, 3, 4, 5}}};
  tables["Cy"] = {{"axes", json::array()}, {"values", 0.5}};
  const AerodynamicTables t = ReadTableAircraft("mine", file.dump()).aerodynamics;
  const std::size_t betas = t.beta_deg.size(), elevators = t.elevator_deg.size();
  ASSERT_EQ(t.Cx.size(), alphas * betas * elevators);
  for (std::size_t i = 0; i < t.Cx.size(); ++i) {
    EXPECT_EQ(t.Cx[i], static_cast<double>(i / (betas * elevators)));
    EXPECT_EQ(t.Cz[i], static_cast<double>(i % elevators + 1));
  }
  EXPECT_EQ(t.Cy, std::vector<double>(alphas * betas, 0.5));
}

/// The F-16 without its leading-edge flap and what may be left out.
json WithoutFlap() {
  json file = F16File();
  file["airframe"].erase("leading_edge_flap_reference_deg");
  file["actuators"].erase("leading_edge_flap");
  file["aerodynamics"]["axes"].erase("alpha_lef_deg");
  json& gains = file["flight_control"];
  for (const char* key :
       {"flap_filter", "flap_alpha_gain", "flap_pressure_gain_deg", "flap_bias_deg"}) {
    gains.erase(key);
  }
  json& tables = file["aerodynamics"]["tables"];
  const json all = tables;
  for (const auto& entry : all.items()) {
    if (entry.key().find("_lef") != std::string::npos) tables.erase(entry.key());
  }
  for (const char* key : {"dCn_beta", "dCl_beta", "dCm", "eta_el"}) tables.erase(key);
  file.erase("drag_rise");
  file["engine"].erase("growth");
  file["engine"]["power_lag"].erase("afterburner");
  return file;
}

TEST(TableAircraft, AFlapThatIsNotThereChangesNothing) {
  const Aircraft aircraft = ReadTableAircraft("mine", WithoutFlap().dump());
  EXPECT_TRUE(aircraft.drag_rise.mach.empty());
  EXPECT_TRUE(std::isinf(aircraft.power_lag.afterburner_power));
  constexpr Tolerance kRounding{1e-14, "increments of the flap are sums of what cancels"};
  for (const double alpha_deg : {-17.0, 3.0, 22.5, 71.0}) {
    AerodynamicCondition in{alpha_deg, 4.5, -7, 5, 0, 0, 0.01, 0.002, 0.01};
    AerodynamicCondition out = in;
    out.leading_edge_flap_deg = 1;
    const AerodynamicCoefficients difference =
        EvaluateAerodynamics(aircraft, in) - EvaluateAerodynamics(aircraft, out);
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), kRounding) << alpha_deg;
  }
}

}  // namespace
}  // namespace skein
