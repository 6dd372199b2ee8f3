// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/evaluation/quantities.h"

namespace skein {

// The results of a study: an array of objects with task, level and comparison, the document of a
// Comparison whose first `trained` agents are the policies of one training with other seeds.
// `quantities` are those of all of them; a comparison need not have each.

/// A row for every agent of every level, and one called "trained" of the mean over the seeds with
/// the interval that they leave (Student's t over seeds).
std::string StudyCsv(const nlohmann::ordered_json& results, std::size_t trained,
                     const std::vector<Quantity>& quantities);

/// The headlines by task and level, for people; without a newline at the end.
std::string StudyText(const nlohmann::ordered_json& results, std::size_t trained,
                      const std::vector<Quantity>& quantities);

}  // namespace skein
