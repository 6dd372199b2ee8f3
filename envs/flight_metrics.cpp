// SPDX-License-Identifier: Apache-2.0
#include "envs/flight_metrics.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "envs/aircraft/aircraft.h"
#include "envs/flight_metric_sums.h"
#include "envs/kernels/kernel_aircraft.h"
#include "envs/state/attitude.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/flight_metrics.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/atmosphere-inl.h"
#include "envs/tasks/flight-inl.h"
#include "simd/vocabulary-inl.h"

#ifndef SKEIN_ENVS_FLIGHT_METRICS_CONSTANTS_
#define SKEIN_ENVS_FLIGHT_METRICS_CONSTANTS_
namespace skein {
namespace {

// Margins are fractions of the way from the middle to the ends of the ranges of the paper's Table
// 5, whatever the limits flown under: so they can be compared.
constexpr double kLowestAltitudeFt = 2500, kAltitudeRangeFt = 5000 / 0.3048;
constexpr double kMiddleMach = (3 + 0.01) / 2;
constexpr double kLargestLoadFactor = 10;
constexpr double kMiddleAlphaDeg = (45 - 20) / 2.0, kAlphaHalfRangeDeg = (45 + 20) / 2.0;
constexpr double kBetaHalfRangeDeg = 30;
// What smoothness divides by, ours: body rates by pi rad/s, the load factor by its limit.
constexpr double kPi = 3.14159265358979324;

// Rows of sums: how many steps (an int32), what they sum to, what rounding has lost of that, the
// smoothed quantities one and two steps ago, and the peaks.
constexpr int kNumSmoothed = 4;
constexpr int kSteps = 0;
constexpr int kSum = kSteps + 1;
constexpr int kLost = kSum + kFirstPeak;
constexpr int kBefore = kLost + kFirstPeak;
constexpr int kTwoBefore = kBefore + kNumSmoothed;
constexpr int kPeak = kTwoBefore + kNumSmoothed;
constexpr int kNumSumColumns = kPeak + kNumFlightMetrics - kFirstPeak;

}  // namespace
}  // namespace skein
#endif  // SKEIN_ENVS_FLIGHT_METRICS_CONSTANTS_

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// 1 at `middle`, falling to 0 at a distance of `half_range`.
HWY_INLINE V Margin(V value, double middle, double half_range) {
  const V distance = hn::Abs(hn::Sub(value, Constant(middle)));
  return hn::NegMulAdd(distance, Constant(1 / half_range), Constant(1));
}

/// Everything but smoothness.
HWY_INLINE void Measure(const KernelAircraft& aircraft, const Tile& tile, int first,
                        V (&values)[kNumFlightMetrics]) {
  const FloatTag d;
  const VelocityVectors velocity = Velocity(tile, first);
  const V altitude = hn::Neg(Column(tile, kDown, first));
  V sound_speed, per_sound_speed;
  Length(AirAtAltitude(d, aircraft, altitude).sound_speed_squared, sound_speed, per_sound_speed);
  const V load_factor = Column(tile, kNz, first);
  const V mach = hn::Mul(velocity.speed, per_sound_speed);
  const V alpha = AlphaDegrees(d, velocity.air.u, velocity.air.w);
  const V beta = Atan2Degrees(d, velocity.air.v, velocity.forward);
  values[kMeanLoadFactor] = load_factor;
  values[kMeanTrueAirspeed] = velocity.speed;
  values[kMeanMach] = mach;
  values[kMeanClimbRate] = ClimbRate(tile, first);
  values[kMeanAbsClimbRate] = hn::Abs(values[kMeanClimbRate]);
  values[kMeanAbsAlpha] = hn::Abs(alpha);
  values[kMeanAbsBeta] = hn::Abs(beta);
  for (int k = 0; k < 3; ++k) values[kMeanAbsP + k] = hn::Abs(Column(tile, kP + k, first));
  values[kAltitudeMargin] =
      hn::Mul(hn::Sub(altitude, Constant(kLowestAltitudeFt)), Constant(1 / kAltitudeRangeFt));
  values[kSpeedMargin] = Margin(mach, kMiddleMach, kMiddleMach);
  values[kOverloadMargin] = Margin(load_factor, 0, kLargestLoadFactor);
  values[kAlphaMargin] = Margin(alpha, kMiddleAlphaDeg, kAlphaHalfRangeDeg);
  values[kBetaMargin] = Margin(beta, 0, kBetaHalfRangeDeg);
  values[kPeakLoadFactor] = values[kLowestLoadFactor] = load_factor;
  values[kPeakAlpha] = alpha;
  values[kPeakAbsBeta] = values[kMeanAbsBeta];
  values[kPeakAbsP] = values[kMeanAbsP];
}

