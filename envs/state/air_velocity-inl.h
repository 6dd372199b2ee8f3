// SPDX-License-Identifier: Apache-2.0
// Velocity relative to the air on vectors of aircraft, and what the flow angles come from, for
// kernels (see simd/dispatch.h).

#include "envs/state/state.h"

#if defined(SKEIN_ENVS_STATE_AIR_VELOCITY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_STATE_AIR_VELOCITY_INL_H_
#undef SKEIN_ENVS_STATE_AIR_VELOCITY_INL_H_
#else
#define SKEIN_ENVS_STATE_AIR_VELOCITY_INL_H_
#endif

#include <hwy/highway.h>

#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
/// The matrix that takes north, east, down to body axes, row by row.
template <class V>
struct AttitudeMatrix {
  V t11, t12, t13;
  V t21, t22, t23;
  V t31, t32, t33;
};

template <class V>
HWY_INLINE AttitudeMatrix<V> AttitudeMatrixOf(V q0, V qx, V qy, V qz) {
  // The diagonal is q0^2 +- qx^2 +- qy^2 +- qz^2.
  const V two_q0 = hn::Add(q0, q0), two_qx = hn::Add(qx, qx), two_qy = hn::Add(qy, qy);
  const V xy = hn::Mul(two_qx, qy), xz = hn::Mul(two_qx, qz), yz = hn::Mul(two_qy, qz);
  const V wx = hn::Mul(two_q0, qx), wy = hn::Mul(two_q0, qy), wz = hn::Mul(two_q0, qz);
  const V q0_qz = hn::MulAdd(q0, q0, hn::Mul(qz, qz)), qx_qy = hn::MulAdd(qx, qx, hn::Mul(qy, qy));
  const V q0_less_qz = hn::NegMulAdd(qz, qz, hn::Mul(q0, q0));
  const V qx_less_qy = hn::NegMulAdd(qy, qy, hn::Mul(qx, qx));
  AttitudeMatrix<V> matrix;
  matrix.t11 = hn::Add(q0_less_qz, qx_less_qy);
  matrix.t22 = hn::Sub(q0_less_qz, qx_less_qy);
  matrix.t33 = hn::Sub(q0_qz, qx_qy);
  matrix.t12 = hn::Add(xy, wz);
  matrix.t21 = hn::Sub(xy, wz);
  matrix.t13 = hn::Sub(xz, wy);
  matrix.t31 = hn::Add(xz, wy);
  matrix.t23 = hn::Add(yz, wx);
  matrix.t32 = hn::Sub(yz, wx);
  return matrix;
}

/// Along the body axes, ft/s.
template <class V>
struct BodyVelocity {
  V u, v, w;
};

/// `inertial` velocity less the wind, given north, east, down.
template <class V>
HWY_INLINE BodyVelocity<V> LessWind(const BodyVelocity<V>& inertial, const AttitudeMatrix<V>& t,
                                    V north, V east, V down) {
  const auto less = [&](V velocity, V along_north, V along_east, V along_down) HWY_ATTR {
    return hn::NegMulAdd(
        along_north, north,
        hn::NegMulAdd(along_east, east, hn::NegMulAdd(along_down, down, velocity)));
  };
  return {less(inertial.u, t.t11, t.t12, t.t13), less(inertial.v, t.t21, t.t22, t.t23),
          less(inertial.w, t.t31, t.t32, t.t33)};
}

/// Velocity relative to the air of the aircraft from `first` on.
template <class D, class V = hn::Vec<D>>
HWY_INLINE BodyVelocity<V> AirVelocity(D d, const Tile& tile, int first) {
  const int column = tile.air_velocity();
  return {hn::LoadU(d, tile[column] + first), hn::LoadU(d, tile[column + 1] + first),
          hn::LoadU(d, tile[column + 2] + first)};
}

/// Squares of the airspeed, ft^2/s^2: of its part in the plane of symmetry, u^2 + w^2, and of all.
template <class V>
struct AirspeedSquares {
  V in_plane, whole;
};

template <class V>
HWY_INLINE AirspeedSquares<V> SquaresOf(const BodyVelocity<V>& air) {
  const V in_plane = hn::MulAdd(air.u, air.u, hn::Mul(air.w, air.w));
  return {in_plane, hn::MulAdd(air.v, air.v, in_plane)};
}

/// Angle of attack, deg, in (-180, 180], of a velocity relative to the air.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V AlphaDegrees(D d, V u, V w) {
  return Atan2Degrees(d, w, u);
}

/// Brings a windy tile's columns of the velocity relative to the air up to date with its state and
/// wind.
template <class D>
HWY_INLINE void UpdateAirVelocity(D d, const Tile& tile, int first) {
  const auto get = [&](int column) HWY_ATTR { return hn::LoadU(d, tile[column] + first); };
  const BodyVelocity<hn::Vec<D>> inertial{get(kU), get(kV), get(kW)};
  const auto air = LessWind(inertial, AttitudeMatrixOf(get(kQ0), get(kQx), get(kQy), get(kQz)),
                            get(kWindNorth), get(kWindEast), get(kWindDown));
  hn::StoreU(air.u, d, tile[kAirU] + first);
  hn::StoreU(air.v, d, tile[kAirV] + first);
  hn::StoreU(air.w, d, tile[kAirW] + first);
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_STATE_AIR_VELOCITY_INL_H_
