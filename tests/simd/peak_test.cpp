// SPDX-License-Identifier: Apache-2.0
#include "simd/peak.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "gtest/gtest.h"
#include "simd/matrix_product.h"
#include "simd/target.h"
#include "tests/sanitizers.h"
#include "tests/scoped_target.h"

namespace skein {
namespace {

// No processor of a supported target runs faster than this, cycles/s. Other programs may take any
// part of the machine away, so that there is no such bound below.
constexpr double kFastestClock = 1e10;
// Threads may share a core, and the machine with other programs: together they do at least this
// share of what one does alone, as the best of many runs counts.
constexpr double kLeastShare = 0.25;

// Floating-point operations of a lane in a cycle, on x86: processors begin one or two multiply-adds
// of vectors in a cycle, or as many products and sums. A program on the same core's other thread
// leaves half, and hardly slows the clock's chain. The clock may change between the two by a tenth.
constexpr double kLeastOperations = 0.85, kMostOperations = 4.4;
// As for the clock: no product is faster than its roof but by what the clock gains after that.
constexpr double kMostOfRoof = 1.2;
// Measured in turns, of which the best counts: each meets the same clock and the same company.
constexpr int kTurns = 5;

#ifdef __OPTIMIZE__
constexpr bool kIsOptimised = true;
#else
constexpr bool kIsOptimised = false;
#endif

/// Lanes of float32 vectors of x86; 0 of other targets, whose processors differ more: those of
/// AArch64 begin one to four multiply-adds in a cycle.
int LanesOnX86(simd::Target target) {
  switch (target) {
    case simd::Target::kAvx512:
      return 16;
    case simd::Target::kAvx2:
      return 8;
    case simd::Target::kSse4:
      return 4;
    case simd::Target::kNeon:
    case simd::Target::kScalar:
      break;
  }
  return 0;
}

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

TEST(Peak, IsOneOrTwoMultiplyAddsOfALaneInACycle) {
  if (kIsSanitized || !kIsOptimised) GTEST_SKIP() << "this build counts, not the processor";
  for (const simd::Target target : simd::SupportedTargets()) {
    if (LanesOnX86(target) == 0) continue;
    SCOPED_TRACE(simd::Name(target));
    const ScopedTarget active(target);
    double clock = 0, operations = 0;
    for (int turn = 0; turn < kTurns; ++turn) {
      clock = std::max(clock, simd::MeasureClock());
      operations = std::max(operations, 1e9 * simd::MeasurePeak(1).gflops_per_core);
    }
    const double of_a_lane = operations / (clock * LanesOnX86(target));
    EXPECT_GT(of_a_lane, kLeastOperations) << clock << " cycles/s";
    EXPECT_LT(of_a_lane, kMostOperations) << clock << " cycles/s";
  }
}

/// The best rate of many products of float32 on this thread, GFLOP/s.
double BestOfProducts() {
  constexpr std::int64_t kRows = 384, kDepth = 128, kColumns = 128;
  constexpr int kRepetitions = 200;
  const std::vector<float> left(kRows * kDepth, 0.5f), right(kDepth * kColumns, 0.25f);
  std::vector<float> out(kRows * kColumns);
  simd::PackedMatrix packed;
  packed.Pack(kDepth, kColumns, right.data(), kColumns, 1, simd::Precision::kFloat32);
  simd::ProductWorkspace workspace;
  std::chrono::duration<double> shortest = std::chrono::hours(1);
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    const auto start = std::chrono::steady_clock::now();
    simd::Multiply(kRows, left.data(), kDepth, packed, nullptr, 0, out.data(), kColumns,
                   &workspace);
    shortest =
        std::min<std::chrono::duration<double>>(shortest, std::chrono::steady_clock::now() - start);
  }
  return 2e-9 * kRows * kDepth * kColumns / shortest.count();
}

// Products reach two thirds of it and more: they would show a roof of half its height.
TEST(Peak, NoProductIsFaster) {
  if (kIsSanitized || !kIsOptimised) GTEST_SKIP() << "this build counts, not the processor";
  for (const simd::Target target : simd::SupportedTargets()) {
    if (LanesOnX86(target) == 0) continue;
    SCOPED_TRACE(simd::Name(target));
    const ScopedTarget active(target);
    double roof = 0, products = 0;
    for (int turn = 0; turn < kTurns; ++turn) {
      roof = std::max(roof, simd::MeasurePeak(1).gflops_per_core);
      products = std::max(products, BestOfProducts());
    }
    EXPECT_LT(products, kMostOfRoof * roof);
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
