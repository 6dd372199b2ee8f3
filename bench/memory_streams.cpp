// SPDX-License-Identifier: Apache-2.0
#include "bench/memory_streams.h"

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/memory_streams.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

float ReadStreamKernel(const float* values, std::size_t count) {
  const FloatTag d;
  // Eight sums: one alone would wait for its own additions.
  auto s0 = hn::Zero(d), s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0, s6 = s0, s7 = s0;
  for (std::size_t i = 0; i < count; i += 8 * kLanes) {
    const float* const at = values + i;
    s0 = hn::Add(s0, hn::Load(d, at));
    s1 = hn::Add(s1, hn::Load(d, at + kLanes));
    s2 = hn::Add(s2, hn::Load(d, at + 2 * kLanes));
    s3 = hn::Add(s3, hn::Load(d, at + 3 * kLanes));
    s4 = hn::Add(s4, hn::Load(d, at + 4 * kLanes));
    s5 = hn::Add(s5, hn::Load(d, at + 5 * kLanes));
    s6 = hn::Add(s6, hn::Load(d, at + 6 * kLanes));
    s7 = hn::Add(s7, hn::Load(d, at + 7 * kLanes));
  }
  const auto low = hn::Add(hn::Add(s0, s1), hn::Add(s2, s3));
  const auto high = hn::Add(hn::Add(s4, s5), hn::Add(s6, s7));
  return hn::GetLane(hn::SumOfLanes(d, hn::Add(low, high)));
}

void WriteStreamKernel(float* values, std::size_t count, float value) {
  const FloatTag d;
  const auto written = hn::Set(d, value);
  for (std::size_t i = 0; i < count; i += 4 * kLanes) {
    for (int k = 0; k < 4; ++k) hn::Store(written, d, values + i + k * kLanes);
  }
}

void UpdateStreamKernel(float* values, std::size_t count, float value) {
  const FloatTag d;
  const auto added = hn::Set(d, value);
  for (std::size_t i = 0; i < count; i += 4 * kLanes) {
    for (int k = 0; k < 4; ++k) {
      float* const at = values + i + k * kLanes;
      hn::Store(hn::Add(hn::Load(d, at), added), d, at);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(ReadStreamKernel);
HWY_EXPORT(WriteStreamKernel);
HWY_EXPORT(UpdateStreamKernel);

namespace bench {

float ReadStream(const float* values, std::size_t count) {
  return SKEIN_DISPATCH(ReadStreamKernel)(values, count);
}

void WriteStream(float* values, std::size_t count, float value) {
  SKEIN_DISPATCH(WriteStreamKernel)(values, count, value);
}

void UpdateStream(float* values, std::size_t count, float value) {
  SKEIN_DISPATCH(UpdateStreamKernel)(values, count, value);
}

}  // namespace bench
}  // namespace skein
#endif
