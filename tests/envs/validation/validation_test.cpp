// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/envs/validation/sections.h"

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

TEST(Validation, TrimsAndModesArePublishedOnes) { ExpectToHold(PublishedTrims()); }

TEST(Validation, AirIsThatOfTheStandards) { ExpectToHold(PublishedAirFigures()); }

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
