// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "src/evaluation/quantities.h"

namespace skein {

// The results of a study: an array of objects with task, level and comparison, the document of a
// Comparison whose first agents, called "seed N", are the policies of one training with other
// seeds. `quantities` are those of all of them; a comparison need not have each.

inline constexpr std::string_view kSeedPrefix = "seed ";

/// Those of its first agents. Throws nlohmann::json::exception on what is no comparison, and Error
/// where a number does not follow the prefix, or not alone.
std::vector<std::uint64_t> SeedsOf(const nlohmann::ordered_json& comparison);

/// A row for every agent of every level, and one called "trained" of the mean over the seeds with
/// the interval that they leave (Student's t over seeds).
std::string StudyCsv(const nlohmann::ordered_json& results,
                     const std::vector<Quantity>& quantities);

/// The headlines by task and level, all of the same agents, for people; without a newline at the
/// end.
std::string StudyText(const nlohmann::ordered_json& results,
                      const std::vector<Quantity>& quantities);

}  // namespace skein
