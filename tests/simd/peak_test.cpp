#include "simd/peak.h"

#include "gtest/gtest.h"
#include "simd/error.h"
#include "simd/target.h"

namespace skein {
namespace {

TEST(Peak, WiderVectorsDoMore) {
  const simd::Target before = simd::ActiveTarget();
  simd::ForceTarget(simd::Target::kScalar);
  const double scalar = simd::MeasurePeak(1).gflops_per_core;
  simd::ForceTarget(simd::SupportedTargets().front());
  const simd::PeakRate best = simd::MeasurePeak(1);
  simd::ForceTarget(before);
  EXPECT_GT(scalar, 0.05);
  EXPECT_EQ(best.gflops, best.gflops_per_core);
  // Four lanes or more; half of that allows for a busy machine.
  if (simd::SupportedTargets().size() > 1) {
    EXPECT_GT(best.gflops_per_core, 2 * scalar);
  }
}

TEST(Peak, NoThreadsIsAnError) { EXPECT_THROW(simd::MeasurePeak(0), Error); }

}  // namespace
}  // namespace skein
