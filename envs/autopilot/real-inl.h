// SPDX-License-Identifier: Apache-2.0
// The numbers that the autopilot's laws are written in: a double, to be read and compared with, or
// the float32 of as many aircraft as a vector has lanes (`Lanes`). Functions of the same name do
// the same for both.

#include <cmath>

#if defined(SKEIN_ENVS_AUTOPILOT_REAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_REAL_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_REAL_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_REAL_INL_H_
#endif

#include <hwy/highway.h>

#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// One float32 of each of consecutive aircraft. Constants convert to it.
struct Lanes {
  V v;

  Lanes() = default;
  HWY_INLINE explicit Lanes(V vector) : v(vector) {}
  HWY_INLINE Lanes(double value) : v(hn::Set(FloatTag(), static_cast<float>(value))) {}  // NOLINT

  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.v, b.v)); }
  friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return Lanes(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return Lanes(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) {
    return Lanes(hn::Mul(a.v, Reciprocal(FloatTag(), b.v)));
  }
  friend HWY_INLINE Lanes operator-(Lanes a) { return Lanes(hn::Neg(a.v)); }
};

HWY_INLINE Mask operator<(Lanes a, Lanes b) { return hn::Lt(a.v, b.v); }
HWY_INLINE Mask operator>(Lanes a, Lanes b) { return hn::Gt(a.v, b.v); }
HWY_INLINE Mask And(Mask a, Mask b) { return hn::And(a, b); }
HWY_INLINE Mask Or(Mask a, Mask b) { return hn::Or(a, b); }
HWY_INLINE Mask Not(Mask a) { return hn::Not(a); }
HWY_INLINE Lanes Select(Mask where, Lanes yes, Lanes no) {
  return Lanes(hn::IfThenElse(where, yes.v, no.v));
}
HWY_INLINE Lanes Abs(Lanes x) { return Lanes(hn::Abs(x.v)); }
HWY_INLINE Lanes Min(Lanes a, Lanes b) { return Lanes(hn::Min(a.v, b.v)); }
HWY_INLINE Lanes Max(Lanes a, Lanes b) { return Lanes(hn::Max(a.v, b.v)); }
HWY_INLINE Lanes Sqrt(Lanes x) { return Lanes(hn::Sqrt(x.v)); }
HWY_INLINE Lanes Round(Lanes x) { return Lanes(hn::Round(x.v)); }
HWY_INLINE Lanes Floor(Lanes x) { return Lanes(hn::Floor(x.v)); }
/// table[index], of indices without a fraction.
HWY_INLINE Lanes Element(const float* table, Lanes index) {
  return Lanes(hn::GatherIndex(FloatTag(), table, hn::ConvertTo(IntTag(), index.v)));
}
HWY_INLINE Lanes ArcTangent(Lanes y, Lanes x) { return Lanes(Atan2(FloatTag(), y.v, x.v)); }
HWY_INLINE void SinCos(Lanes angle, Lanes& sine, Lanes& cosine) {
  SinCos(FloatTag(), angle.v, sine.v, cosine.v);
}

HWY_INLINE bool And(bool a, bool b) { return a && b; }
HWY_INLINE bool Or(bool a, bool b) { return a || b; }
HWY_INLINE bool Not(bool a) { return !a; }
HWY_INLINE double Select(bool where, double yes, double no) { return where ? yes : no; }
HWY_INLINE double Abs(double x) { return std::abs(x); }
HWY_INLINE double Min(double a, double b) { return a < b ? a : b; }
HWY_INLINE double Max(double a, double b) { return a > b ? a : b; }
HWY_INLINE double Sqrt(double x) { return std::sqrt(x); }
HWY_INLINE double Round(double x) { return std::nearbyint(x); }
HWY_INLINE double Floor(double x) { return std::floor(x); }
HWY_INLINE double Element(const float* table, double index) {
  return table[static_cast<int>(index)];
}
HWY_INLINE double ArcTangent(double y, double x) { return std::atan2(y, x); }
HWY_INLINE void SinCos(double angle, double& sine, double& cosine) {
  sine = std::sin(angle);
  cosine = std::cos(angle);
}

HWY_INLINE Lanes Clip(Lanes x, Lanes low, Lanes high) { return Min(Max(x, low), high); }
HWY_INLINE double Clip(double x, double low, double high) { return Min(Max(x, low), high); }

/// x = value, where `where`.
template <class T, class Mask>
HWY_INLINE void Assign(Mask where, T& x, T value) {
  x = Select(where, value, x);
}

/// Whether `x` lies within `limit` of zero.
template <class T>
HWY_INLINE auto IsWithin(T x, double limit) {
  return Abs(x) < limit;
}

/// An angle brought into [-pi, pi].
template <class T>
HWY_INLINE T Wrapped(T angle) {
  return angle - 6.283185307179586 * Round(angle * 0.15915494309189535);
}

/// The angle whose sine is `sine`, which is taken as within [-1, 1].
template <class T>
HWY_INLINE T ArcSine(T sine) {
  const T bounded = Clip(sine, -1, 1);
  return ArcTangent(bounded, Sqrt((1 - bounded) * (1 + bounded)));
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_REAL_INL_H_
