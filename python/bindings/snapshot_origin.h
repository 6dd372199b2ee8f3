// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "base/error.h"

namespace skein {

/// What a snapshot was taken of: its words lie behind those of the aircraft's state.
struct SnapshotOrigin {
  std::uint64_t seed = 0;           ///< of the environment: what it draws depends on it
  std::uint64_t configuration = 0;  ///< hash of all that says what is flown
};

using OriginWords = std::array<std::uint32_t, sizeof(SnapshotOrigin) / sizeof(std::uint32_t)>;

inline void AddOrigin(const SnapshotOrigin& origin, std::vector<std::uint32_t>* words) {
  OriginWords added;
  std::memcpy(added.data(), &origin, sizeof(origin));
  words->insert(words->end(), added.begin(), added.end());
}

/// Removes what AddOrigin added. Throws Error if there is too little.
inline SnapshotOrigin TakeOrigin(std::vector<std::uint32_t>* words) {
  SnapshotOrigin origin;
  constexpr std::size_t kSize = OriginWords().size();
  if (words->size() < kSize) throw Error("restore: that is no snapshot");
  std::memcpy(static_cast<void*>(&origin), words->data() + words->size() - kSize, sizeof(origin));
  words->resize(words->size() - kSize);
  return origin;
}

}  // namespace skein
