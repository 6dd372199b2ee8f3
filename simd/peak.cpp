// SPDX-License-Identifier: Apache-2.0
#include "simd/peak.h"

#include <cstdint>
#include <string>

#include "base/error.h"
#include "simd/bfloat16_peak.h"
#include "simd/dispatch.h"
#include "simd/work_rates.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/peak.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {
/// Does `rounds` rounds of multiply-adds and returns their floating-point operations; `sink` gets a
/// result, so that the work cannot be left out.
double MultiplyAdd(std::int64_t rounds, float* sink) {
  const FloatTag d;
  // Twelve independent chains keep two units of latency five busy, as x86 has them. Processors of
  // AArch64 with four units of latency four do more.
  auto a0 = hn::Set(d, 0.1f), a1 = a0, a2 = a0, a3 = a0, a4 = a0, a5 = a0;
  auto a6 = a0, a7 = a0, a8 = a0, a9 = a0, a10 = a0, a11 = a0;
  const auto x = hn::Set(d, 0.9375f);
  const auto y = hn::Set(d, 0.0625f);
  for (std::int64_t i = 0; i < rounds; ++i) {
    a0 = hn::MulAdd(a0, x, y);
    a1 = hn::MulAdd(a1, x, y);
    a2 = hn::MulAdd(a2, x, y);
    a3 = hn::MulAdd(a3, x, y);
    a4 = hn::MulAdd(a4, x, y);
    a5 = hn::MulAdd(a5, x, y);
    a6 = hn::MulAdd(a6, x, y);
    a7 = hn::MulAdd(a7, x, y);
    a8 = hn::MulAdd(a8, x, y);
    a9 = hn::MulAdd(a9, x, y);
    a10 = hn::MulAdd(a10, x, y);
    a11 = hn::MulAdd(a11, x, y);
#if HWY_COMPILER_GCC
    // The chains are equal: keep the compiler from computing one for all.
    asm volatile(""
                 : "+x"(a0.raw), "+x"(a1.raw), "+x"(a2.raw), "+x"(a3.raw), "+x"(a4.raw),
                   "+x"(a5.raw), "+x"(a6.raw), "+x"(a7.raw), "+x"(a8.raw), "+x"(a9.raw),
                   "+x"(a10.raw), "+x"(a11.raw));
#endif
  }
  const auto low = hn::Add(hn::Add(hn::Add(a0, a1), hn::Add(a2, a3)), hn::Add(a4, a5));
  const auto high = hn::Add(hn::Add(hn::Add(a6, a7), hn::Add(a8, a9)), hn::Add(a10, a11));
  *sink = hn::GetLane(hn::Add(low, high));
  constexpr double kChains = 12, kOperations = 2;
  return static_cast<double>(rounds) * kChains * kOperations * kLanes;
}

/// A chain of integer multiplications and returns the cycles that it takes; `sink` as above. Beside
/// it runs a multiply-add in every other cycle, since wide vectors slow some processors' clocks.
double MultiplyInAChain(std::int64_t rounds, float* sink) {
  const FloatTag d;
  // Chains of their own, so that none is longer than that of the integers.
  auto a0 = hn::Set(d, 0.1f), a1 = hn::Set(d, 0.2f), a2 = hn::Set(d, 0.3f);
  auto a3 = hn::Set(d, 0.4f), a4 = hn::Set(d, 0.5f), a5 = hn::Set(d, 0.6f);
  const auto x = hn::Set(d, 0.9375f), y = hn::Set(d, 0.0625f);
  std::uint64_t chain = static_cast<std::uint64_t>(rounds) | 1;
  for (std::int64_t i = 0; i < rounds; ++i) {
    // Squares: unlike powers of a constant, no compiler folds them.
    chain *= chain;
    chain *= chain;
    a0 = hn::MulAdd(a0, x, y);
    a1 = hn::MulAdd(a1, x, y);
    a2 = hn::MulAdd(a2, x, y);
    chain *= chain;
    chain *= chain;
    a3 = hn::MulAdd(a3, x, y);
    a4 = hn::MulAdd(a4, x, y);
    a5 = hn::MulAdd(a5, x, y);
  }
  const auto sum = hn::Add(hn::Add(hn::Add(a0, a1), hn::Add(a2, a3)), hn::Add(a4, a5));
  *sink = hn::GetLane(sum) + static_cast<float>(chain);
  // Of a 64-bit multiplication: Intel since Nehalem, AMD since Zen.
  constexpr double kChain = 4, kLatency = 3;
  return static_cast<double>(rounds) * kChain * kLatency;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
HWY_EXPORT(MultiplyAdd);
HWY_EXPORT(MultiplyInAChain);

namespace simd {
namespace {

[[noreturn]] void ThrowNoThreads(int threads) {
  throw Error("peak rates: " + std::to_string(threads) + " threads");
}

struct Roof {
  double one = 0, all = 0;  ///< best of one thread, and of all together
  double median = 0;        ///< of all, none waiting for another
};

Roof MeasureRoof(Work work, std::int64_t rounds, int threads) {
  if (threads < 1) ThrowNoThreads(threads);
  constexpr int kRepetitions = 129;
  const WorkRates one = MeasureRates(work, rounds, kRepetitions, 1);
  const WorkRates all = threads == 1 ? one : MeasureRates(work, rounds, kRepetitions, threads);
  return {one.of_slowest.back(), all.of_slowest.back(), all.summed[kRepetitions / 2]};
}

PeakRate InGflops(const Roof& roof) { return {roof.one / 1e9, roof.all / 1e9, roof.median / 1e9}; }

}  // namespace

PeakRate MeasurePeak(int threads) {
  constexpr std::int64_t kRounds = 200000;
  return InGflops(MeasureRoof(SKEIN_DISPATCH(MultiplyAdd), kRounds, threads));
}

PeakRate MeasureProductPeak(Precision precision, int threads) {
#ifdef SKEIN_NATIVE_BFLOAT16
  if (precision == Precision::kBfloat16 && NativeBfloat16()) {
    constexpr std::int64_t kRounds = 100000;
    return InGflops(MeasureRoof(&MultiplyAddBfloat16, kRounds, threads));
  }
#endif
#ifdef SKEIN_NATIVE_TILES
  if (IsOfTiles(precision) && NativeTiles()) {
    constexpr std::int64_t kRounds = 50000;
    const double products = precision == Precision::kSplitTiles ? 3 : 1;
    const Roof roof = MeasureRoof(&MultiplyAddTiles, kRounds, threads);
    return InGflops({roof.one / products, roof.all / products, roof.median / products});
  }
#endif
  return MeasurePeak(threads);
}

double MeasureClock() {
  // Repetitions shorter than a busy scheduler's slices: some of them run undisturbed.
  constexpr std::int64_t kRounds = 40000;
  constexpr int kRepetitions = 200;
  return MeasureRates(SKEIN_DISPATCH(MultiplyInAChain), kRounds, kRepetitions, 1).of_slowest.back();
}

}  // namespace simd
}  // namespace skein
#endif
