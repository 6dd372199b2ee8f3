// SPDX-License-Identifier: Apache-2.0
// Where a point lies from an aircraft, on vectors of consecutive aircraft (see simd/dispatch.h).

#include "envs/state/state.h"

#if defined(SKEIN_ENVS_TASKS_POINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_TASKS_POINT_INL_H_
#undef SKEIN_ENVS_TASKS_POINT_INL_H_
#else
#define SKEIN_ENVS_TASKS_POINT_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// The point's position relative to the aircraft's, ft.
struct PointError {
  V north, east, up;
};

/// Turns north and east into ahead and right of the heading. An aircraft that points straight up or
/// down has none: north counts as it.
HWY_INLINE void TurnIntoHeading(const Tile& flight, int first, V& north_or_ahead,
                                V& east_or_right) {
  const NoseOverGround nose = Nose(flight, first);
  const V square = hn::MulAdd(nose.north, nose.north, hn::Mul(nose.east, nose.east));
  const auto has_heading = hn::Gt(square, Constant(1e-12));
  V length, per_length;
  Length(square, length, per_length);
  const V cosine = hn::IfThenElse(has_heading, hn::Mul(nose.north, per_length), Constant(1));
  const V sine = hn::IfThenElseZero(has_heading, hn::Mul(nose.east, per_length));
  const V north = north_or_ahead, east = east_or_right;
  north_or_ahead = hn::MulAdd(north, cosine, hn::Mul(east, sine));
  east_or_right = hn::NegMulAdd(north, sine, hn::Mul(east, cosine));
}

/// Turns north, east and up into along, right of and above the path over ground. A path straight
/// up or down, or none, has no course: north counts as it.
HWY_INLINE void TurnIntoPath(const Tile& flight, int first, PointError& error) {
  const auto get = [&](int column) HWY_ATTR { return Column(flight, column, first); };
  const auto t = AttitudeMatrixOf(get(kQ0), get(kQx), get(kQy), get(kQz));
  const V u = get(kU), v = get(kV), w = get(kW);
  const auto component = [&](V of_u, V of_v, V of_w) HWY_ATTR {
    return hn::MulAdd(of_u, u, hn::MulAdd(of_v, v, hn::Mul(of_w, w)));
  };
  const V north = component(t.t11, t.t21, t.t31);
  const V east = component(t.t12, t.t22, t.t32);
  const V down = component(t.t13, t.t23, t.t33);
  const V level_squared = hn::MulAdd(north, north, hn::Mul(east, east));
  V level, per_level, speed, per_speed;
  Length(level_squared, level, per_level);
  Length(hn::MulAdd(down, down, level_squared), speed, per_speed);
  const auto has_course = hn::Gt(level_squared, Constant(1e-6));
  const V course_cosine = hn::IfThenElse(has_course, hn::Mul(north, per_level), Constant(1));
  const V course_sine = hn::IfThenElseZero(has_course, hn::Mul(east, per_level));
  const auto has_path = hn::Gt(speed, Constant(1e-3));
  const V climb_cosine = hn::IfThenElse(has_path, hn::Mul(level, per_speed), Constant(1));
  const V climb_sine = hn::IfThenElseZero(has_path, hn::Neg(hn::Mul(down, per_speed)));

  const V ahead = hn::MulAdd(error.north, course_cosine, hn::Mul(error.east, course_sine));
  error.east = hn::NegMulAdd(error.north, course_sine, hn::Mul(error.east, course_cosine));
  error.north = hn::MulAdd(ahead, climb_cosine, hn::Mul(error.up, climb_sine));
  error.up = hn::NegMulAdd(ahead, climb_sine, hn::Mul(error.up, climb_cosine));
}

/// Shares of a path, from 0 at its beginning to 1 at its end: where it enters and leaves the box.
struct PathInBox {
  V enters, leaves;
};

/// Cuts off what lies outside the slab abs(error) <= tolerance of one axis.
HWY_INLINE void CutBySlab(V begin, V end, V tolerance, PathInBox& path) {
  const V change = hn::Sub(end, begin);
  // A path along the slab is inside all the way or not at all: far crossings say which.
  const V along = hn::IfThenElse(hn::Eq(change, hn::Zero(FloatTag())), Constant(1e-20), change);
  const V one = hn::Div(hn::Sub(hn::Neg(tolerance), begin), along);
  const V other = hn::Div(hn::Sub(tolerance, begin), along);
  path.enters = hn::Max(path.enters, hn::Min(one, other));
  path.leaves = hn::Min(path.leaves, hn::Max(one, other));
}

/// Whether the straight path between two errors touches the box of `tolerance` around the point. A
/// NaN touches nothing: minima and maxima may lose it, the `distance` at the end has it still.
HWY_INLINE Mask TouchesBox(const PointError& begin, const PointError& end, V tolerance,
                           V distance) {
  PathInBox path{hn::Zero(FloatTag()), Constant(1)};
  CutBySlab(begin.north, end.north, tolerance, path);
  CutBySlab(begin.east, end.east, tolerance, path);
  CutBySlab(begin.up, end.up, tolerance, path);
  return hn::And(hn::Le(path.enters, path.leaves), hn::Eq(distance, distance));
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_TASKS_POINT_INL_H_
