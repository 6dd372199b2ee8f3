// SPDX-License-Identifier: Apache-2.0
// Quantities of flight that tasks share, on vectors of consecutive aircraft (see simd/dispatch.h).

#include <cstdint>

#include "envs/state/state.h"

#if defined(SKEIN_ENVS_TASKS_FLIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_TASKS_FLIGHT_INL_H_
#undef SKEIN_ENVS_TASKS_FLIGHT_INL_H_
#else
#define SKEIN_ENVS_TASKS_FLIGHT_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/state/air_velocity-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

HWY_INLINE V Column(const Tile& tile, int column, int first) {
  return hn::LoadU(FloatTag(), tile[column] + first);
}

/// Velocity relative to the air in body axes, ft/s, and the reciprocals of its lengths. Lengths are
/// taken as at least 1e-6, so that ratios stay finite.
struct VelocityVectors {
  BodyVelocity<V> air;
  V forward, per_forward;  ///< sqrt(u^2 + w^2)
  V speed, per_speed;
};

/// The square root of `square` and its reciprocal.
HWY_INLINE void Length(V square, V& length, V& per_length) {
  const V positive = hn::Max(square, Constant(1e-12));
  per_length = ReciprocalSqrt(FloatTag(), positive);
  length = hn::Mul(positive, per_length);
}

HWY_INLINE VelocityVectors Velocity(const Tile& tile, int first) {
  VelocityVectors velocity;
  velocity.air = AirVelocity(FloatTag(), tile, first);
  const AirspeedSquares<V> squares = SquaresOf(velocity.air);
  Length(squares.in_plane, velocity.forward, velocity.per_forward);
  Length(squares.whole, velocity.speed, velocity.per_speed);
  return velocity;
}

/// 2 (a b + c d).
HWY_INLINE V TwiceSum(V a, V b, V c, V d) {
  const V sum = hn::MulAdd(a, b, hn::Mul(c, d));
  return hn::Add(sum, sum);
}

/// Where down is in body axes, the third row of the attitude matrix: (-sin(pitch), sin(roll)
/// cos(pitch), cos(roll) cos(pitch)).
struct DownInBody {
  V sin_pitch;  ///< less the first component
  V y, z;
};

HWY_INLINE DownInBody Down(const Tile& tile, int first) {
  const V q0 = Column(tile, kQ0, first), qx = Column(tile, kQx, first);
  const V qy = Column(tile, kQy, first), qz = Column(tile, kQz, first);
  DownInBody down;
  down.sin_pitch = TwiceSum(q0, qy, hn::Neg(qx), qz);
  down.y = TwiceSum(qy, qz, q0, qx);
  down.z = hn::MulAdd(q0, q0, hn::MulAdd(qz, qz, hn::NegMulAdd(qx, qx, hn::Neg(hn::Mul(qy, qy)))));
  return down;
}

/// Over the ground, upwards, ft/s.
HWY_INLINE V ClimbRate(const Tile& tile, int first) {
  const DownInBody down = Down(tile, first);
  const V below =
      hn::MulAdd(Column(tile, kV, first), down.y, hn::Mul(Column(tile, kW, first), down.z));
  return hn::MulSub(Column(tile, kU, first), down.sin_pitch, below);
}

/// Pitch, rad, in [-pi/2, pi/2], from the sine and cosine both: as exact nose up as level.
HWY_INLINE V Pitch(const Tile& tile, int first) {
  const DownInBody down = Down(tile, first);
  const V cosine = hn::Sqrt(hn::MulAdd(down.y, down.y, hn::Mul(down.z, down.z)));
  return Atan2(FloatTag(), down.sin_pitch, cosine);
}

/// Where the nose points over the ground, of the first row of the attitude matrix.
struct NoseOverGround {
  V north, east;
};

HWY_INLINE NoseOverGround Nose(const Tile& tile, int first) {
  const V q0 = Column(tile, kQ0, first), qx = Column(tile, kQx, first);
  const V qy = Column(tile, kQy, first), qz = Column(tile, kQz, first);
  return {hn::MulAdd(q0, q0, hn::NegMulAdd(qz, qz, hn::NegMulAdd(qy, qy, hn::Mul(qx, qx)))),
          TwiceSum(qx, qy, q0, qz)};
}

/// Yaw, rad, in [-pi, pi].
HWY_INLINE V Yaw(const Tile& tile, int first) {
  const NoseOverGround nose = Nose(tile, first);
  return Atan2(FloatTag(), nose.east, nose.north);
}

/// An angle brought into [-pi, pi].
HWY_INLINE V WrapAngle(V angle) {
  const V turns = hn::Round(hn::Mul(angle, Constant(0.15915494309189535)));
  // 2 pi in two parts: the first times a small integer is exact.
  const V coarse = hn::NegMulAdd(turns, Constant(6.28125), angle);
  return hn::NegMulAdd(turns, Constant(0.0019353071795864769), coarse);
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_TASKS_FLIGHT_INL_H_
