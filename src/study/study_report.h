// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace skein {

// The results of a study: an array of objects with task, level and comparison, the document of a
// Comparison whose first `trained` agents are the policies of one training with other seeds.

/// A row for every agent of every level, and one called "trained" of the mean over the seeds with
/// the interval that they leave (Student's t over seeds).
std::string StudyCsv(const nlohmann::ordered_json& results, std::size_t trained);

/// Success and time to the target by task and level, for people; without a newline at the end.
std::string StudyText(const nlohmann::ordered_json& results, std::size_t trained);

}  // namespace skein
