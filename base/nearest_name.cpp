// SPDX-License-Identifier: Apache-2.0
#include "base/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <utility>

#include "base/ends_with.h"

namespace skein {
namespace {

/// Of optimal string alignment: a pair that was swapped is one edit, and is not edited again.
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1), above(row), two_above(row);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(two_above, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, row[j - 1] + 1, above[j] + 1});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string InLowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool IsLastPartOf(const std::string& name, const std::string& key) {
  return EndsWith(key, "." + name);
}

}  // namespace

std::string NearestName(const std::string& name, const std::vector<std::string>& candidates) {
  // A very long name is near nothing, and the distance's cost grows with its length.
  constexpr std::size_t kLongestName = 200;
  if (name.empty() || name.size() > kLongestName) return "";
  const std::string written = InLowerCase(name);
  std::string nearest;
  std::size_t best = kLongestName;
  for (const std::string& candidate : candidates) {
    if (IsLastPartOf(name, candidate)) return candidate;
    const auto [shorter, longer] = std::minmax({name.size(), candidate.size()});
    const std::size_t most = (shorter + 1) / 3;
    // The distance is at least the difference in length.
    if (longer - shorter > most) continue;
    const std::size_t distance = EditDistance(written, InLowerCase(candidate));
    if (distance <= most && distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string DidYouMean(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string nearest = NearestName(name, candidates);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace skein
