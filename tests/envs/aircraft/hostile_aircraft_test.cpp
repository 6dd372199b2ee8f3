// SPDX-License-Identifier: Apache-2.0
// Damaged files: whatever is done to those that come with Skein, they are an aircraft or an Error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>

#include "base/error.h"
#include "envs/aircraft/aircraft_document.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/reference/plant.h"

namespace skein {
namespace {

using Random = std::mt19937;

std::size_t Below(Random& random, std::size_t size) {
  return random() % std::max<std::size_t>(size, 1);
}

void Truncate(Random& random, std::string* text) { text->resize(Below(random, text->size())); }

void FlipBit(Random& random, std::string* text) {
  char& byte = (*text)[Below(random, text->size())];
  byte = static_cast<char>(byte ^ (1 << random() % 8));
}

void Remove(Random& random, std::string* text) {
  text->erase(Below(random, text->size()), 1 + random() % 40);
}

void Repeat(Random& random, std::string* text) {
  const std::string part = text->substr(Below(random, text->size()), 1 + random() % 200);
  text->insert(Below(random, text->size()), part);
}

/// Puts something that a reader may stumble over in place of a number.
void ReplaceNumber(Random& random, std::string* text) {
  static const char* const kValues[] = {"0",
                                        "-1",
                                        "1e-13",
                                        "1e13",
                                        "1e400",
                                        "-0.0",
                                        "null",
                                        "[]",
                                        "{}",
                                        "\"x\"",
                                        "true",
                                        "1e12",
                                        "-1e12",
                                        "1e-12",
                                        "[1,2]",
                                        "NaN",
                                        "99999999999999999999"};
  const std::size_t from = text->find_first_of("0123456789-", Below(random, text->size()));
  if (from == std::string::npos) return;
  std::size_t to = text->find_first_not_of("0123456789.-+eE", from);
  if (to == std::string::npos) to = text->size();
  text->replace(from, to - from, kValues[random() % std::size(kValues)]);
}

std::string Damaged(std::string text, std::uint32_t seed) {
  constexpr void (*kDamages[])(Random&, std::string*) = {Truncate, FlipBit,       Remove,
                                                         Repeat,   ReplaceNumber, ReplaceNumber};
  Random random(seed);
  const int damages = 1 + static_cast<int>(random() % 3);
  for (int i = 0; i < damages && !text.empty(); ++i) {
    kDamages[random() % std::size(kDamages)](random, &text);
  }
  return text;
}

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
      aircraft += IsAircraft(Damaged(text, static_cast<std::uint32_t>(seed))) ? 1 : 0;
    }
    // Neither all of them nor none: both ways are walked.
    EXPECT_GT(aircraft, variants / 50) << file.name;
    EXPECT_LT(aircraft, variants * 9 / 10) << file.name;
  }
}

}  // namespace
}  // namespace skein
