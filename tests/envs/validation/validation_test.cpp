// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "envs/kernels/plant_kernel.h"
#include "envs/state/state.h"
#include "tests/envs/test_tile.h"
#include "tests/envs/validation/sections.h"
#include "tests/tolerance.h"

namespace skein::validation {
namespace {

void ExpectToHold(const std::vector<Section>& sections) {
  for (const Section& section : sections) {
    EXPECT_FALSE(section.figures.empty()) << section.name;
    for (const Figure& figure : section.figures) {
      EXPECT_TRUE(figure.holds()) << section.name << ", " << figure.what << ": Skein has "
                                  << figure.skein << " and " << figure.correction
                                  << ", published are " << figure.lowest << " to " << figure.highest
                                  << ", and " << figure.tolerance << " is allowed beside them";
    }
  }
}

TEST(Validation, BodiesFallAsInOtherSimulators) { ExpectToHold(FallingBodies()); }

TEST(Validation, TheF16IsThePublishedOne) { ExpectToHold(PublishedF16Figures()); }

TEST(Validation, TheF16ManoeuvresAsThePublishedOne) { ExpectToHold(PublishedManoeuvres()); }

TEST(Validation, TrimsAndModesArePublishedOnes) { ExpectToHold(PublishedTrims()); }

TEST(Validation, AirIsThatOfTheStandards) { ExpectToHold(PublishedAirFigures()); }

// The float32 kernels fall and tumble as the float64 plant that the figures are of.
TEST(Validation, TheKernelsTumbleAlike) {
  constexpr Tolerance kAltitude{0.1, "1500 roundings of 30,000 ft to 0.002 ft"};
  constexpr Tolerance kSpeed{0.005, "1500 roundings of 1000 ft/s"};
  constexpr Tolerance kRate{1e-5, "1500 roundings of 0.5 rad/s"};
  constexpr int kSteps = 1500;
  for (const bool damped : {false, true}) {
    const Plant plant = Brick(damped);
    RigidBodyState exact = FallingBrick();
    TestTile tile(1, kNumRigidBody);
    for (int k = 0; k < kNumRigidBody; ++k) tile.Fill(k, static_cast<float>(exact[k]));
    const std::vector<float> zero(tile.stride());
    const float* none = zero.data();
    const auto kernel = MakeKernelAircraft(plant.aircraft(), plant.atmosphere(), plant.gravity());
    for (int step = 0; step < kSteps; ++step) {
      exact = plant.StepRk4(exact, {}, 0.02);
      StepTileOpenLoop(*kernel, tile.tile(), {none, none, none, none, none}, 0.02f, 1);
    }
    EXPECT_NEAR(tile.at(kDown, 0), exact[kDown], kAltitude);
    EXPECT_NEAR(std::hypot(tile.at(kU, 0), tile.at(kV, 0), tile.at(kW, 0)),
                exact.segment<3>(kU).norm(), kSpeed);
    for (int k = kP; k <= kR; ++k) EXPECT_NEAR(tile.at(k, 0), exact[k], kRate) << k;
  }
}

// What is outside of its range does not hold: the tests above can fail.
TEST(Validation, AFigureHoldsWithinTheRangeAndTheToleranceAlone) {
  const Figure within = PublishedOften("", {1, 3, 2}, 2.9, 0.2, 0.2, 0);
  EXPECT_EQ(within.published, 2);
  EXPECT_TRUE(within.holds());
  EXPECT_FALSE(PublishedOften("", {1, 3}, 3.2, 0.2, 0.2, 0).holds());
  EXPECT_FALSE(PublishedOnce("", 1, 0.7, 0.2, 0).holds());
}

}  // namespace
}  // namespace skein::validation
