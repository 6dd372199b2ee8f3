// SPDX-License-Identifier: Apache-2.0
#include "envs/wind/dryden.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
#include "envs/wind/gust_filters-inl.h"
#include "envs/wind/rotational_gusts-inl.h"
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

void AdvanceGustsKernel(Tile tile, float dt, const GustKeys& keys, const Turbulence& turbulence) {
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
    if (tile.rotational_gusts) {
      RotationalGusts(way, turbulence.span_ft).Advance(tile, first, horizontal, vertical, normals);
    }

    const V forward =
        hn::MulAdd(horizontal.decay, get(kGustForward), hn::Mul(horizontal.forward, normals[0]));
    hn::StoreU(forward, d, tile[kGustForward] + first);
    const V right = AdvanceTransverse(horizontal, tile[kGustRight] + first,
                                      tile[kGustRightLagged] + first, normals[1], normals[2]);
    const V down = AdvanceTransverse(vertical, tile[kGustDown] + first,
                                     tile[kGustDownLagged] + first, normals[3], normals[4]);

    const V deviation = DeviationAt(tile, first, turbulence.law);
    const V down_fps = hn::Mul(deviation, down);
    const V horizontal_fps = hn::Mul(deviation, scales.ratio);
    const V forward_fps = hn::Mul(horizontal_fps, forward);
    const V right_fps = hn::Mul(horizontal_fps, right);
    if (tile.rotational_gusts) {
      RotationalGusts(way, turbulence.span_ft)
          .PutRates(tile, first, {right, down, horizontal_fps, deviation, scales.vertical});
    }
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

namespace {

/// Of calm air, light, moderate and severe turbulence at an altitude, ft/s.
std::array<double, 4> DeviationsAt(double altitude_ft) {
  const auto* above = std::upper_bound(
      std::begin(dryden::kTurbulenceByAltitude) + 1, std::end(dryden::kTurbulenceByAltitude) - 1,
      altitude_ft, [](double altitude, const auto& row) { return altitude < row.altitude_ft; });
  const dryden::TurbulenceRow &low = above[-1], &high = *above;
  const double fraction =
      std::clamp((altitude_ft - low.altitude_ft) / (high.altitude_ft - low.altitude_ft), 0.0, 1.0);
  std::array<double, 4> deviations = {0, low.light, low.moderate, low.severe};
  const std::array<double, 4> higher = {0, high.light, high.moderate, high.severe};
  for (std::size_t i = 0; i < 4; ++i) deviations[i] += fraction * (higher[i] - deviations[i]);
  return deviations;
}

}  // namespace

double TurbulenceAt(double at_20000_ft, double altitude_ft) {
  static const std::array<double, 4> there = DeviationsAt(20000);
  const std::array<double, 4> here = DeviationsAt(altitude_ft);
  if (at_20000_ft > there[3]) return here[3] * at_20000_ft / there[3];
  std::size_t i = 0;
  while (at_20000_ft > there[i + 1]) ++i;
  return here[i] + (here[i + 1] - here[i]) * (at_20000_ft - there[i]) / (there[i + 1] - there[i]);
}

namespace {

/// The states of a transverse gust from two independent deviates, by their covariance.
struct TransverseStart {
  double first, lagged;

  TransverseStart(double n1, double n2)
      : first(dryden::kFirstDeviation * n1), lagged(kAlong * n1 + Rest() * n2) {}
  double gust() const { return dryden::kFirst * first + dryden::kSecond * lagged; }

  static constexpr double kAlong = dryden::kCovariance / dryden::kFirstDeviation;
  static double Rest() { return std::sqrt(dryden::kSecondVariance - kAlong * kAlong); }
};

/// The gust smoothed over `length` scales, from the same two deviates and a third: its covariances
/// are those of the stationary filter.
double SmoothedStart(double length, double n1, double n2, double n3) {
  const double share = 1 / (1 + length);
  const double with_first = share * dryden::kGustWithFirst;
  const double with_second = share * (length * with_first + dryden::kGustWithSecond);
  const double variance = dryden::kFirst * with_first + dryden::kSecond * with_second;
  const double along1 = with_first / dryden::kFirstDeviation;
  const double along2 = (with_second - TransverseStart::kAlong * along1) / TransverseStart::Rest();
  const double rest = std::max(0.0, variance - along1 * along1 - along2 * along2);
  return along1 * n1 + along2 * n2 + std::sqrt(rest) * n3;
}

/// What StartGusts has drawn of an aircraft's linear gusts.
struct StartedGusts {
  const float* normals;
  double right, down;
  DrydenScales scales;
  double deviation;
};

void StartRotationalGusts(Tile tile, int index, const StartedGusts& gusts, double span_ft) {
  const double roll_ft = dryden::kRollLengthPerSpan * span_ft;
  const double yaw_ft = dryden::kYawLengthPerSpan * span_ft;
  const float* const n = gusts.normals;
  const double right = SmoothedStart(yaw_ft / gusts.scales.horizontal_ft, n[1], n[2], n[7]);
  const double down = SmoothedStart(roll_ft / gusts.scales.vertical_ft, n[3], n[4], n[6]);
  const double roll_deviation = dryden::kRollStrength * gusts.deviation /
                                std::cbrt(gusts.scales.vertical_ft * roll_ft * roll_ft);
  const auto set = [&](int column, double value) {
    tile[column][index] = static_cast<float>(value);
  };
  set(kGustRollState, n[5]);
  set(kGustRightSmoothed, right);
  set(kGustDownSmoothed, down);
  set(kGustRollRate, roll_deviation * n[5]);
  set(kGustPitchRate, gusts.deviation * (down - gusts.down) / roll_ft);
  set(kGustYawRate,
      gusts.deviation * gusts.scales.horizontal_ratio * (gusts.right - right) / yaw_ft);
}

}  // namespace

void StartGusts(Tile tile, int index, const GustKeys& keys, const Turbulence& turbulence) {
  float normals[8];
  const auto episode = static_cast<std::uint32_t>(keys.episode[index]);
  const std::uint32_t start = 0;
  simd::FillNormals(keys.seed, keys.first_aircraft + static_cast<std::uint32_t>(index), &episode,
                    &start, simd::RandomPurpose::kGustStart, 1, 8, normals);
  const auto set = [&](int column, double value) {
    tile[column][index] = static_cast<float>(value);
  };
  const TransverseStart right(normals[1], normals[2]), down(normals[3], normals[4]);
  set(kGustForward, normals[0]);
  set(kGustRight, right.first);
  set(kGustRightLagged, right.lagged);
  set(kGustDown, down.first);
  set(kGustDownLagged, down.lagged);

  const auto get = [&](int column) { return static_cast<double>(tile[column][index]); };
  const DrydenScales scales = DrydenScalesAt(-get(kDown));
  Eigen::Vector3d gust(normals[0], right.gust(), down.gust());
  gust.head<2>() *= scales.horizontal_ratio;
  const double drawn = get(kTurbulenceStdDev);
  const double deviation =
      turbulence.law == TurbulenceLaw::kUniform ? drawn : TurbulenceAt(drawn, -get(kDown));
  const Eigen::Vector4d attitude(get(kQ0), get(kQx), get(kQy), get(kQz));
  const Eigen::Vector3d wind = Eigen::Vector3d(get(kSteadyWindNorth), get(kSteadyWindEast), 0) +
                               deviation * (BodyFromNed(attitude).transpose() * gust);
  for (int k = 0; k < 3; ++k) set(kWindNorth + k, wind[k]);
  if (tile.rotational_gusts) {
    StartRotationalGusts(tile, index, {normals, right.gust(), down.gust(), scales, deviation},
                         turbulence.span_ft);
  }
}

void AdvanceGusts(Tile tile, float dt, const GustKeys& keys, const Turbulence& turbulence) {
  SKEIN_DISPATCH(AdvanceGustsKernel)(tile, dt, keys, turbulence);
}

}  // namespace skein
#endif
