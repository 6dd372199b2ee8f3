// SPDX-License-Identifier: Apache-2.0
#include "base/large_memory.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

namespace skein {
namespace {

constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kHugePage = std::size_t{2} << 20;  // of x86-64 and, with 4 KB pages, AArch64
constexpr std::size_t kLeastSize = 2 * kHugePage;

}  // namespace

void LargeMemory::Free::operator()(std::byte* bytes) const { std::free(bytes); }

LargeMemory::LargeMemory(std::size_t size) {
  const std::size_t alignment = size < kLeastSize ? kCacheLine : kHugePage;
  if (size > SIZE_MAX - alignment) throw std::bad_alloc();
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  bytes_.reset(static_cast<std::byte*>(std::aligned_alloc(alignment, rounded)));
  if (bytes_ == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // Advice: where it is not taken, pages are small.
  if (alignment == kHugePage) madvise(bytes_.get(), rounded, MADV_HUGEPAGE);
#endif
  std::memset(bytes_.get(), 0, size);
}

}  // namespace skein
