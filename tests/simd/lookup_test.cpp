// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "gtest/gtest.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/simd/lookup_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using D = hn::ScalableTag<float>;

void LookUp(const float* table, const float* position, float* out, int count) {
  const D d;
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    hn::StoreU(Lookup32(d, table, TruncateToInt(d, hn::LoadU(d, position + i))), d, out + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(LookUp);

class LookupTest : public testing::TestWithParam<simd::Target> {
 protected:
  void SetUp() override { simd::ForceTarget(GetParam()); }
  void TearDown() override { simd::ForceTarget(before_); }

 private:
  const simd::Target before_ = simd::ActiveTarget();
};

TEST_P(LookupTest, Lookup32ReadsEveryEntryByItsTruncatedPosition) {
  alignas(64) float table[32];
  std::vector<float> position(64), out(64);
  for (int i = 0; i < 32; ++i) table[i] = static_cast<float>(1000 + i * i);
  for (int i = 0; i < 64; ++i) position[i] = static_cast<float>((i * 37) % 64) / 2;
  SKEIN_DISPATCH(LookUp)(table, position.data(), out.data(), 64);
  for (int i = 0; i < 64; ++i) EXPECT_EQ(out[i], table[static_cast<int>(position[i])]);
}

INSTANTIATE_TEST_SUITE_P(EveryTarget, LookupTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return simd::Name(test.param); });

}  // namespace
}  // namespace skein
#endif
