// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/linear_modes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/envs/f16_at.h"

namespace skein {
namespace {

/// At 15,000 ft and 600 ft/s.
std::vector<FlightMode> ModesInTurn(double turn_rate_deg_s) {
  const Plant plant = F16At(0.3);
  TrimRequest request;
  request.altitude_ft = 15000;
  request.true_airspeed_ft_s = 600;
  request.turn_rate_rad_s = turn_rate_deg_s / kDegPerRad;
  return FindFlightModes(LineariseFlight(plant, Trim(plant, request), FlapMotion::kFixed));
}

std::vector<std::string> NamesOf(const std::vector<FlightMode>& modes) {
  std::vector<std::string> names;
  for (const FlightMode& mode : modes) names.push_back(mode.name);
  return names;
}

TEST(FlightModes, AreTheFiveOfAConventionalAirframe) {
  EXPECT_EQ(NamesOf(ModesInTurn(0)),
            (std::vector<std::string>{"short period", "phugoid", "Dutch roll", "roll", "spiral"}));
}

// In a turn the bank joins the phugoid, and of the real lateral modes the fast one alone is left.
TEST(FlightModes, ARollModeThatIsAloneIsNoSpiral) {
  const FlightMode alone = ModesInTurn(8).back();
  EXPECT_GT(alone.shares[kRollRate], alone.shares[kBankAngle]);
  EXPECT_LT(alone.time_constant_s(), 1);
  EXPECT_EQ(alone.name, "roll");
  EXPECT_EQ(alone.family, ModeFamily::kRoll);
}

}  // namespace
}  // namespace skein
