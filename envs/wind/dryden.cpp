// SPDX-License-Identifier: Apache-2.0
#include "envs/wind/dryden.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "envs/state/attitude.h"
#include "envs/wind/dryden_constants.h"
#include "simd/dispatch.h"
#include "simd/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/wind/dryden.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/state/air_velocity-inl.h"
#include "simd/math-inl.h"
#include "simd/random-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// DrydenScalesAt.
struct Scales {
  V horizontal, vertical, ratio;
};

HWY_INLINE Scales ScalesAt(V altitude_ft) {
  const FloatTag d;
  const V low = ClampTo(d, altitude_ft, static_cast<float>(dryden::kLowestFt),
                        static_cast<float>(dryden::kLowFt));
  const V over = hn::Sub(ClampTo(d, altitude_ft, static_cast<float>(dryden::kLowFt),
                                 static_cast<float>(dryden::kHighFt)),
                         Constant(dryden::kLowFt));
  const V base = hn::MulAdd(low, Constant(dryden::kRatioSlopePerFt), Constant(dryden::kRatioBase));
  Scales scales;
  scales.ratio = Exp(d, hn::Mul(Constant(dryden::kRatioExponent), Log(d, base)));
  scales.vertical = hn::MulAdd(over, Constant(dryden::kScaleSlope), low);
  const V cube = hn::Mul(scales.ratio, hn::Mul(scales.ratio, scales.ratio));
  scales.horizontal = hn::MulAdd(over, Constant(dryden::kScaleSlope), hn::Mul(low, cube));
  return scales;
}

