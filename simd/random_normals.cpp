// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "simd/dispatch.h"
#include "simd/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/random_normals.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/random-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

void FillNormalsKernel(std::uint64_t seed, std::uint32_t first, const std::uint32_t* b,
                       const std::uint32_t* c, simd::RandomPurpose purpose, int count, int size,
                       float* out) {
  const FloatTag d;
  const UintTag du;
  const PhiloxKeys keys(seed);
  alignas(64) std::uint32_t block_b[kLanes] = {}, block_c[kLanes] = {};
  alignas(64) float block_normals[4][kLanes];
  for (int begin = 0; begin < count; begin += kLanes) {
    const int valid = std::min(count - begin, kLanes);
    for (int lane = 0; lane < valid; ++lane) {
      block_b[lane] = b[begin + lane];
      block_c[lane] = c[begin + lane];
    }
    const auto a = hn::Iota(du, first + static_cast<std::uint32_t>(begin));
    const auto vector_b = hn::Load(du, block_b), vector_c = hn::Load(du, block_c);
    for (int element = 0; element < size; element += 4) {
      V normals[4];
      NormalBlock(d, keys, a, vector_b, vector_c, purpose, static_cast<std::uint32_t>(element / 4),
                  normals);
      for (int k = 0; k < 4; ++k) hn::Store(normals[k], d, block_normals[k]);
      const int elements = size - element < 4 ? size - element : 4;
      for (int lane = 0; lane < valid; ++lane) {
        float* const row = out + static_cast<std::size_t>(begin + lane) * size + element;
        for (int k = 0; k < elements; ++k) row[k] = block_normals[k][lane];
      }
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(FillNormalsKernel);

void simd::FillNormals(std::uint64_t seed, std::uint32_t first, const std::uint32_t* b,
                       const std::uint32_t* c, RandomPurpose purpose, int count, int size,
                       float* out) {
  SKEIN_DISPATCH(FillNormalsKernel)(seed, first, b, c, purpose, count, size, out);
}

}  // namespace skein
#endif
