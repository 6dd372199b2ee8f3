// SPDX-License-Identifier: Apache-2.0
#include "src/config/whole_number.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace skein {

CLI::Validator WholeNumber(double min, double max) {
  const std::string range = fmt::format("[{:.0f} - {:.0f}]", min, max);
  return CLI::Validator(
      [min, max, range](std::string& text) {
        char* end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        const bool whole = !text.empty() && *end == '\0' && number == std::floor(number);
        if (!whole || !(number >= min && number <= max)) {
          return fmt::format("'{}' is not a whole number in {}", text, range);
        }
        text = fmt::format("{:.0f}", number);
        return std::string();
      },
      "whole number in " + range);
}

}  // namespace skein
