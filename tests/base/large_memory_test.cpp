// SPDX-License-Identifier: Apache-2.0
#include "base/large_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <new>

namespace skein {
namespace {

std::uintptr_t AddressOf(const LargeMemory& memory) {
  return reinterpret_cast<std::uintptr_t>(memory.data());
}

TEST(LargeMemoryTest, IsOfZerosFromACacheLineOnWhateverItsSize) {
  for (const std::size_t size : {1, 100, 4096, 4 << 20, (4 << 20) + 1}) {
    {
      const LargeMemory used(size);  // what comes next may be the same memory
      std::fill_n(used.data(), size, std::byte{1});
    }
    const LargeMemory memory(size);
    EXPECT_EQ(AddressOf(memory) % 64, 0u) << size;
    EXPECT_EQ(std::count(memory.data(), memory.data() + size, std::byte{0}),
              static_cast<std::ptrdiff_t>(size));
  }
}

TEST(LargeMemoryTest, BeginsWithAHugePageWhereItIsLong) {
  EXPECT_EQ(AddressOf(LargeMemory(std::size_t{8} << 20)) % (2 << 20), 0u);
}

TEST(LargeMemoryTest, RefusesWhatNoMachineHas) {
  EXPECT_THROW(LargeMemory(SIZE_MAX - 1), std::bad_alloc);
}

TEST(LargeMemoryTest, IsNowhereUntilItHasASize) { EXPECT_EQ(LargeMemory().data(), nullptr); }

}  // namespace
}  // namespace skein
