// SPDX-License-Identifier: Apache-2.0
// The filters of Dryden's linear gusts (envs/wind/dryden.h) on vectors of aircraft, for kernels
// (see simd/dispatch.h).

#if defined(SKEIN_ENVS_WIND_GUST_FILTERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_WIND_GUST_FILTERS_INL_H_
#undef SKEIN_ENVS_WIND_GUST_FILTERS_INL_H_
#else
#define SKEIN_ENVS_WIND_GUST_FILTERS_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/wind/dryden_constants.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// The exact response over one step to white noise, of x1 and x2 and of the forward gust:
///   x1 becomes decay x1 + first n1
///   x2 becomes decay x2 + lag x1 + along n1 + second n2
///   the forward gust u becomes decay u + forward n1
struct Response {
  V way;  ///< the step as a fraction of L / V, limited
  V decay, lag, first, along, second, forward;
};

/// `way` is the step as a fraction of L / V. With x = 2 way, the covariances are the incomplete
/// gamma functions 1 - e^-x (1 + x + ... ), which cancel to nothing at small x: here they come from
/// their series, which serves to x = 2.
HWY_INLINE Response ResponseTo(V way) {
  const FloatTag d;
  way = ClampTo(d, way, 1e-6f, 1.0f);
  const V x = hn::Add(way, way);
  // r3 = (e^x - 1 - x - x^2/2) / x^3, and likewise r2 and r1.
  const V r3 = Polynomial(
      d, x,
      {0.166666667f, 0.0416666667f, 0.00833333333f, 0.00138888889f, 0.000198412698f,
       2.48015873e-05f, 2.75573192e-06f, 2.75573192e-07f, 2.50521084e-08f, 2.08767570e-09f});
  const V r2 = hn::MulAdd(x, r3, Constant(0.5));
  const V r1 = hn::MulAdd(x, r2, Constant(1));
  const V decay_squared = hn::Div(Constant(1), hn::MulAdd(x, r1, Constant(1)));
  const V scale = hn::Mul(decay_squared, x);
  Response response;
  response.way = way;
  response.decay = hn::Sqrt(decay_squared);
  response.lag = hn::Mul(response.decay, way);
  response.forward = hn::Sqrt(hn::Mul(scale, r1));
  response.first = hn::Mul(response.forward, Constant(dryden::kFirstDeviation));
  response.along = hn::Div(hn::Mul(hn::Mul(scale, x), hn::Mul(r2, Constant(0.25))), response.first);
  const V rest =
      hn::NegMulAdd(Constant(0.125), hn::Div(hn::Mul(r2, r2), r1), hn::Mul(Constant(0.25), r3));
  response.second = hn::Sqrt(hn::Mul(hn::Mul(scale, hn::Mul(x, x)), rest));
  return response;
}

/// Moves a transverse gust's two states on. Returns the gust, of unit variance.
HWY_INLINE V AdvanceTransverse(const Response& response, float* first, float* lagged, V n1, V n2) {
  const FloatTag d;
  const V x1 = hn::LoadU(d, first), x2 = hn::LoadU(d, lagged);
  const V next1 = hn::MulAdd(response.decay, x1, hn::Mul(response.first, n1));
  const V noise = hn::MulAdd(response.along, n1, hn::Mul(response.second, n2));
  const V next2 = hn::MulAdd(response.decay, x2, hn::MulAdd(response.lag, x1, noise));
  hn::StoreU(next1, d, first);
  hn::StoreU(next2, d, lagged);
  return hn::MulAdd(Constant(dryden::kFirst), next1, hn::Mul(Constant(dryden::kSecond), next2));
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_WIND_GUST_FILTERS_INL_H_
