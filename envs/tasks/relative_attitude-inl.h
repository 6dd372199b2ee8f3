// SPDX-License-Identifier: Apache-2.0
// What a target attitude is from that of an aircraft, on vectors of consecutive aircraft (see
// simd/dispatch.h).

#include "envs/state/state.h"

#if defined(SKEIN_ENVS_TASKS_RELATIVE_ATTITUDE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_TASKS_RELATIVE_ATTITUDE_INL_H_
#undef SKEIN_ENVS_TASKS_RELATIVE_ATTITUDE_INL_H_
#else
#define SKEIN_ENVS_TASKS_RELATIVE_ATTITUDE_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// The rotation from the attitude to the one of the quaternion in four columns of the task from
/// `target` on: conj(q) t, as scalar and vector part.
struct RelativeAttitude {
  V scalar, x, y, z;
};

HWY_INLINE RelativeAttitude RelativeTo(const Tile& flight, const Tile& task, int target,
                                       int first) {
  const V q0 = Column(flight, kQ0, first), qx = Column(flight, kQx, first);
  const V qy = Column(flight, kQy, first), qz = Column(flight, kQz, first);
  const V t0 = Column(task, target, first), tx = Column(task, target + 1, first);
  const V ty = Column(task, target + 2, first), tz = Column(task, target + 3, first);
  const auto sum = [](V a, V b, V c, V e) { return hn::MulAdd(a, b, hn::Mul(c, e)); };
  RelativeAttitude relative;
  relative.scalar = hn::Add(sum(q0, t0, qx, tx), sum(qy, ty, qz, tz));
  // Differences of products that nearly cancel where the angle is small.
  relative.x = hn::Sub(sum(q0, tx, qz, ty), sum(t0, qx, qy, tz));
  relative.y = hn::Sub(sum(q0, ty, qx, tz), sum(t0, qy, qz, tx));
  relative.z = hn::Sub(sum(q0, tz, qy, tx), sum(t0, qz, qx, ty));
  return relative;
}

/// The angle of the rotation, rad. By the arc tangent of its parts: the arc cosine of the scalar
/// part alone would lose half of the digits where the angle is small.
HWY_INLINE V RotationAngle(const RelativeAttitude& r) {
  const V length = hn::Sqrt(hn::MulAdd(r.x, r.x, hn::MulAdd(r.y, r.y, hn::Mul(r.z, r.z))));
  // A quaternion and its negative are one attitude: the nearer of the two.
  const V half = Atan2(FloatTag(), length, hn::Abs(r.scalar));
  return hn::Add(half, half);
}

/// The angle between the nose and where the target's points, rad: the rotation turns body x into
/// the vector (along, 2 (x y + s z), 2 (x z - s y)).
HWY_INLINE V NoseAngle(const RelativeAttitude& r) {
  const V along = hn::MulAdd(
      r.scalar, r.scalar, hn::MulAdd(r.x, r.x, hn::Neg(hn::MulAdd(r.y, r.y, hn::Mul(r.z, r.z)))));
  const V right = TwiceSum(r.x, r.y, r.scalar, r.z);
  const V down = TwiceSum(r.x, r.z, hn::Neg(r.scalar), r.y);
  return Atan2(FloatTag(), hn::Sqrt(hn::MulAdd(right, right, hn::Mul(down, down))), along);
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_TASKS_RELATIVE_ATTITUDE_INL_H_
