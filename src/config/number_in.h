// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace skein {

/// For CLI::Option::transform: takes a number from `min` to `max`, as of src/config/whole_number.h.
CLI::Validator NumberIn(double min, double max);

}  // namespace skein
