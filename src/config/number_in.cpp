// SPDX-License-Identifier: Apache-2.0
#include "src/config/number_in.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/number_text.h"
#include "src/config/whole_number.h"

namespace skein {

CLI::Validator NumberThat(const std::function<bool(double)>& is_right, const std::string& kind) {
  return CLI::Validator(
      [is_right, kind](std::string& text) {
        const std::optional<double> number = ReadNumber(text);
        if (!number || !std::isfinite(*number) || !is_right(*number)) {
          return fmt::format("'{}' is not a {}", text, kind);
        }
        text = ShortestText(*number);
        return std::string();
      },
      kind);
}

CLI::Validator NumberIn(double min, double max) {
  return NumberThat([min, max](double number) { return number >= min && number <= max; },
                    fmt::format("number in [{:g} - {:g}]", min, max));
}

}  // namespace skein
