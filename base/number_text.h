// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skein {

/// The shortest text that is read back as the same double, in any locale.
std::string ShortestText(double value);

/// The same in at most `digits` significant digits.
std::string RoundedText(double value, int digits);

/// Of figures in error messages.
inline constexpr int kErrorDigits = 4;

/// The number that `text` is, all of it and in any locale; nothing if it is none.
std::optional<double> NumberOf(std::string_view text);

}  // namespace skein
