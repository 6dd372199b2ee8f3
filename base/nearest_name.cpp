// SPDX-License-Identifier: Apache-2.0
#include "base/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "base/ends_with.h"

namespace skein {
namespace {

std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row[b.size()];
}

bool IsLastPartOf(const std::string& name, const std::string& key) {
  return EndsWith(key, "." + name);
}

}  // namespace

std::string NearestName(const std::string& name, const std::vector<std::string>& candidates) {
  // A very long name is near nothing, and the distance's cost grows with its length.
  constexpr std::size_t kLongestName = 200;
  if (name.empty() || name.size() > kLongestName) return "";
  std::string nearest;
  std::size_t best = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (IsLastPartOf(name, candidate)) return candidate;
    const auto [shorter, longer] = std::minmax({name.size(), candidate.size()});
    // The distance is at least the difference in length.
    if (longer - shorter >= best) continue;
    const std::size_t distance = EditDistance(name, candidate);
    // Of short names half may differ: else any two letters would be near each other.
    if (distance < best && distance <= shorter / 2) {
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
