// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

namespace skein {

/// For CLI::Option::transform: takes a number, as of src/config/whole_number.h, that is finite and
/// `is_right`, which `kind` says in words.
CLI::Validator NumberThat(const std::function<bool(double)>& is_right, const std::string& kind);

/// The same for one from `min` to `max`.
CLI::Validator NumberIn(double min, double max);

}  // namespace skein
