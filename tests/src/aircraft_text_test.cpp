// SPDX-License-Identifier: Apache-2.0
#include "src/aircraft/aircraft_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/aircraft/registry.h"
#include "tests/error_message.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

class TunedText : public testing::Test {
 protected:
  const AircraftDocument document_ =
      ReadAircraftDocument("mine", AircraftText(std::string("aerosonde")), "here");
  FlightControlGains gains_ = LoadAircraft("aerosonde").flight_control;
};

TEST_F(TunedText, HoldsTheGains) {
  gains_.roll_rate_gain_s = 0.123;
  const DerivativeAircraft read = ReadDerivativeAircraft("mine", TextWithGains(document_, gains_));
  EXPECT_EQ(read.flight_control.roll_rate_gain_s, 0.123);
  EXPECT_EQ(read.mass_kg, 11);
}

TEST_F(TunedText, IsNoneOfWhatCannotBeRead) {
  gains_.pitch_rate_gain_g_s_per_deg = 1.34e-13;
  EXPECT_THAT(MessageOf([&] { TextWithGains(document_, gains_); }),
              HasSubstr("the gains found are none of an aircraft: aircraft mine.flight_control."
                        "pitch_rate_gain_g_s_per_deg is 1.34e-13"));
  gains_.pitch_rate_gain_g_s_per_deg = 0;
  gains_.pedal_fade = {20, 1, 20, 0};
  EXPECT_THAT(MessageOf([&] { TextWithGains(document_, gains_); }), HasSubstr("pedal_fade"));
}

}  // namespace
}  // namespace skein
