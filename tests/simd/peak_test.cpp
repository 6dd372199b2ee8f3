// SPDX-License-Identifier: Apache-2.0
#include "simd/peak.h"

#include "base/error.h"
#include "gtest/gtest.h"
#include "simd/target.h"
#include "tests/sanitizers.h"

namespace skein {
namespace {

// No processor of a supported target runs faster than this, cycles/s. Other programs may take any
// part of the machine away, so that there is no such bound below.
constexpr double kFastestClock = 1e10;
// Threads may share a core, and the machine with other programs: together they do at least this
// share of what one does alone, as the best of many runs counts.
constexpr double kLeastShare = 0.25;

/// The rates of a target, with the one before put back.
template <class Measure>
auto On(simd::Target target, const Measure& measure) {
  const simd::Target before = simd::ActiveTarget();
  simd::ForceTarget(target);
  const auto result = measure();
  simd::ForceTarget(before);
  return result;
}

TEST(Peak, WiderVectorsDoMore) {
  const auto measure = [] { return simd::MeasurePeak(1); };
  const double scalar = On(simd::Target::kScalar, measure).gflops_per_core;
  const simd::PeakRate best = On(simd::SupportedTargets().front(), measure);
  EXPECT_GT(scalar, 0.05);
  EXPECT_EQ(best.gflops, best.gflops_per_core);
  // Four lanes or more; half of that allows for a busy machine.
  if (simd::SupportedTargets().size() > 1) {
    EXPECT_GT(best.gflops_per_core, 2 * scalar);
  }
}

TEST(Peak, MedianOfOneThreadIsNotAboveItsBest) {
  const simd::PeakRate rate = simd::MeasurePeak(1);
  EXPECT_GT(rate.median_gflops, 0);
  EXPECT_LE(rate.median_gflops, rate.gflops);
}

TEST(Peak, ClockIsThatOfAProcessorOnEveryTarget) {
  for (const simd::Target target : simd::SupportedTargets()) {
    SCOPED_TRACE(simd::Name(target));
    const double clock = On(target, [] { return simd::MeasureClock(); });
    EXPECT_GT(clock, 0);
    EXPECT_LT(clock, kFastestClock);
  }
}

TEST(Peak, MoreThreadsDoNoLess) {
  const simd::PeakRate rate = simd::MeasurePeak(2);
  EXPECT_GT(rate.gflops_per_core, 0);
  EXPECT_GT(rate.gflops, kLeastShare * rate.gflops_per_core);
}

double ProductPeak(simd::Precision precision) {
  return simd::MeasureProductPeak(precision, 1).gflops_per_core;
}

TEST(Peak, Bfloat16IsFasterThanFloat32WhereItIsSaidToBe) {
  if (kIsSanitized) GTEST_SKIP() << "a sanitizer counts, not the processor";
  if (!simd::NativeBfloat16()) GTEST_SKIP() << "this processor has no instruction for it";
  EXPECT_EQ(ProductPeak(simd::Precision::kBfloat16) > ProductPeak(simd::Precision::kFloat32),
            simd::FastBfloat16());
}

TEST(Peak, TilesAreFasterThanFloat32WhereTheyHaveAnInstruction) {
  if (kIsSanitized) GTEST_SKIP() << "a sanitizer counts, not the processor";
  if (!simd::NativeTiles()) GTEST_SKIP() << "this processor has no instruction for them";
  EXPECT_GT(ProductPeak(simd::Precision::kSplitTiles), ProductPeak(simd::Precision::kFloat32));
  EXPECT_GT(ProductPeak(simd::Precision::kTiles), ProductPeak(simd::Precision::kSplitTiles));
}

TEST(Peak, NoThreadsIsAnError) {
  EXPECT_THROW(simd::MeasurePeak(0), Error);
  EXPECT_THROW(simd::MeasureProductPeak(simd::Precision::kBfloat16, 0), Error);
  EXPECT_THROW(simd::MeasureProductPeak(simd::Precision::kTiles, 0), Error);
}

}  // namespace
}  // namespace skein