/// The norm of the smoothed quantities' second difference, which moves on by a step where `flying`.
HWY_INLINE V SecondDifference(const Tile& tile, const Tile& sums, Mask flying, int first) {
  const FloatTag d;
  V square = hn::Zero(d);
  for (int k = 0; k < kNumSmoothed; ++k) {
    const bool is_rate = k < 3;
    const V now = hn::Mul(Column(tile, is_rate ? kP + k : kNz, first),
                          Constant(1 / (is_rate ? kPi : kLargestLoadFactor)));
    const V before = Column(sums, kBefore + k, first);
    const V two_before = Column(sums, kTwoBefore + k, first);
    const V second = hn::Add(hn::Sub(now, before), hn::Sub(two_before, before));
    square = hn::MulAdd(second, second, square);
    hn::StoreU(hn::IfThenElse(flying, before, two_before), d, sums[kTwoBefore + k] + first);
    hn::StoreU(hn::IfThenElse(flying, now, before), d, sums[kBefore + k] + first);
  }
  const IntTag di;
  const auto has_two = hn::Gt(hn::BitCast(di, Column(sums, kSteps, first)), hn::Set(di, 1));
  return hn::IfThenElseZero(hn::RebindMask(d, has_two), hn::Sqrt(square));
}

/// Adds with what rounding loses carried along (Kahan 1965): the sums of a long episode are as
/// exact as its steps.
HWY_INLINE void AddWhere(Mask where, V value, float* sum_row, float* lost_row) {
  const FloatTag d;
  const V sum = hn::LoadU(d, sum_row), lost = hn::LoadU(d, lost_row);
  const V corrected = hn::Sub(value, lost);
  const V total = hn::Add(sum, corrected);
  hn::StoreU(hn::IfThenElse(where, total, sum), d, sum_row);
  hn::StoreU(hn::IfThenElse(where, hn::Sub(hn::Sub(total, sum), corrected), lost), d, lost_row);
}

/// The peaks after one more state, where `flying`. The first state of an episode is all there is.
HWY_INLINE void FollowPeaks(Mask flying, Mask is_first, const V (&values)[kNumFlightMetrics],
                            const Tile& sums, int first) {
  const FloatTag d;
  for (int k = kFirstPeak; k < kNumFlightMetrics; ++k) {
    float* const row = sums[kPeak + k - kFirstPeak] + first;
    const V before = hn::LoadU(d, row);
    const V farther =
        k == kLowestLoadFactor ? hn::Min(before, values[k]) : hn::Max(before, values[k]);
    const V peak = hn::IfThenElse(is_first, values[k], farther);
    hn::StoreU(hn::IfThenElse(flying, peak, before), d, row);
  }
}

