// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein {

/// The candidate that `name` was probably meant to be: one that ends in ".name", else the one that
/// is the fewest edits away: characters inserted, deleted or replaced, and neighbours swapped
/// (optimal string alignment). Upper case counts as lower. A third of the shorter name may differ,
/// rounded: one of four characters, two of five. Empty if none is near.
std::string NearestName(const std::string& name, const std::vector<std::string>& candidates);

/// "; did you mean X?" for the nearest candidate, or an empty string.
std::string DidYouMean(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace skein
