// SPDX-License-Identifier: Apache-2.0
// Outer steps of an aircraft's autopilot: the control steps in which its outer loops run, every few
// of them, the first one included.

#if defined(SKEIN_ENVS_AUTOPILOT_CLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_CLOCK_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_CLOCK_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_CLOCK_INL_H_
#endif

#include "envs/autopilot/real-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// What this control step is to an aircraft.
template <class Mask>
struct Now {
  Mask begins;         ///< the first of its episode
  Mask is_outer_step;  ///< of the outer loops; the first is one
};

/// Advances a clock that says in how many steps the outer loops run next, of
/// `control_steps_per_outer_step`; 0 before the first step.
template <class T>
HWY_INLINE auto Tick(int control_steps_per_outer_step, T& clock) {
  auto begins = clock < 0.5;
  auto is_outer_step = clock < 1.5;
  clock = Select(is_outer_step, static_cast<double>(control_steps_per_outer_step), clock - 1);
  return Now<decltype(is_outer_step)>{begins, is_outer_step};
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_CLOCK_INL_H_
