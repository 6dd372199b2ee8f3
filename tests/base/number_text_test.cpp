// SPDX-License-Identifier: Apache-2.0
#include "base/number_text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <limits>
#include <string>

namespace skein {
namespace {

constexpr double kNumbers[] = {0, -0.0, 0.1, -1.35e9, 1.0 / 3, 5e-324, 1.7976931348623157e308};

void ExpectTextsComeBack() {
  for (const double number : kNumbers) {
    EXPECT_EQ(NumberOf(ShortestText(number)), number);
    EXPECT_EQ(NumberOf(RoundedText(number, 17)), number);
  }
}

TEST(NumberText, IsReadBackAsTheSameNumber) { ExpectTextsComeBack(); }

TEST(NumberText, IsTheSameInALocaleOfCommas) {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  if (std::setlocale(LC_NUMERIC, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no de_DE.UTF-8 here";
  EXPECT_EQ(ShortestText(0.5), "0.5");
  EXPECT_EQ(RoundedText(0.5, 17), "0.5");
  ExpectTextsComeBack();
  std::setlocale(LC_NUMERIC, before.c_str());
}

TEST(NumberText, RoundsToSignificantDigits) {
  EXPECT_EQ(RoundedText(1.0 / 3, 3), "0.333");
  EXPECT_EQ(RoundedText(1234567, 3), "1.23e+06");
}

TEST(NumberText, WhatIsNoNumberIsNone) {
  for (const char* text : {"", " ", "1 ", " 1", "1,5", "0x10", "one", "1e", "1e999"}) {
    EXPECT_EQ(NumberOf(text), std::nullopt) << text;
  }
  EXPECT_EQ(NumberOf("inf"), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace skein
