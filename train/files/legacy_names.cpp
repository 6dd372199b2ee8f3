// SPDX-License-Identifier: Apache-2.0
#include "train/files/legacy_names.h"

#include <map>
#include <string>
#include <utility>

namespace skein {
namespace {

/// Beginnings of names in files of version 0.1, and what they are now.
constexpr std::pair<const char*, const char*> kBeginnings[] = {
    {"controller.", "low_level."},
    {"controller/", "low_level/"},
    {"recurrent/keep", "recurrent/not_done"},
};

template <typename Value>
void Rename(std::map<std::string, Value>& entries) {
  for (const auto& [old, current] : kBeginnings) {
    const std::string prefix = old;
    for (auto it = entries.lower_bound(prefix);
         it != entries.end() && it->first.compare(0, prefix.size(), prefix) == 0;) {
      auto entry = entries.extract(it++);
      entry.key() = current + entry.key().substr(prefix.size());
      entries.insert(std::move(entry));
    }
  }
}

}  // namespace

void TakeCurrentNames(TensorFile& file) {
  Rename(file.metadata);
  Rename(file.tensors);
}

}  // namespace skein
