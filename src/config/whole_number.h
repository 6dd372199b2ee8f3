// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

namespace skein {

/// A decimal number in any notation, which may end in k, M or G for thousands, millions or billions
/// (10M, 1.35G); nothing if `text` is none.
std::optional<double> ReadNumber(const std::string& text);

/// For CLI::Option::transform: takes a whole number from `min` to `max` (at most kMostWholeNumber,
/// base/field_list.h) in any notation of a number, such as 1000, 1e3 or 1k, and refuses everything
/// else.
CLI::Validator WholeNumber(double min, double max);

/// The same for any finite number, and for one above 0.
CLI::Validator FiniteNumber();
CLI::Validator NumberAboveZero();

}  // namespace skein
