// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skein::validation {

/// tests/data/nesc.json.
const nlohmann::json& CheckCases();

/// What the simulators of a case give for a quantity at its `index`-th time.
std::vector<double> Simulated(const nlohmann::json& check_case, const std::string& quantity,
                              std::size_t index);

}  // namespace skein::validation
