// SPDX-License-Identifier: Apache-2.0
#include "src/config/whole_number.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "src/config/number_in.h"

namespace skein {

std::optional<double> ReadNumber(const std::string& text) {
  // By exponent, not by multiplying, so that 1.35G is the double nearest to 1.35e9.
  constexpr std::array<std::pair<char, const char*>, 3> kSuffixes{
      {{'k', "e3"}, {'M', "e6"}, {'G', "e9"}}};
  std::string digits = text;
  for (const auto& [suffix, exponent] : kSuffixes) {
    if (!text.empty() && text.back() == suffix) {
      digits = text.substr(0, text.size() - 1) + exponent;
    }
  }
  char* end = nullptr;
  const double number = std::strtod(digits.c_str(), &end);
  const bool is_hexadecimal = digits.find_first_of("xX") != std::string::npos;
  if (digits.empty() || *end != '\0' || is_hexadecimal) return std::nullopt;
  return number;
}

CLI::Validator WholeNumber(double min, double max) {
  const std::string range = fmt::format("[{:.0f} - {:.0f}]", min, max);
  return CLI::Validator(
      [min, max, range](std::string& text) {
        const std::optional<double> number = ReadNumber(text);
        if (!number || *number != std::floor(*number) || !(*number >= min && *number <= max)) {
          return fmt::format("'{}' is not a whole number in {}", text, range);
        }
        text = fmt::format("{:.0f}", *number);
        return std::string();
      },
      "whole number in " + range);
}

CLI::Validator FiniteNumber() {
  return NumberThat([](double) { return true; }, "finite number");
}

CLI::Validator NumberAboveZero() {
  return NumberThat([](double number) { return number > 0; }, "number above 0");
}

}  // namespace skein
