// SPDX-License-Identifier: Apache-2.0
// Vector mathematics that Highway 1.0.3 lacks, for float32 vectors of any target. Each function
// states its range and its largest error; tests/simd/math_test.cpp checks both against double
// precision on every target. ULP are of the float32 result. Unless a function says otherwise a NaN
// gives NaN in its own lane, and arguments outside the range give unspecified finite or infinite
// values in their own lane. Polynomials are minimax (Remez) fits made for this file.

#if defined(SKEIN_SIMD_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_SIMD_MATH_INL_H_
#undef SKEIN_SIMD_MATH_INL_H_
#else
#define SKEIN_SIMD_MATH_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "simd/lookup-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
/// c[0] + c[1] x + ... + c[Terms - 1] x^(Terms - 1) by Horner's rule.
template <class D, std::size_t Terms, class V = hn::Vec<D>>
HWY_INLINE V Polynomial(D d, V x, const float (&c)[Terms]) {
  V y = hn::Set(d, c[Terms - 1]);
  for (std::size_t i = Terms - 1; i-- > 0;) y = hn::MulAdd(y, x, hn::Set(d, c[i]));
  return y;
}

/// x limited to [low, high]; NaN gives `low`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V ClampTo(D d, V x, float low, float high) {
  return hn::Min(hn::Max(x, hn::Set(d, low)), hn::Set(d, high));
}

/// 1 / x for normal |x| in [2^-125, 2^125]: 2 ULP. Of a larger finite x the result may be 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Reciprocal(D d, V x) {
#if HWY_TARGET == HWY_AVX3
  const V estimate = hn::ApproximateReciprocal(x);
  const V residual = hn::NegMulAdd(x, estimate, hn::Set(d, 1.0f));
  return hn::MulAdd(residual, estimate, estimate);
#else
  // The estimates of 12 bits (8 on NEON) would need more Newton steps: no faster than a division.
  return hn::Div(hn::Set(d, 1.0f), x);
#endif
}

/// 1 / sqrt(x) for x in [2^-125, 2^125]: 2 ULP.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V ReciprocalSqrt(D d, V x) {
#if HWY_TARGET == HWY_AVX3
  const V estimate = hn::ApproximateReciprocalSqrt(x);
  const V half = hn::Set(d, 0.5f);
  const V residual = hn::NegMulAdd(hn::Mul(x, estimate), hn::Mul(estimate, half), half);
  return hn::MulAdd(residual, estimate, estimate);
#else
  return hn::Div(hn::Set(d, 1.0f), hn::Sqrt(x));
#endif
}

/// atan(t) in degrees for |t| <= 1: 4 ULP.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V AtanDegrees(D d, V t) {
  // atan(t) / t in degrees as a polynomial of t^2, relative error 1.6e-8. Estrin's scheme: this is
  // on the longest chain of the air data.
  const V t2 = hn::Mul(t, t);
  const V t4 = hn::Mul(t2, t2);
  const V t8 = hn::Mul(t4, t4);
  const V c01 = hn::MulAdd(hn::Set(d, -19.098444f), t2, hn::Set(d, 57.2957802f));
  const V c23 = hn::MulAdd(hn::Set(d, -8.13809013f), t2, hn::Set(d, 11.4549274f));
  const V c45 = hn::MulAdd(hn::Set(d, -4.29965925f), t2, hn::Set(d, 6.09681273f));
  const V c67 = hn::MulAdd(hn::Set(d, -0.920676291f), t2, hn::Set(d, 2.44606256f));
  const V low = hn::MulAdd(c23, t4, c01);
  const V high = hn::MulAdd(c67, t4, c45);
  const V top = hn::Mul(hn::Set(d, 0.163289547f), hn::Mul(t8, t8));
  return hn::Mul(t, hn::Add(hn::MulAdd(high, t8, low), top));
}

/// atan2(y, x) in degrees, [-180, 180], for magnitudes below 2^125; arguments are taken as zero
/// where both are below 2^-100: absolute error 3e-5 degrees, relative error 5 ULP where |y| <= x.
/// The sign is that of y, also of a zero y: -180 where y = -0 and x < 0; x = -0 counts as +0. NaN
/// may give any angle.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Atan2Degrees(D d, V y, V x) {
  const V abs_x = hn::Abs(x);
  const V abs_y = hn::Abs(y);
  const V larger = hn::Max(hn::Max(abs_x, abs_y), hn::Set(d, 0x1p-100f));
  V angle = AtanDegrees(d, hn::Mul(hn::Min(abs_x, abs_y), Reciprocal(d, larger)));
  angle = hn::IfThenElse(hn::Gt(abs_y, abs_x), hn::Sub(hn::Set(d, 90.0f), angle), angle);
  angle = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(hn::Set(d, 180.0f), angle), angle);
  return hn::CopySign(angle, y);
}

/// atan2(y, x) in radians; range and properties of Atan2Degrees, absolute error 5e-7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Atan2(D d, V y, V x) {
  return hn::Mul(Atan2Degrees(d, y, x), hn::Set(d, 0.0174532925f));
}

/// Sine and cosine of |r| <= pi/4: absolute error 1.2e-7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SinCosInQuadrant(D d, V r, V& sine, V& cosine) {
  const V r2 = hn::Mul(r, r);
  sine = hn::MulAdd(hn::Mul(r, r2),
                    Polynomial(d, r2, {-0.166666552f, 0.008332178f, -0.000195172979f}), r);
  cosine = hn::MulAdd(hn::Mul(r2, r2),
                      Polynomial(d, r2, {0.0416666456f, -0.00138873677f, 2.44384646e-05f}),
                      hn::NegMulAdd(hn::Set(d, 0.5f), r2, hn::Set(d, 1.0f)));
}

