#include "envs/aircraft/derivative_aircraft_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simd/error.h"

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

}  // namespace
}  // namespace skein
