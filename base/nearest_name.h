// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein {

/// The candidate that `name` was probably meant to be: one that ends in ".name", else the one with
/// the smallest edit distance (Levenshtein), if that is at most two, or a third of the name, and at
/// most half of the shorter of both. Empty if none is near.
std::string NearestName(const std::string& name, const std::vector<std::string>& candidates);

/// "; did you mean X?" for the nearest candidate, or an empty string.
std::string DidYouMean(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace skein
