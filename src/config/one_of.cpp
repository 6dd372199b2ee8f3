// SPDX-License-Identifier: Apache-2.0
#include "src/config/one_of.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/nearest_name.h"

namespace skein {

CLI::Validator OneOf(const std::vector<std::string>& names) {
  return CLI::Validator(
      [names](const std::string& text) {
        if (std::find(names.begin(), names.end(), text) != names.end()) return std::string();
        return fmt::format("unknown {}{}; known: {}", text, DidYouMean(text, names),
                           fmt::join(names, ", "));
      },
      // Shells complete what stands in braces.
      fmt::format("{{{}}}", fmt::join(names, ",")));
}

}  // namespace skein
