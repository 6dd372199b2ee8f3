// SPDX-License-Identifier: Apache-2.0
#include "src/config/task_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"

namespace skein {
namespace {

constexpr std::size_t kLongestName = 40;

}  // namespace

void RequireName(const std::string& name, const std::string& where) {
  const auto is_fit = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (!name.empty() && name.size() <= kLongestName && name[0] >= 'a' && name[0] <= 'z' &&
      std::all_of(name.begin(), name.end(), is_fit)) {
    return;
  }
  throw Error(
      fmt::format("{} must be a name of 1 to {} of a-z, 0-9 and _ that begins with a letter", where,
                  kLongestName));
}

void RequireAtMost(std::size_t count, int most, const std::string& where, const char* what) {
  if (count <= static_cast<std::size_t>(most)) return;
  throw Error(fmt::format("{}: {} {}, but there may be at most {}", where, count, what, most));
}

std::string OneOf(TableReader& reader, const std::vector<std::string>& choices) {
  std::vector<std::string> given;
  for (const std::string& choice : choices) {
    if (reader.Has(choice)) given.push_back(choice);
  }
  if (given.size() == 1) return given.front();
  if (given.empty()) {
    reader.RefuseLack(choices, fmt::format("it needs one of {}", fmt::join(choices, ", ")));
  }
  throw Error(
      fmt::format("{}: it must have just one of {}", reader.Here(), fmt::join(choices, ", ")));
}

}  // namespace skein