void AddFlightMetrics(const KernelAircraft& aircraft, Tile tile, const std::int32_t* termination,
                      Tile sums) {
  const FloatTag d;
  const IntTag di;
  for (int first = 0; first < tile.count; first += kLanes) {
    const Mask flying = hn::RebindMask(d, hn::Eq(hn::LoadU(di, termination + first), hn::Zero(di)));
    V values[kNumFlightMetrics];
    Measure(aircraft, tile, first, values);
    values[kSmoothness] = SecondDifference(tile, sums, flying, first);
    for (int k = 0; k < kFirstPeak; ++k) {
      AddWhere(flying, values[k], sums[kSum + k] + first, sums[kLost + k] + first);
    }
    const auto steps = hn::BitCast(di, Column(sums, kSteps, first));
    FollowPeaks(flying, hn::RebindMask(d, hn::Eq(steps, hn::Zero(di))), values, sums, first);
    const auto one_more = hn::IfThenElseZero(hn::RebindMask(di, flying), hn::Set(di, 1));
    hn::StoreU(hn::BitCast(d, hn::Add(steps, one_more)), d, sums[kSteps] + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(AddFlightMetrics);

const std::array<FlightMetricName, kNumFlightMetrics> kFlightMetricNames = {{
    {"load_factor_g", "G", "load factor, g"},
    {"true_airspeed_fps", "TAS", "airspeed, ft/s"},
    {"mach", "M", "Mach number"},
    {"climb_rate_fps", "RoC", "climb rate, ft/s"},
    {"abs_climb_rate_fps", "|RoC|", "climb rate, ft/s"},
    {"abs_alpha_deg", "|AOA|", "alpha, deg"},
    {"abs_beta_deg", "|AOS|", "beta, deg"},
    {"abs_p_rad_s", "|P|", "roll rate, rad/s"},
    {"abs_q_rad_s", "|Q|", "pitch rate, rad/s"},
    {"abs_r_rad_s", "|R|", "yaw rate, rad/s"},
    {"altitude_margin", "ASM", "altitude margin"},
    {"speed_margin", "SSM", "speed margin"},
    {"overload_margin", "OSM", "overload margin"},
    {"alpha_margin", "AOASM", "alpha margin"},
    {"beta_margin", "AOSSM", "beta margin"},
    {"smoothness", "FSM", "smoothness"},
    {"peak_load_factor_g", "", "peak nz, g"},
    {"lowest_load_factor_g", "", "lowest nz, g"},
    {"peak_alpha_deg", "", "peak alpha, deg"},
    {"peak_abs_beta_deg", "", "peak sideslip, deg"},
    {"peak_abs_p_deg_s", "", "peak roll rate, deg/s"},
}};

void FlightMetricSums::Add(const KernelAircraft& aircraft, Tile flight,
                           const std::int32_t* termination) {
  if (columns_.empty()) {
    stride_ = flight.stride;
    columns_.resize(kNumSumColumns * stride_);
  }
  SKEIN_DISPATCH(AddFlightMetrics)
  (aircraft, flight, termination, {columns_.data(), stride_, flight.count});
}

std::int32_t FlightMetricSums::StepsOf(int index) const {
  std::int32_t steps;
  std::memcpy(&steps, &columns_[kSteps * stride_ + static_cast<std::size_t>(index)], sizeof steps);
  return steps;
}

void FlightMetricSums::Report(int index, std::int32_t episode_steps, double control_interval_s,
                              float* metrics) const {
  const auto sum = [&](int column) -> double {
    return columns_[static_cast<std::size_t>(column) * stride_ + static_cast<std::size_t>(index)];
  };
  if (columns_.empty() || StepsOf(index) != episode_steps) {
    std::fill_n(metrics, kNumFlightMetrics, std::numeric_limits<float>::quiet_NaN());
    return;
  }
  for (int k = 0; k < kFirstPeak; ++k) {
    metrics[k] = static_cast<float>(sum(kSum + k) / episode_steps);
  }
  for (int k = kFirstPeak; k < kNumFlightMetrics; ++k) {
    const double unit = k == kPeakAbsP ? kDegPerRad : 1;
    metrics[k] = static_cast<float>(unit * sum(kPeak + k - kFirstPeak));
  }
  // Between n states there are n - 2 second differences; fewer states were perfectly smooth.
  const int differences = std::max(1, episode_steps - 2);
  metrics[kSmoothness] =
      static_cast<float>(1 / (1 + sum(kSum + kSmoothness) / (differences * control_interval_s)));
}

void FlightMetricSums::Begin(int index) {
  for (auto at = static_cast<std::size_t>(index); at < columns_.size(); at += stride_) {
    columns_[at] = 0;
  }
}

}  // namespace skein
#endif
