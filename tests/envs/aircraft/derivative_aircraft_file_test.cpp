// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/derivative_aircraft_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/error.h"
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
  EXPECT_EQ(aircraft.propeller.max_voltage_V, 44.4);
  EXPECT_EQ(aircraft.flight_control.pedal_fade.x_high, 25);
}

TEST(DerivativeAircraftFile, ErrorsNameTheAircraftAndTheKey) {
  EXPECT_EQ(ErrorOf(Aerosonde()), "");
  EXPECT_THAT(ErrorOf("{"), HasSubstr("aircraft glider: its data cannot be read"));
  EXPECT_EQ(ErrorOf("{}"), "aircraft glider lacks airframe");
  EXPECT_EQ(ErrorOf("{\"airframe\": 3}"),
            "aircraft glider.airframe must be an object of named values");
  EXPECT_EQ(ErrorOf(Changed("\"Cm_q\"", "\"Cmq\"")), "aircraft glider.longitudinal lacks Cm_q");
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
