// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/derivative_aircraft_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

std::string Aerosonde() { return std::string(*AircraftFiles()[0].text); }

/// The aerosonde's file with its first `from` changed to `to`.
std::string Changed(const std::string& from, const std::string& to) {
  std::string text = Aerosonde();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string ErrorOf(const std::string& text) {
  try {
    ReadDerivativeAircraft("glider", text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DerivativeAircraftFile, HoldsWhatTheBookPrints) {
  ASSERT_STREQ(AircraftFiles()[0].name, "aerosonde");
  const DerivativeAircraft aircraft = ReadDerivativeAircraft("aerosonde", Aerosonde());
  EXPECT_EQ(aircraft.name, "aerosonde");
  EXPECT_EQ(aircraft.mass_kg, 11);
  EXPECT_EQ(aircraft.Ixz_kg_m2, 0.1204);
  EXPECT_EQ(aircraft.longitudinal.Cm_alpha, -2.74);
  EXPECT_EQ(aircraft.lateral.Cn_rudder, -0.069);
  EXPECT_EQ(std::get<ElectricPropulsion>(aircraft.propulsion).propeller.max_voltage_V, 44.4);
  EXPECT_EQ(aircraft.flight_control.pedal_fade.x_high, 25);
}

TEST(DerivativeAircraftFile, ErrorsNameTheAircraftAndTheKey) {
  EXPECT_EQ(ErrorOf(Aerosonde()), "");
  EXPECT_THAT(ErrorOf("{"), HasSubstr("aircraft glider: its data cannot be read"));
  EXPECT_EQ(ErrorOf("{}"), "aircraft glider lacks airframe");
  EXPECT_EQ(ErrorOf("{\"airframe\": 3}"),
            "aircraft glider.airframe must be an object of named values");
  EXPECT_EQ(ErrorOf(Changed("\"Cm_q\"", "\"CM_q\": 0, \"Cm_q\"")),
            "aircraft glider.longitudinal has the unknown key CM_q");
  EXPECT_EQ(ErrorOf(Changed("-38.21", "\"-38.21\"")),
            "aircraft glider.longitudinal.Cm_q must be a number");
  EXPECT_EQ(
      ErrorOf(Changed("[0, 10, 10]", "[0, 10]")),
      "aircraft glider.flight_control.alpha_filter must be a list of 3 numbers: b1, b0, a0 of "
      "(b1 s + b0) / (s + a0)");
  EXPECT_EQ(ErrorOf(Changed("\"min_deg\": -25.0", "\"min_deg\": 0")),
            "aircraft glider.actuators.elevator must have min_deg below zero and max_deg above");
}

// What is missing is mostly there, misspelt.
TEST(DerivativeAircraftFile, AnUnknownKeyIsNamedBeforeWhatIsMissing) {
  const auto renamed = [](const std::string& from, const std::string& to) {
    return ErrorOf(Changed("\"" + from + "\":", "\"" + to + "\":"));
  };
  EXPECT_EQ(renamed("CL_alpha", "CL_alfa"),
            "aircraft glider.longitudinal has the unknown key CL_alfa; did you mean CL_alpha?");
  EXPECT_EQ(renamed("Cm_q", "Cmq"),
            "aircraft glider.longitudinal has the unknown key Cmq; did you mean Cm_q?");
  EXPECT_EQ(renamed("lateral", "latteral"),
            "aircraft glider has the unknown key latteral; did you mean lateral?");
  EXPECT_EQ(renamed("pedal_fade", "pedals_fade"),
            "aircraft glider.flight_control has the unknown key pedals_fade; did you mean "
            "pedal_fade?");
  EXPECT_EQ(renamed("resistance_ohm", "resistence_ohm"),
            "aircraft glider.propulsion has the unknown key resistence_ohm; did you mean "
            "resistance_ohm?");
  EXPECT_EQ(renamed("motor_throttle", "motor_trottle"),
            "aircraft glider.propulsion has the unknown key motor_trottle; did you mean "
            "motor_throttle?");
  EXPECT_EQ(renamed("throttle_gearing", "throttle_gear"),
            "aircraft glider.propulsion has the unknown key throttle_gear; did you mean "
            "throttle_gearing?");
  EXPECT_EQ(renamed("motor_throttle", "levels"),
            "aircraft glider.propulsion has the unknown key levels, and lacks motor_throttle");
  EXPECT_EQ(renamed("rudder", "ruder"),
            "aircraft glider.actuators has the unknown key ruder; did you mean rudder?");
  EXPECT_EQ(renamed("mass_kg", "weight"),
            "aircraft glider.airframe has the unknown key weight, and lacks mass_kg");
  EXPECT_EQ(renamed("mass_kg", "mass_slug"),
            "aircraft glider.airframe lacks mass_kg (it has mass_slug: another unit)");
  EXPECT_EQ(ErrorOf(Changed("\"Cm_q\": -38.21,", "")), "aircraft glider.longitudinal lacks Cm_q");
}

std::string WithoutFlightControl() {
  nlohmann::json file = nlohmann::json::parse(Aerosonde());
  file.erase("flight_control");
  return file.dump();
}

TEST(DerivativeAircraftFile, AFileWithoutGainsIsReadWhereTheyAreDerived) {
  const std::string text = WithoutFlightControl();
  EXPECT_EQ(ErrorOf(text),
            "aircraft glider lacks flight_control; `skein aircraft tune FILE -o FILE` derives it");
  EXPECT_FALSE(
      ReadDerivativeAircraft("glider", text, FlightControlSection::kOptional).has_flight_control);
}

/// The aerosonde's file with another value of `key`.
std::string With(const std::string& key, const std::string& value) {
  std::string text = Aerosonde();
  const std::string name = "\"" + key + "\": ";
  const std::size_t begin = text.find(name) + name.size();
  EXPECT_GE(begin, name.size()) << key;
  const std::size_t end =
      text[begin] == '[' ? text.find(']', begin) + 1 : text.find_first_of(",}\n", begin);
  return text.replace(begin, end - begin, value);
}

TEST(DerivativeAircraftFile, WhatCannotBeFlownWithIsRefused) {
  const std::pair<const char*, std::vector<const char*>> refused[] = {
      {"mass_kg", {"0", "-1"}},
      {"Iyy_kg_m2", {"0"}},
      {"Ixz_kg_m2", {"1.21", "-1.21"}},
      {"wing_area_m2", {"0"}},
      {"span_m", {"0"}},
      {"chord_m", {"0", "-0.1"}},
      {"cg_chord_fraction", {"0", "-0.1", "1.01", "30"}},
      {"oswald_efficiency", {"0"}},
      {"stall_alpha_rad", {"0", "2"}},
      {"stall_sharpness", {"0", "1000"}},
      {"CQ_0", {"0", "-0.005"}},
      {"CQ_2", {"3"}},
      {"speed_constant_rpm_per_V", {"0"}},
      {"resistance_ohm", {"0"}},
      {"idle", {"-0.1", "0.72", "0.8"}},
      {"military", {"0.3", "0.2", "1", "1.5"}},
      {"maximum", {"0.72", "0.5", "1.1"}},
      {"knee_throttle", {"0", "1", "-0.1", "1.1"}},
      {"knee_power", {"0", "100", "-1", "101"}},
      {"power_rate_per_s", {"0"}},
      {"bandwidth_per_s", {"0"}},
      {"pitch_gain_pressure_psf", {"0"}},
      {"pedal_fade", {"[15, 1, 15, 0]", "[25, 1, 15, 0]"}},
      {"speed_m_s", {"0"}},
  };
  for (const auto& [key, values] : refused) {
    for (const char* value : values) {
      const std::string error = ErrorOf(With(key, value));
      EXPECT_THAT(error, HasSubstr("aircraft glider.")) << key << " " << value;
      EXPECT_THAT(error, HasSubstr(", but must be ")) << key << " " << value;
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
  }
  EXPECT_EQ(ErrorOf(With("knee_throttle", "1")),
            "aircraft glider.propulsion.throttle_gearing.knee_throttle is 1, but must be above 0 "
            "and below 1");
  EXPECT_EQ(ErrorOf(With("mass_kg", "0")),
            "aircraft glider.airframe.mass_kg is 0, but must be above 0");
}

/// The aerosonde's file with another section `propulsion`, but for what every kind has.
std::string WithPropulsion(const std::string& propulsion) {
  std::string text = Aerosonde();
  const std::size_t begin = text.find("\"propulsion\": {") + 14;
  const std::size_t end = text.find("\"actuators\"", begin);
  return text.replace(begin, end - begin,
                      "{" + propulsion +
                          ", \"throttle_gearing\": {\"knee_throttle\": 0.5, \"knee_power\": 50}, "
                          "\"power_rate_per_s\": 1, \"untrimmed_thrust_N\": 9}, ");
}

std::string Piston(const std::string& propeller) {
  return WithPropulsion(
      "\"kind\": \"piston\", \"max_altitude_m\": 4000, \"max_mach\": 0.2, "
      "\"engine\": {\"rated_power_W\": 1e5, \"rated_rpm\": 2700}, "
      "\"engine_throttle\": {\"idle\": 0.1, \"military\": 0.5, \"maximum\": 1}, \"propeller\": {" +
      propeller + "}");
}

/// The thrust of the aerosonde's motor with `keys` beside its own.
EngineTables ElectricTables(const std::string& keys) {
  return MakeAircraft(
             ReadDerivativeAircraft("glider", Changed("\"diameter_m\"", keys + "\"diameter_m\"")))
      .engine;
}

TEST(DerivativeAircraftFile, ThrustOfElectricMotorsEndsWhereTheFileSays) {
  constexpr Tolerance kRounding{1e-9, "float64 rounding of 20,000 ft"};
  const EngineTables shipped = ElectricTables("");
  EXPECT_EQ(shipped.altitude_ft, (std::vector<double>{-2000, 3000, 8000, 13000}));
  ASSERT_EQ(shipped.mach.size(), 11u);
  for (std::size_t j = 0; j < shipped.mach.size(); ++j) {
    EXPECT_EQ(shipped.mach[j], 0.014 * static_cast<double>(j)) << "not a bit may differ";
  }
  const EngineTables fast = ElectricTables(R"("max_mach": 0.3, )");
  EXPECT_EQ(fast.altitude_ft, shipped.altitude_ft);
  EXPECT_NEAR(fast.mach.back(), 0.3, kRounding);
  EXPECT_EQ(fast.mach.size(), shipped.mach.size());
  EXPECT_EQ(Thrust(shipped, 100, 0, 0.3), Thrust(shipped, 100, 0, 0.14)) << "held beyond its end";
  EXPECT_LT(Thrust(fast, 100, 0, 0.3), Thrust(shipped, 100, 0, 0.14)) << "less in faster air";
  const EngineTables high = ElectricTables(R"("max_altitude_m": 6096, )");
  EXPECT_EQ(high.mach, shipped.mach);
  EXPECT_EQ(high.altitude_ft.front(), -2000);
  EXPECT_NEAR(high.altitude_ft.back(), 20000, 20000 * kRounding);
  for (const char* key : {"max_mach", "max_altitude_m"}) {
    for (const char* value : {"0", "-1", "1e6"}) {
      const std::string text = "\"" + std::string(key) + "\": " + value + ", \"diameter_m\"";
      EXPECT_THAT(ErrorOf(Changed("\"diameter_m\"", text)),
                  HasSubstr(std::string("aircraft glider.propulsion.") + key + " is "))
          << value;
    }
  }
}

TEST(DerivativeAircraftFile, PistonEnginesComeWithAnyPropeller) {
  const std::string fixed =
      R"("kind": "fixed_pitch", "diameter_m": 2, "advance_ratio": [0, 1], "CT": [0.1, 0], "CP": [0.06, 0])";
  const std::string governed =
      R"("kind": "constant_speed", "diameter_m": 2, "advance_ratio": [0, 1], "efficiency": [0, 0.8])";
  const std::string polar = R"("kind": "polar", "diameter_m": 2, "slope": 1.7, "intercept": -0.05)";
  for (const std::string& propeller : {fixed, governed, polar}) {
    const DerivativeAircraft aircraft = ReadDerivativeAircraft("glider", Piston(propeller));
    EXPECT_EQ(std::get<PistonPropulsion>(aircraft.propulsion).engine.diameter_m, 2);
    for (const double thrust : MakeAircraft(aircraft).engine.maximum_lbf) {
      EXPECT_TRUE(std::isfinite(thrust));
    }
  }
  const std::pair<std::string, std::string> refused[] = {
      {R"("diameter_m": 2, "knd": "polar")",
       "propulsion.propeller has the unknown key knd; did you mean kind?"},
      {R"("kind": "fixed_pitch", "diameter_m": 2, "advance_ratios": [0, 1])",
       "propulsion.propeller has the unknown key advance_ratios; did you mean advance_ratio?"},
      {R"("kind": "fixed_pitch", "diameter_m": 2, "advance_ratio": [0, 1], "CP": [1, 1])",
       "propulsion.propeller lacks CT"},
      {R"("kind": "folding", "diameter_m": 2)",
       "propulsion.propeller.kind must be one of fixed_pitch, constant_speed, polar"},
      {R"("diameter_m": 2)", "propulsion.propeller lacks kind"},
      {R"("kind": "fixed_pitch", "diameter_m": 2, "advance_ratio": [0, 0])",
       "propulsion.propeller.advance_ratio[1] is 0, but must be above the number before it, 0"},
      {R"("kind": "fixed_pitch", "diameter_m": 2, "advance_ratio": [0.1, 1])",
       "propulsion.propeller.advance_ratio is 0.1, but must be zero at its first node"},
      {R"("kind": "fixed_pitch", "diameter_m": 2, "advance_ratio": [0, 1], "CT": [1], "CP": [1, 1])",
       "propulsion.propeller.CT must be a list of 2 numbers, not of 1"},
      {R"("kind": "fixed_pitch", "diameter_m": 2, "advance_ratio": [0, 1], "CT": [1, 1], "CP": [0, 1])",
       "propulsion.propeller.CP is 0, but must be above 0 where the advance ratio is zero"},
  };
  for (const auto& [propeller, error] : refused) {
    EXPECT_EQ(ErrorOf(Piston(propeller)), "aircraft glider." + error);
  }
}

TEST(DerivativeAircraftFile, JetsComeAsTables) {
  const std::string axes = R"("kind": "jet", "altitude_m": [0, 5000, 10000], "mach": [0, 0.5], )";
  const std::string idle = R"("idle_N": [[0, 100], [0, 50], [0, 25]], )";
  const std::string maximum = R"("maximum_N": [[900, 800], [600, 500], [300, 200]])";
  const Aircraft jet =
      MakeAircraft(ReadDerivativeAircraft("glider", WithPropulsion(axes + idle + maximum)));
  constexpr Tolerance kRounding{1e-9, "float64 rounding of 900"};
  EXPECT_NEAR(Thrust(jet.engine, 100, 0, 0) * 4.4482216152605, 900, kRounding);
  EXPECT_NEAR(Thrust(jet.engine, 50, 0, 0.5) * 4.4482216152605, 450, kRounding);
  EXPECT_EQ(ErrorOf(WithPropulsion(axes + idle + R"("maximum_N": [[900, 800]])")),
            "aircraft glider.propulsion.maximum_N must be a list of 3 lists, not of 1");
  EXPECT_EQ(ErrorOf(WithPropulsion(R"("kind": "jet", "altitude_m": [0, 5, 9], "mach": [0, 1])")),
            "aircraft glider.propulsion.altitude_m is 5, but must be at equal distances, here "
            "4.500000");
  EXPECT_THAT(
      ErrorOf(WithPropulsion(
          R"("kind": "jet", "altitude_m": [0, 1, 2, 3, 4, 5, 6, 7, 8], "mach": [0, 1, 2, 3, 4, 5])")),
      HasSubstr("make 40 cells; the kernels hold 32"));
  EXPECT_EQ(ErrorOf(WithPropulsion(R"("kind": "rocket")")),
            "aircraft glider.propulsion.kind must be one of electric, piston, jet");
  EXPECT_EQ(ErrorOf(WithPropulsion(R"("kind": 3)")),
            "aircraft glider.propulsion.kind must be a text");
}

// Whatever single value of a file is replaced, it is read, or one line says what is wrong.
TEST(DerivativeAircraftFile, NoReplacedValueIsSwallowed) {
  const std::string fixed =
      R"("kind": "fixed_pitch", "diameter_m": 2, "advance_ratio": [0, 1], "CT": [0.1, 0], "CP": [0.06, 0])";
  const nlohmann::json files[] = {nlohmann::json::parse(Aerosonde()),
                                  nlohmann::json::parse(Piston(fixed))};
  for (const nlohmann::json& file : files) {
    const nlohmann::json flat = file.flatten();
    for (const auto& [place, value] : flat.items()) {
      for (const nlohmann::json& wrong :
           {nlohmann::json(nullptr), nlohmann::json("x"), nlohmann::json::array(),
            nlohmann::json::object(), nlohmann::json(1e308), nlohmann::json(-1e308)}) {
        nlohmann::json changed = file;
        changed[nlohmann::json::json_pointer(place)] = wrong;
        const std::string error = ErrorOf(changed.dump());
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        EXPECT_FALSE(value.is_number() && !wrong.is_number() && error.empty()) << place;
      }
    }
  }
}

TEST(DerivativeAircraftFile, WhatIsReadIsFinite) {
  constexpr Tolerance kRounding{1e-9, "float64 rounding of 100"};
  // At and near the ends of what is read.
  const std::pair<const char*, const char*> read[] = {
      {"stall_sharpness", "249"}, {"stall_alpha_rad", "1.57"}, {"idle", "0"},
      {"knee_throttle", "1e-3"},  {"knee_power", "99.9"},      {"mass_kg", "0.01"},
  };
  for (const auto& [key, value] : read) {
    const Aircraft aircraft = MakeAircraft(ReadDerivativeAircraft("glider", With(key, value)));
    for (const auto* table : {&aircraft.aerodynamics.Cx, &aircraft.aerodynamics.Cz,
                              &aircraft.engine.idle_lbf, &aircraft.engine.maximum_lbf}) {
      for (const double entry : *table) ASSERT_TRUE(std::isfinite(entry)) << key;
    }
    EXPECT_NEAR(
        aircraft.throttle_gearing.afterburner_gain + aircraft.throttle_gearing.afterburner_offset,
        100, kRounding)
        << key;
  }
}

}  // namespace
}  // namespace skein
