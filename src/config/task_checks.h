// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/field_list.h"
#include "src/config/table_reader.h"

namespace skein {

/// The largest of any number of a task file but a count.
inline constexpr double kMostOfTaskFile = 1e9;
inline constexpr Bounds kAnyNumber{-kMostOfTaskFile, kMostOfTaskFile};
inline constexpr Bounds kPositiveNumber{0, kMostOfTaskFile, true};

/// Throws Error unless `name` can serve in file names and in exported code.
void RequireName(const std::string& name, const std::string& where);

/// Throws Error if there are more than `most` of `what`.
void RequireAtMost(std::size_t count, int most, const std::string& where, const char* what);

/// The one of `choices` that the table has; throws Error unless it is just one.
std::string OneOf(TableReader& reader, const std::vector<std::string>& choices);

}  // namespace skein
