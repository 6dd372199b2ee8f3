// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace skein {

/// Memory of zeros from a cache-line boundary on. What is many pages long lies in huge pages, where
/// the system has them: a walk through it then seldom waits for the translation of an address.
class LargeMemory {
 public:
  LargeMemory() = default;
  /// `size`, in bytes, is positive. Throws std::bad_alloc.
  explicit LargeMemory(std::size_t size);

  std::byte* data() const { return bytes_.get(); }

 private:
  struct Free {
    void operator()(std::byte* bytes) const;
  };

  std::unique_ptr<std::byte[], Free> bytes_;
};

}  // namespace skein
