// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// One number; several, "300,400,500"; or evenly spaced ones, "300..1500:50" (FROM..TO:STEP; TO is
/// one of them if a whole number of steps reaches it). Numbers as ReadNumber reads them. Nothing if
/// `text` is none of these, if a number is not finite, and of more than 10,000 numbers.
std::optional<std::vector<double>> ReadNumberList(const std::string& text);

/// Adds an option of such numbers, each above `min`; `kind` says so in words ("number above 0").
/// `numbers` ascend, each once, in whatever order they are given: the axis of a grid.
CLI::Option* AddNumberList(CLI::App* command, const std::string& name, std::vector<double>* numbers,
                           double min, const std::string& kind, const std::string& description);

}  // namespace skein
