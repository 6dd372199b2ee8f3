// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <map>
#include <string>
#include <vector>

namespace skein {

/// For CLI::Option::check: takes one of `names`, and says which are known. Shells complete them.
CLI::Validator OneOf(const std::vector<std::string>& names);

/// The same for the keys of a map.
template <typename Value>
CLI::Validator OneOf(const std::map<std::string, Value>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) names.push_back(name);
  return OneOf(names);
}

}  // namespace skein
