// SPDX-License-Identifier: Apache-2.0
// ArduPilot's L1 controller holding a heading.

#include "envs/autopilot/gains.h"

#if defined(SKEIN_ENVS_AUTOPILOT_L1_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_L1_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_L1_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_L1_INL_H_
#endif

#include "envs/autopilot/real-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// The lateral acceleration, ft/s^2, + right, that takes the aircraft to a heading which lies
/// `yaw_error` rad to the right: 2 sin(error) V omega, omega = sqrt(2) pi / period, as
/// AP_L1_Control::update_heading_hold. Errors beyond 90 deg turn as hard as at 90.
template <class T>
HWY_INLINE T TurnToHeading(const L1Gains& k, T yaw_error, T speed) {
  constexpr double kQuarterTurn = 1.5707963267948966, kSqrt2Pi = 4.442882938158366;
  T sine, cosine;
  SinCos(Clip(yaw_error, -kQuarterTurn, kQuarterTurn), sine, cosine);
  return 2 * kSqrt2Pi / k.period_s * speed * sine;
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_L1_INL_H_
