// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace skein {

/// For CLI::Option::transform: takes a whole number from `min` to `max` (at most 2^53, which a
/// double holds exactly) in any notation of a number, such as 1000 or 1e3, and refuses everything
/// else.
CLI::Validator WholeNumber(double min, double max);

}  // namespace skein
