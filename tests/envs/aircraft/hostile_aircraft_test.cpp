// SPDX-License-Identifier: Apache-2.0
// Damaged files: whatever is done to those that come with Skein, they are an aircraft or an Error.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "base/error.h"
#include "envs/aircraft/aircraft_document.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/reference/plant.h"
#include "tests/damage.h"

namespace skein {
namespace {

/// Whether the text is an aircraft. One that is can be put into kernels, or they refuse it, and the
/// equations of motion take it without harm.
bool IsAircraft(const std::string& text) {
  Aircraft aircraft;
  try {
    aircraft = MakeAircraft(ReadAircraftDocument("damaged", text, "damaged"));
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), 500u);
    return false;
  }
  try {
    MakeKernelAircraft(aircraft, AtmosphereModel::kStandard1976);
  } catch (const Error&) {
    return false;
  }
  RigidBodyState state = RigidBodyState::Zero();
  state[kU] = 300;
  state[kW] = 20;
  state[kQ0] = 1;
  Controls controls;
  controls.elevator_deg = -3;
  Plant(aircraft, AtmosphereModel::kStandard1976).Evaluate(state, controls);
  return true;
}

TEST(HostileAircraft, DamagedFilesAreAircraftOrErrors) {
  for (const AircraftFile& file : AircraftFiles()) {
    const std::string text(*file.text);
    // The F-16's tables are long; most of what can go wrong is in the other sections.
    const int variants = text.size() > 50000 ? 600 : 3000;
    int aircraft = 0;
    for (int seed = 0; seed < variants; ++seed) {
      SCOPED_TRACE(std::string(file.name) + ", seed " + std::to_string(seed));
      aircraft += IsAircraft(Damage(static_cast<std::uint32_t>(seed)).Of(text)) ? 1 : 0;
    }
    // Neither all of them nor none: both ways are walked.
    EXPECT_GT(aircraft, variants / 50) << file.name;
    EXPECT_LT(aircraft, variants * 9 / 10) << file.name;
  }
}

}  // namespace
}  // namespace skein
