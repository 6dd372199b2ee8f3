// SPDX-License-Identifier: Apache-2.0
#include "simd/peak.h"

#include "base/error.h"
#include "gtest/gtest.h"
#include "simd/target.h"

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

TEST(Peak, Bfloat16IsFasterWhereItHasAnInstruction) {
  const auto rate = simd::MeasureBfloat16Peak(1);
  ASSERT_EQ(rate.has_value(), simd::NativeBfloat16());
  if (rate) {
    EXPECT_GT(rate->gflops_per_core, simd::MeasurePeak(1).gflops_per_core);
  }
}

TEST(Peak, NoThreadsIsAnError) {
  EXPECT_THROW(simd::MeasurePeak(0), Error);
  EXPECT_THROW(simd::MeasureBfloat16Peak(0), Error);
}

}  // namespace
}  // namespace skein
