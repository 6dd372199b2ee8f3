// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace skein {

/// What a document holds of `number`: null where it is not finite, as JSON has no such numbers.
inline nlohmann::ordered_json NumberOrNull(double number) {
  return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json();
}

}  // namespace skein
