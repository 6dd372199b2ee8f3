// SPDX-License-Identifier: Apache-2.0
#include "src/files/column_words.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/ends_with.h"

namespace skein {
namespace {

/// Endings of names, and the units that they stand for; _deg_s also ends in _s.
constexpr std::array<std::pair<std::string_view, const char*>, 6> kUnits = {{{"_deg_s", "deg/s"},
                                                                             {"_fps", "ft/s"},
                                                                             {"_deg", "deg"},
                                                                             {"_ft", "ft"},
                                                                             {"_g", "g"},
                                                                             {"_s", "s"}}};

}  // namespace

ColumnWords ColumnWordsOf(const std::string& column) {
  for (const auto& [ending, unit] : kUnits) {
    if (column.size() <= ending.size() || !EndsWith(column, ending)) continue;
    return {WithBlanks(column.substr(0, column.size() - ending.size())), unit};
  }
  return {WithBlanks(column), ""};
}

std::string WithBlanks(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace skein
