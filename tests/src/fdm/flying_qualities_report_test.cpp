// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/flying_qualities_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skein {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string TextOf(double pitch_mismatch, double roll_mismatch) {
  FlyingQualities qualities;
  qualities.short_period = {2, 0.7, 0.05, pitch_mismatch};
  qualities.roll = {0.2, 0.01, roll_mismatch};
  return Describe(qualities, "");
}

TEST(FlyingQualitiesReport, SaysWhichResponseHasNoEquivalentSystem) {
  const char* const of_pitch = "the response is not of second order";
  const char* const of_roll = "the response is not of first order";
  EXPECT_THAT(TextOf(kMostMismatch, kMostMismatch), Not(HasSubstr("the response is not")));
  EXPECT_THAT(TextOf(42.6, 1), HasSubstr(of_pitch));
  EXPECT_THAT(TextOf(42.6, 1), Not(HasSubstr(of_roll)));
  EXPECT_THAT(TextOf(1, 42.6), HasSubstr("(mismatch 42.6, above 10: the response is not of first"));
  EXPECT_THAT(TextOf(1, 42.6), Not(HasSubstr(of_pitch)));
}

}  // namespace
}  // namespace skein
