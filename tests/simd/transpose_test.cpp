// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <vector>

#include "gtest/gtest.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/simd/transpose_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/transpose-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using D = hn::ScalableTag<float>;

/// Transposes the first Lanes x Lanes of a row-major square; returns Lanes.
int TransposeSquare(const float* in, float* out) {
  const D d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
  hn::Vec<D> rows[kLanes];
  for (int i = 0; i < kLanes; ++i) rows[i] = hn::LoadU(d, in + i * kLanes);
  Transpose(d, rows);
  for (int i = 0; i < kLanes; ++i) hn::StoreU(rows[i], d, out + i * kLanes);
  return kLanes;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(TransposeSquare);

class TransposeTest : public testing::TestWithParam<simd::Target> {
 protected:
  void SetUp() override { simd::ForceTarget(GetParam()); }
  void TearDown() override { simd::ForceTarget(before_); }

 private:
  const simd::Target before_ = simd::ActiveTarget();
};

TEST_P(TransposeTest, TransposeSwapsRowsAndColumns) {
  std::vector<float> in(256), out(256);
  for (std::size_t i = 0; i < in.size(); ++i) in[i] = static_cast<float>(i);
  const int lanes = SKEIN_DISPATCH(TransposeSquare)(in.data(), out.data());
  for (int i = 0; i < lanes; ++i) {
    for (int j = 0; j < lanes; ++j) EXPECT_EQ(out[i * lanes + j], in[j * lanes + i]);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryTarget, TransposeTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return simd::Name(test.param); });

}  // namespace
}  // namespace skein
#endif
