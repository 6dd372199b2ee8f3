// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// The shortest text that is read back as the same double, in any locale.
std::string ShortestText(double value);

/// The same in at most `digits` significant digits.
std::string RoundedText(double value, int digits);

}  // namespace skein