/// The exact response over one step to white noise, of x1 and x2 and of the forward gust:
///   x1 becomes decay x1 + first n1
///   x2 becomes decay x2 + lag x1 + along n1 + second n2
///   the forward gust u becomes decay u + forward n1
struct Response {
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

/// Standard deviation of the vertical gust.
HWY_INLINE V DeviationAt(Tile tile, int first, TurbulenceLaw law) {
  const FloatTag d;
  const float* drawn = tile[kTurbulenceStdDev] + first;
  if (law == TurbulenceLaw::kUniform) return hn::LoadU(d, drawn);
  float deviation[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    deviation[lane] = static_cast<float>(TurbulenceAt(drawn[lane], -tile[kDown][first + lane]));
  }
  return hn::LoadU(d, deviation);
}

void AdvanceGustsKernel(Tile tile, float dt, const GustKeys& keys, TurbulenceLaw law) {
  const FloatTag d;
  const IntTag di;
  const UintTag du;
  const PhiloxKeys philox(keys.seed);
  for (int first = 0; first < tile.count; first += kLanes) {
    const auto get = [&](int column) HWY_ATTR { return hn::LoadU(d, tile[column] + first); };
    const auto aircraft = hn::Iota(du, keys.first_aircraft + static_cast<std::uint32_t>(first));
    const auto episode = hn::BitCast(du, hn::LoadU(di, keys.episode + first));
    const auto step = hn::BitCast(du, hn::LoadU(di, keys.step + first));
    V normals[8];
    CoarseNormals<1>(d, philox, aircraft, episode, step, simd::RandomPurpose::kGust, normals);

    const BodyVelocity<V> velocity = AirVelocity(d, tile, first);
    const V speed =
        hn::Sqrt(hn::MulAdd(velocity.u, velocity.u,
                            hn::MulAdd(velocity.v, velocity.v, hn::Mul(velocity.w, velocity.w))));
    const V way = hn::Mul(speed, hn::Set(d, dt));
    const Scales scales = ScalesAt(hn::Neg(get(kDown)));
    const Response horizontal = ResponseTo(hn::Div(way, scales.horizontal));
    const Response vertical = ResponseTo(hn::Div(way, scales.vertical));

    const V forward =
        hn::MulAdd(horizontal.decay, get(kGustForward), hn::Mul(horizontal.forward, normals[0]));
    hn::StoreU(forward, d, tile[kGustForward] + first);
    const V right = AdvanceTransverse(horizontal, tile[kGustRight] + first,
                                      tile[kGustRightLagged] + first, normals[1], normals[2]);
    const V down = AdvanceTransverse(vertical, tile[kGustDown] + first,
                                     tile[kGustDownLagged] + first, normals[3], normals[4]);

    const V deviation = DeviationAt(tile, first, law);
    const V down_fps = hn::Mul(deviation, down);
    const V horizontal_fps = hn::Mul(deviation, scales.ratio);
    const V forward_fps = hn::Mul(horizontal_fps, forward);
    const V right_fps = hn::Mul(horizontal_fps, right);
    const AttitudeMatrix<V> t = AttitudeMatrixOf(get(kQ0), get(kQx), get(kQy), get(kQz));
    const auto put = [&](int column, V steady, V along_x, V along_y, V along_z) HWY_ATTR {
      const V wind =
          hn::MulAdd(along_x, forward_fps,
                     hn::MulAdd(along_y, right_fps, hn::MulAdd(along_z, down_fps, steady)));
      hn::StoreU(wind, d, tile[column] + first);
    };
    put(kWindNorth, get(kSteadyWindNorth), t.t11, t.t21, t.t31);
    put(kWindEast, get(kSteadyWindEast), t.t12, t.t22, t.t32);
    put(kWindDown, hn::Zero(d), t.t13, t.t23, t.t33);
    UpdateAirVelocity(d, tile, first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(AdvanceGustsKernel);

DrydenScales DrydenScalesAt(double altitude_ft) {
  const double low = std::clamp(altitude_ft, dryden::kLowestFt, dryden::kLowFt);
  const double over = std::clamp(altitude_ft, dryden::kLowFt, dryden::kHighFt) - dryden::kLowFt;
  DrydenScales scales;
  scales.horizontal_ratio =
      std::pow(dryden::kRatioBase + dryden::kRatioSlopePerFt * low, dryden::kRatioExponent);
  scales.horizontal_ft = low * std::pow(scales.horizontal_ratio, 3) + dryden::kScaleSlope * over;
  scales.vertical_ft = low + dryden::kScaleSlope * over;
  return scales;
}

double TurbulenceAt(double at_20000_ft, double altitude_ft) {
  const auto* above = std::upper_bound(
      std::begin(dryden::kTurbulenceByAltitude) + 1, std::end(dryden::kTurbulenceByAltitude) - 1,
      altitude_ft, [](double altitude, const auto& row) { return altitude < row.altitude_ft; });
  const dryden::TurbulenceRow &low = above[-1], &high = *above;
  const double fraction =
      std::clamp((altitude_ft - low.altitude_ft) / (high.altitude_ft - low.altitude_ft), 0.0, 1.0);
  // By severity, from calm on: here, and at 20,000 ft.
  double here[] = {0, low.light, low.moderate, low.severe};
  const double there[] = {0, high.light, high.moderate, high.severe};
  for (int i = 0; i < 4; ++i) here[i] += fraction * (there[i] - here[i]);
  int i = 0;
  while (i < 2 && at_20000_ft > kTurbulenceSeverities[i + 1].standard_deviation_fps) ++i;
  const double from = kTurbulenceSeverities[i].standard_deviation_fps;
  const double to = kTurbulenceSeverities[i + 1].standard_deviation_fps;
  if (at_20000_ft > to) return here[3] * at_20000_ft / to;
  return here[i] + (here[i + 1] - here[i]) * (at_20000_ft - from) / (to - from);
}

void StartGusts(Tile tile, int index, const GustKeys& keys, TurbulenceLaw law) {
  float normals[5];
  const auto episode = static_cast<std::uint32_t>(keys.episode[index]);
  const std::uint32_t start = 0;
  simd::FillNormals(keys.seed, keys.first_aircraft + static_cast<std::uint32_t>(index), &episode,
                    &start, simd::RandomPurpose::kGustStart, 1, 5, normals);
  const auto set = [&](int column, double value) {
    tile[column][index] = static_cast<float>(value);
  };
  // A transverse gust from two independent deviates, by the covariance of its states.
  const auto start_transverse = [&](int first, int lagged, double n1, double n2) {
    const double along = dryden::kCovariance / dryden::kFirstDeviation;
    const double x1 = dryden::kFirstDeviation * n1;
    const double x2 = along * n1 + std::sqrt(dryden::kSecondVariance - along * along) * n2;
    set(first, x1);
    set(lagged, x2);
    return dryden::kFirst * x1 + dryden::kSecond * x2;
  };
  set(kGustForward, normals[0]);
  Eigen::Vector3d gust;
  gust << normals[0], start_transverse(kGustRight, kGustRightLagged, normals[1], normals[2]),
      start_transverse(kGustDown, kGustDownLagged, normals[3], normals[4]);

  const auto get = [&](int column) { return static_cast<double>(tile[column][index]); };
  gust.head<2>() *= DrydenScalesAt(-get(kDown)).horizontal_ratio;
  const double drawn = get(kTurbulenceStdDev);
  const double deviation =
      law == TurbulenceLaw::kUniform ? drawn : TurbulenceAt(drawn, -get(kDown));
  const Eigen::Vector4d attitude(get(kQ0), get(kQx), get(kQy), get(kQz));
  const Eigen::Vector3d wind = Eigen::Vector3d(get(kSteadyWindNorth), get(kSteadyWindEast), 0) +
                               deviation * (BodyFromNed(attitude).transpose() * gust);
  for (int k = 0; k < 3; ++k) set(kWindNorth + k, wind[k]);
}

void AdvanceGusts(Tile tile, float dt, const GustKeys& keys, TurbulenceLaw law) {
  SKEIN_DISPATCH(AdvanceGustsKernel)(tile, dt, keys, law);
}

}  // namespace skein
#endif
