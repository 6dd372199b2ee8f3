// SPDX-License-Identifier: Apache-2.0
#include "src/bench/simulator_rate.h"

#include <gtest/gtest.h>

#include "base/median.h"

namespace skein {
namespace {

TEST(SimulatorRate, IsOfTheMedianThatFiguresSay) {
  constexpr int kAircraft = 32, kSteps = 4;  // an even number has two in the middle
  WorkerPool pool(1);
  const SimulatorRate rate = MeasurePlant(PlantPart::kRk4, kAircraft, kSteps, pool);
  EXPECT_EQ(rate.seconds.size(), 4u);
  EXPECT_EQ(rate.step_s, Median(rate.seconds));
  EXPECT_EQ(rate.aircraft_steps_per_s, kAircraft / rate.step_s);
}

}  // namespace
}  // namespace skein
