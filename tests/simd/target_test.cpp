// SPDX-License-Identifier: Apache-2.0
#include "simd/target.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include "base/error.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/simd/target_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

int LanesOfKernel() { return static_cast<int>(hwy::HWY_NAMESPACE::Lanes(HWY_FULL(float)())); }

/// Of (1 + e)^2 - 1, e = 2^-12, a product that rounds has lost the e^2.
bool KernelFusesMultiplyAdd() {
  namespace hn = hwy::HWY_NAMESPACE;
  const HWY_FULL(float) d;
  const auto x = hn::Set(d, 1 + 0x1p-12f);
  return hn::GetLane(hn::MulAdd(x, x, hn::Set(d, -1.0f))) != 0x1p-11f;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

using simd::Target;

HWY_EXPORT(LanesOfKernel);
HWY_EXPORT(KernelFusesMultiplyAdd);

class TargetTest : public testing::Test {
 protected:
  void TearDown() override { simd::ForceTarget(before_); }

 private:
  const Target before_ = simd::ActiveTarget();
};

int LanesOf(Target target) {
  switch (target) {
    case Target::kAvx512:
      return 16;
    case Target::kAvx2:
      return 8;
    case Target::kSse4:
    case Target::kNeon:
      return 4;
    case Target::kScalar:
      break;
  }
  return 1;
}

TEST_F(TargetTest, KernelsAreBuiltForTheArchitecturesTargetsAndNoOthers) {
#if HWY_ARCH_X86
  EXPECT_EQ(HWY_TARGETS, HWY_AVX3 | HWY_AVX2 | HWY_SSE4 | HWY_SCALAR);
#elif HWY_ARCH_ARM_A64
  EXPECT_THAT(simd::SupportedTargets(), testing::ElementsAre(Target::kNeon, Target::kScalar));
#else
  EXPECT_THAT(simd::SupportedTargets(), testing::ElementsAre(Target::kScalar));
#endif
}

TEST_F(TargetTest, NamesAreOfTheTargetThatTheyName) {
  const std::pair<Target, std::string> names[] = {{Target::kAvx512, "avx512"},
                                                  {Target::kAvx2, "avx2"},
                                                  {Target::kSse4, "sse4"},
                                                  {Target::kNeon, "neon"},
                                                  {Target::kScalar, "scalar"}};
  for (const auto& [target, name] : names) EXPECT_EQ(simd::Name(target), name);
}

TEST_F(TargetTest, ScalarIsAlwaysSupportedAndLast) {
  EXPECT_EQ(simd::SupportedTargets().back(), Target::kScalar);
}

TEST_F(TargetTest, ForcingATargetRunsItsBuildOfAKernel) {
  for (const Target target : simd::SupportedTargets()) {
    SCOPED_TRACE(simd::Name(target));
    simd::ForceTarget(target);
    EXPECT_EQ(simd::ActiveTarget(), target);
    EXPECT_EQ(SKEIN_DISPATCH(LanesOfKernel)(), LanesOf(target));
    EXPECT_EQ(SKEIN_DISPATCH(KernelFusesMultiplyAdd)(), simd::FusesMultiplyAdd(target));
  }
}

// The environment is read once, so each value needs a fresh process: a death test that re-executes
// this program.
class SkeinSimdVariable : public testing::Test {
 protected:
  SkeinSimdVariable() { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

int LanesWithVariable(const char* value) {
  setenv("SKEIN_SIMD", value, 1);
  return SKEIN_DISPATCH(LanesOfKernel)();
}

TEST_F(SkeinSimdVariable, ChoosesTheBuildOfTheFirstKernelCall) {
  for (const Target target : simd::SupportedTargets()) {
    EXPECT_EXIT(std::exit(LanesWithVariable(simd::Name(target))),
                testing::ExitedWithCode(LanesOf(target)), "");
  }
}

TEST_F(SkeinSimdVariable, EmptyMeansTheBestSupportedTarget) {
  EXPECT_EXIT(std::exit(LanesWithVariable("")),
              testing::ExitedWithCode(LanesOf(simd::SupportedTargets().front())), "");
}

TEST_F(SkeinSimdVariable, UnknownNameIsAnErrorThatListsTheKnownOnes) {
  const auto use_unknown = [] {
    try {
      LanesWithVariable("avx1024");
    } catch (const Error& error) {
      std::fputs(error.what(), stderr);
      std::exit(1);
    }
  };
  EXPECT_EXIT(use_unknown(), testing::ExitedWithCode(1), "avx1024.*scalar");
}

}  // namespace
}  // namespace skein
#endif
