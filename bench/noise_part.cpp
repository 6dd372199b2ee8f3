// SPDX-License-Identifier: Apache-2.0
#include "bench/noise_part.h"

#include "envs/tasks/observation.h"
#include "simd/dispatch.h"
#include "simd/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/noise_part.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/random-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

void DrawNoiseKernel(std::uint64_t seed, int count, const std::int32_t* episode,
                     const std::int32_t* step, float* sums) {
  const FloatTag d;
  const IntTag di;
  const UintTag du;
  constexpr int kBlocks = (kObservationSize + 7) / 8;
  const PhiloxKeys keys(seed);
  for (int first = 0; first < count; first += kLanes) {
    V deviates[8 * kBlocks];
    CoarseNormals<kBlocks>(d, keys, hn::Iota(du, static_cast<std::uint32_t>(first)),
                           hn::BitCast(du, hn::LoadU(di, episode + first)),
                           hn::BitCast(du, hn::LoadU(di, step + first)),
                           simd::RandomPurpose::kObservationNoise, deviates);
    auto sum = deviates[0];
    for (int k = 1; k < kObservationSize; ++k) sum = hn::Add(sum, deviates[k]);
    hn::StoreU(sum, d, sums + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(DrawNoiseKernel);

void bench::DrawNoise(std::uint64_t seed, int count, const std::int32_t* episode,
                      const std::int32_t* step, float* sums) {
  SKEIN_DISPATCH(DrawNoiseKernel)(seed, count, episode, step, sums);
}

}  // namespace skein
#endif