/// Sine and cosine of an angle given by 32 bits: the upper two are its quadrant, the others a
/// signed fraction of it: pi/2 (bits >> 30) + pi/4 int32(bits << 2) / 2^31 radians. A bijection of
/// the integers to angles all around: uniform bits give a uniform angle. Absolute error 1.2e-7.
template <class D, class VU = hn::Vec<hn::RebindToUnsigned<D>>, class V = hn::Vec<D>>
HWY_INLINE void SinCosOfBits(D d, VU bits, V& sine, V& cosine) {
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const V r = hn::Mul(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftLeft<2>(bits))),
                      hn::Set(d, 0.785398163f * 0x1.0p-31f));
  V s, c;
  SinCosInQuadrant(d, r, s, c);
  const auto turned = hn::ShiftLeft<1>(bits);  // bit 30, whether the quadrant is odd, as the sign
  const auto sign = hn::Set(du, 0x80000000u);
  const auto is_odd = hn::RebindMask(d, hn::Lt(hn::BitCast(di, turned), hn::Zero(di)));
  sine = hn::Xor(hn::IfThenElse(is_odd, c, s), hn::BitCast(d, hn::And(bits, sign)));
  cosine =
      hn::Xor(hn::IfThenElse(is_odd, s, c), hn::BitCast(d, hn::And(hn::Xor(bits, turned), sign)));
}

/// Sine and cosine of x radians, |x| <= 1000: absolute error 2e-7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SinCos(D d, V x, V& sine, V& cosine) {
  const hn::RebindToSigned<D> di;
  const V quarter_turns = hn::Round(hn::Mul(x, hn::Set(d, 0.636619772f)));
  // pi/2 in three parts, of which the first two times a small integer are exact.
  V r = hn::NegMulAdd(quarter_turns, hn::Set(d, 1.5703125f), x);
  r = hn::NegMulAdd(quarter_turns, hn::Set(d, 4.83751297e-4f), r);
  r = hn::NegMulAdd(quarter_turns, hn::Set(d, 7.54978995e-8f), r);
  V s, c;
  SinCosInQuadrant(d, r, s, c);
  const auto quadrant = TruncateToInt(d, quarter_turns);
  const auto one = hn::Set(di, 1);
  const auto is_odd = hn::RebindMask(d, hn::Eq(hn::And(quadrant, one), one));
  const auto sine_sign = hn::ShiftLeft<30>(hn::AndNot(one, quadrant));
  const auto cosine_sign = hn::ShiftLeft<30>(hn::AndNot(one, hn::Add(quadrant, one)));
  sine = hn::Xor(hn::IfThenElse(is_odd, c, s), hn::BitCast(d, sine_sign));
  cosine = hn::Xor(hn::IfThenElse(is_odd, s, c), hn::BitCast(d, cosine_sign));
}

/// e^x: 2 ULP for x in [-87, 88]; x is limited to that range.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp(D d, V x) {
  const hn::RebindToSigned<D> di;
  // Not Min and Max: they swallow a NaN.
  x = hn::IfThenElse(hn::Gt(x, hn::Set(d, 88.0f)), hn::Set(d, 88.0f), x);
  x = hn::IfThenElse(hn::Lt(x, hn::Set(d, -87.0f)), hn::Set(d, -87.0f), x);
  const V n = hn::Round(hn::Mul(x, hn::Set(d, 1.44269504f)));
  V r = hn::NegMulAdd(n, hn::Set(d, 0.693359375f), x);
  r = hn::NegMulAdd(n, hn::Set(d, -2.12194440e-4f), r);
  const V p = hn::MulAdd(
      hn::Mul(r, r),
      Polynomial(d, r, {0.5f, 0.166665196f, 0.041666206f, 0.00836888235f, 0.00139505777f}), r);
  const V scale = hn::BitCast(d, hn::ShiftLeft<23>(hn::Add(TruncateToInt(d, n), hn::Set(di, 127))));
  return hn::MulAdd(p, scale, scale);
}

/// Natural logarithm of a positive normal x: 2 ULP. NaN gives an unspecified finite value.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Log(D d, V x) {
  const hn::RebindToSigned<D> di;
  // x = m 2^e with m in [sqrt(1/2), sqrt(2)): subtracting the bits of sqrt(1/2) leaves e on top.
  constexpr std::int32_t kSqrtHalfBits = 0x3f3504f3;
  const auto bits = hn::BitCast(di, x);
  const auto e = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, kSqrtHalfBits)));
  const V m = hn::Sub(hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(e))), hn::Set(d, 1.0f));
  const V ef = hn::ConvertTo(d, e);
  const V m2 = hn::Mul(m, m);
  V y = hn::Mul(hn::Mul(m, m2),
                Polynomial(d, m,
                           {0.333333135f, -0.250000089f, 0.200021192f, -0.166679963f, 0.142195538f,
                            -0.1240559f, 0.118881531f, -0.116756313f, 0.067466259f}));
  y = hn::MulAdd(ef, hn::Set(d, -2.12194440e-4f), y);
  y = hn::NegMulAdd(hn::Set(d, 0.5f), m2, y);
  return hn::MulAdd(ef, hn::Set(d, 0.693359375f), hn::Add(m, y));
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_SIMD_MATH_INL_H_
