// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/adam_kernel.h"

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "train/ppo/adam_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

// Every operation rounds as LibTorch's (1.13, on processors with fused multiply-add), so that both
// agree in every bit on avx2 and avx512.
void AdamStepKernel(const AdamStep& step) {
  const FloatTag d;
  const auto beta1 = Constant(step.beta1), one_minus_beta1 = Constant(step.one_minus_beta1);
  const auto beta2 = Constant(step.beta2), one_minus_beta2 = Constant(step.one_minus_beta2);
  const auto root_correction = Constant(step.root_correction);
  const auto gradient_scale = Constant(step.gradient_scale);
  const auto epsilon = Constant(step.epsilon), step_size = Constant(step.step_size);
  for (std::int64_t i = 0; i < step.size; i += kLanes) {
    const auto g = hn::Mul(hn::Load(d, step.gradient + i), gradient_scale);
    const auto m =
        hn::MulAdd(g, one_minus_beta1, hn::Mul(hn::Load(d, step.first_moment + i), beta1));
    const auto v = hn::MulAdd(hn::Mul(one_minus_beta2, g), g,
                              hn::Mul(hn::Load(d, step.second_moment + i), beta2));
    const auto root = hn::Add(hn::Div(hn::Sqrt(v), root_correction), epsilon);
    const auto p = hn::Sub(hn::Load(d, step.parameters + i), hn::Div(hn::Mul(step_size, m), root));
    hn::Store(m, d, step.first_moment + i);
    hn::Store(v, d, step.second_moment + i);
    hn::Store(p, d, step.parameters + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(AdamStepKernel);

void TakeAdamStep(const AdamStep& step) { SKEIN_DISPATCH(AdamStepKernel)(step); }

}  // namespace skein
#endif  // HWY_ONCE
