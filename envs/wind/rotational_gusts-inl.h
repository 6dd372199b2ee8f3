// SPDX-License-Identifier: Apache-2.0
// Dryden's rotational gusts (envs/wind/dryden.h) on vectors of aircraft, for kernels (see
// simd/dispatch.h).

#if defined(SKEIN_ENVS_WIND_ROTATIONAL_GUSTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_WIND_ROTATIONAL_GUSTS_INL_H_
#undef SKEIN_ENVS_WIND_ROTATIONAL_GUSTS_INL_H_
#else
#define SKEIN_ENVS_WIND_ROTATIONAL_GUSTS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <iterator>

#include "envs/state/state.h"
#include "envs/wind/dryden_constants.h"
#include "envs/wind/gust_filters-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// sinh(x) / x of x^2 = `square`, for squares up to 4: relative error 1e-7.
HWY_INLINE V SinhRatio(V square) {
  return Polynomial(FloatTag(), square,
                    {1.0f, 0.166666667f, 0.00833333333f, 0.000198412698f, 2.75573192e-06f,
                     2.50521084e-08f, 1.60590438e-10f});
}

/// (cosh(x) - sinh(x) / x) / x^2 likewise.
HWY_INLINE V CoshRatio(V square) {
  return Polynomial(FloatTag(), square,
                    {0.333333333f, 0.0333333333f, 0.00119047619f, 2.20458554e-05f, 2.50521084e-07f,
                     1.92708526e-09f, 1.07060292e-11f});
}

/// A transverse gust, smoothed: z lags the gust w by the time in which the aircraft flies a length
/// l. Over a step of `way` scales and `wing_way` lengths, times being in steps, a the first and m
/// the second, an impulse of the white noise that moves x1 by 1 has moved z after the time s by
///   G(s) = m e^(-m s) integral from 0 to s of e^(m t) e^(-a t) (kFirst + kSecond a t) dt,
/// which a = m leaves finite: with h = (m + a) / 2 and x = (m - a) s / 2 it is
///   m s e^(-h s) (kFirst S + kSecond a s / 2 (S + x U)),
/// S and U being SinhRatio and CoshRatio of x^2.
class Smoothing {
 public:
  HWY_INLINE Smoothing(V way, V wing_way)
      : way_(way), wing_way_(wing_way), half_sum_(hn::Mul(Constant(0.5), hn::Add(wing_way, way))) {}

  /// G(s).
  HWY_INLINE V ImpulseResponse(V s) const {
    const V x = hn::Mul(hn::Mul(Constant(0.5), s), hn::Sub(wing_way_, way_));
    const V square = hn::Mul(x, x);
    const V sinh_ratio = SinhRatio(square);
    const V lagged = hn::Mul(hn::Mul(Constant(0.5 * dryden::kSecond), hn::Mul(way_, s)),
                             hn::MulAdd(x, CoshRatio(square), sinh_ratio));
    return hn::Mul(hn::Mul(hn::Mul(wing_way_, s), Decay(s)),
                   hn::MulAdd(Constant(dryden::kFirst), sinh_ratio, lagged));
  }

  /// What a unit of x2 at the start of a step adds to z at its end.
  HWY_INLINE V LaggedResponse() const {
    const V x = hn::Mul(Constant(0.5), hn::Sub(wing_way_, way_));
    return hn::Mul(hn::Mul(Constant(dryden::kSecond), wing_way_),
                   hn::Mul(Decay(Constant(1)), SinhRatio(hn::Mul(x, x))));
  }

 private:
  /// e^(-h s)
  HWY_INLINE V Decay(V s) const { return Exp(FloatTag(), hn::Neg(hn::Mul(half_sum_, s))); }

  V way_, wing_way_, half_sum_;
};

/// z's part of the noise of a step, by the deviates of x1 and x2 and one of its own.
struct SmoothedNoise {
  V by_first, by_second, own;
};

/// By Gauss and Legendre's rule over the time s since an impulse. In the deviates' terms the
/// impulse responses of x1 and x2 are orthonormal; `own` is what is left of z's: the rule keeps it
/// from cancelling.
HWY_INLINE SmoothedNoise NoiseOf(const Smoothing& smoothing, const Response& response) {
  const FloatTag d;
  constexpr float kTimes[] = {0.0469100770f, 0.230765345f, 0.5f, 0.769234655f, 0.953089923f};
  constexpr float kWeights[] = {0.118463443f, 0.239314335f, 0.284444444f, 0.239314335f,
                                0.118463443f};
  constexpr int kCount = std::size(kTimes);
  // x1's response is sqrt(way) e^(-way s), x2's way (s - mean_time) times that, less its part of
  // x1's.
  const V root = hn::Sqrt(response.way);
  const V first_scale = hn::Div(root, response.first);
  const V second_scale = hn::Div(hn::Mul(root, response.way), response.second);
  const V mean_time = hn::Div(response.along, hn::Mul(response.way, response.first));
  V smoothed[kCount], first[kCount], second[kCount];
  SmoothedNoise noise{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (int i = 0; i < kCount; ++i) {
    const V s = Constant(kTimes[i]), weight = Constant(kWeights[i]);
    smoothed[i] = hn::Mul(root, smoothing.ImpulseResponse(s));
    const V decay = Exp(d, hn::Neg(hn::Mul(response.way, s)));
    first[i] = hn::Mul(first_scale, decay);
    second[i] = hn::Mul(second_scale, hn::Mul(decay, hn::Sub(s, mean_time)));
    const V weighted = hn::Mul(weight, smoothed[i]);
    noise.by_first = hn::MulAdd(weighted, first[i], noise.by_first);
    noise.by_second = hn::MulAdd(weighted, second[i], noise.by_second);
  }
  for (int i = 0; i < kCount; ++i) {
    const V rest = hn::NegMulAdd(noise.by_first, first[i],
                                 hn::NegMulAdd(noise.by_second, second[i], smoothed[i]));
    noise.own = hn::MulAdd(Constant(kWeights[i]), hn::Mul(rest, rest), noise.own);
  }
  noise.own = hn::Sqrt(noise.own);
  return noise;
}

/// The linear gusts that rotational ones belong to.
struct LinearGusts {
  V right, down;                      ///< of unit variance
  V right_deviation, down_deviation;  ///< ft/s
  V vertical_scale;                   ///< ft
};

/// The rotational gusts of the aircraft of one vector, over one step.
class RotationalGusts {
 public:
  /// `way` through the air, ft.
  HWY_INLINE RotationalGusts(V way, double span_ft)
      : roll_length_(LengthOf(way, dryden::kRollLengthPerSpan * span_ft)),
        yaw_length_(LengthOf(way, dryden::kYawLengthPerSpan * span_ft)),
        roll_way_(WayOf(way, roll_length_)),
        yaw_way_(WayOf(way, yaw_length_)) {}

  /// Moves the states on, before those of the linear gusts. `normals` are the step's: the first
  /// five are the linear gusts'.
  HWY_INLINE void Advance(const Tile& tile, int first, const Response& horizontal,
                          const Response& vertical, const V (&normals)[8]) const {
    AdvanceRoll(tile[kGustRollState] + first, normals[5]);
    AdvanceSmoothed(yaw_way_, horizontal, tile, first, {kGustRight, kGustRightSmoothed},
                    {normals[1], normals[2], normals[7]});
    AdvanceSmoothed(roll_way_, vertical, tile, first, {kGustDown, kGustDownSmoothed},
                    {normals[3], normals[4], normals[6]});
  }

  /// Writes the rates, after the linear gusts have moved on.
  HWY_INLINE void PutRates(const Tile& tile, int first, const LinearGusts& gusts) const {
    const FloatTag d;
    const auto get = [&](int column) HWY_ATTR { return hn::LoadU(d, tile[column] + first); };
    const auto put = [&](int column, V rate)
                         HWY_ATTR { hn::StoreU(rate, d, tile[column] + first); };
    const V logarithm = hn::MulAdd(Constant(2), Log(d, roll_length_), Log(d, gusts.vertical_scale));
    const V strength =
        hn::Mul(Constant(dryden::kRollStrength), Exp(d, hn::Mul(Constant(-1.0 / 3), logarithm)));
    put(kGustRollRate, hn::Mul(hn::Mul(gusts.down_deviation, strength), get(kGustRollState)));
    put(kGustPitchRate, hn::Mul(hn::Div(gusts.down_deviation, roll_length_),
                                hn::Sub(get(kGustDownSmoothed), gusts.down)));
    put(kGustYawRate, hn::Mul(hn::Div(gusts.right_deviation, yaw_length_),
                              hn::Sub(gusts.right, get(kGustRightSmoothed))));
  }

 private:
  /// The filters' series serve to as many lengths in a step.
  static constexpr float kMostLengths = 4, kFewestLengths = 1e-6f;

  struct Columns {
    int gust;  ///< x1; x2 follows
    int smoothed;
  };
  struct Deviates {
    V first, second, own;
  };

  static HWY_INLINE V LengthOf(V way, double length_ft) {
    return hn::Max(Constant(length_ft), hn::Mul(way, Constant(1 / kMostLengths)));
  }
  static HWY_INLINE V WayOf(V way, V length) {
    return ClampTo(FloatTag(), hn::Div(way, length), kFewestLengths, kMostLengths);
  }

  /// The first-order filter of the roll rate: 1 - e^(-2 m) is (1 + e^-m) m e^(-m / 2) S(m / 2).
  HWY_INLINE void AdvanceRoll(float* state, V normal) const {
    const FloatTag d;
    const V half = hn::Mul(Constant(0.5), roll_way_);
    const V half_decay = Exp(d, hn::Neg(half));
    const V decay = hn::Mul(half_decay, half_decay);
    const V loss = hn::Mul(hn::Mul(roll_way_, half_decay), SinhRatio(hn::Mul(half, half)));
    const V noise = hn::Sqrt(hn::MulAdd(decay, loss, loss));
    hn::StoreU(hn::MulAdd(decay, hn::LoadU(d, state), hn::Mul(noise, normal)), d, state);
  }

  static HWY_INLINE void AdvanceSmoothed(V wing_way, const Response& response, const Tile& tile,
                                         int first, const Columns& columns,
                                         const Deviates& normals) {
    const FloatTag d;
    const auto get = [&](int column) HWY_ATTR { return hn::LoadU(d, tile[column] + first); };
    const Smoothing smoothing(response.way, wing_way);
    const SmoothedNoise noise = NoiseOf(smoothing, response);
    V next = hn::Mul(Exp(d, hn::Neg(wing_way)), get(columns.smoothed));
    next = hn::MulAdd(smoothing.ImpulseResponse(Constant(1)), get(columns.gust), next);
    next = hn::MulAdd(smoothing.LaggedResponse(), get(columns.gust + 1), next);
    next = hn::MulAdd(noise.by_first, normals.first, next);
    next = hn::MulAdd(noise.by_second, normals.second, next);
    next = hn::MulAdd(noise.own, normals.own, next);
    hn::StoreU(next, d, tile[columns.smoothed] + first);
  }

  V roll_length_, yaw_length_;  ///< ft; pitch has that of roll
  V roll_way_, yaw_way_;        ///< of the step, in lengths
};

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_WIND_ROTATIONAL_GUSTS_INL_H_
