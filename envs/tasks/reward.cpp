// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/reward.h"

#include <cmath>

#include "envs/kernels/kernel_aircraft.h"
#include "envs/state/attitude.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/reward.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/air-inl.h"
#include "envs/tasks/flight-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FlightMask = hn::Mask<FlightTag>;

/// 0 x of every value that must be finite, summed: zero, or NaN if any is not finite. Four sums
/// side by side, since one would be a long chain of additions.
HWY_INLINE FlightMask IsFinite(const Tile& tile, FlightVector reward, int first) {
  const FlightVector zero = hn::Zero(FlightTag());
  FlightVector sums[4] = {hn::Mul(zero, reward), zero, zero, zero};
  int column = 0;
  for (; column + 4 <= kNumColumns; column += 4) {
    for (int k = 0; k < 4; ++k) {
      sums[k] = hn::MulAdd(zero, Column(tile, column + k, first), sums[k]);
    }
  }
  for (; column < kNumColumns; ++column) {
    sums[0] = hn::MulAdd(zero, Column(tile, column, first), sums[0]);
  }
  return hn::Eq(hn::Add(hn::Add(sums[0], sums[1]), hn::Add(sums[2], sums[3])), zero);
}

/// Whether the angle of the vector (along, across), across = tan(angle) along, lies outside
/// `range`: on the wrong side of either end's direction.
HWY_INLINE FlightMask IsOutside(const TerminationLimits::AngleRange& range, FlightVector along,
                                FlightVector across) {
  return hn::Or(
      hn::Lt(hn::Mul(across, Constant(range.cos_min)), hn::Mul(along, Constant(range.sin_min))),
      hn::Lt(hn::Mul(along, Constant(range.sin_max)), hn::Mul(across, Constant(range.cos_max))));
}

/// A Termination per lane, as a float number, and its reward.
struct Verdict {
  FlightVector termination, reward;

  HWY_INLINE void SetWhere(FlightMask where, Termination value, float value_reward) {
    termination = hn::IfThenElse(where, Constant(static_cast<int>(value)), termination);
    reward = hn::IfThenElse(where, Constant(value_reward), reward);
  }
};

HWY_INLINE Verdict FindTermination(const KernelAircraft& aircraft, const TerminationLimits& limits,
                                   const Tile& tile, FlightMask is_finite, FlightMask is_reached,
                                   FlightMask is_out_of_time, int first) {
  const FlightTag d;
  const auto [u, v, w] = AirVelocity(d, tile, first);
  const FlightVector forward_squared = hn::MulAdd(u, u, hn::Mul(w, w));
  const FlightVector speed_squared = hn::MulAdd(v, v, forward_squared);
  const FlightVector altitude = hn::Neg(Column(tile, kDown, first));
  const FlightVector sound_speed_squared = AirAtAltitude(d, aircraft, altitude).sound_speed_squared;

  FlightVector forward, per_forward;
  Length(forward_squared, forward, per_forward);

  const auto is_extreme = hn::Or(IsOutside(limits.alpha, u, w), IsOutside(limits.beta, forward, v));
  const auto is_fast =
      hn::Gt(speed_squared, hn::Mul(Constant(limits.max_mach_squared), sound_speed_squared));
  const auto is_slow =
      hn::Lt(speed_squared, hn::Mul(Constant(limits.min_mach_squared), sound_speed_squared));
  const auto is_low = hn::Lt(altitude, Constant(limits.min_altitude_ft));
  const auto is_overloaded = hn::Gt(Column(tile, kNz, first), Constant(limits.max_load_factor));

  Verdict step_result{hn::Zero(d), hn::Zero(d)};
  // Later ones take precedence.
  step_result.SetWhere(is_out_of_time, Termination::kTimeLimit, limits.time_limit_reward);
  step_result.SetWhere(is_reached, Termination::kTargetReached, limits.success_reward);
  step_result.SetWhere(is_overloaded, Termination::kOverload, limits.failure_reward);
  step_result.SetWhere(is_slow, Termination::kLowSpeed, limits.failure_reward);
  step_result.SetWhere(is_low, Termination::kLowAltitude, limits.failure_reward);
  step_result.SetWhere(is_fast, Termination::kHighSpeed, limits.failure_reward);
  step_result.SetWhere(is_extreme, Termination::kExtremeState, limits.failure_reward);
  step_result.SetWhere(hn::Not(is_finite), Termination::kNonFinite, limits.failure_reward);
  return step_result;
}

HWY_INLINE void AddWhere(FlightMask where, FlightVector value, float* column) {
  const FlightTag d;
  const FlightVector old = hn::LoadU(d, column);
  hn::StoreU(hn::IfThenElse(where, hn::Add(old, value), old), d, column);
}

void ComputeRewardAndTerminationKernel(const KernelAircraft& aircraft,
                                       const TerminationLimits& limits, Tile tile,
                                       const StepResult& step_result,
                                       const EpisodeColumns& episodes) {
  const FlightTag d;
  const hn::RebindToSigned<FlightTag> di;
  const auto zero = hn::Zero(di);
  const auto time_limit = hn::Set(di, limits.time_limit_steps - 1);
  for (int first = 0; first < tile.count; first += static_cast<int>(hn::Lanes(d))) {
    const auto ended = hn::LoadU(di, episodes.termination + first);
    const auto is_flying = hn::Eq(ended, zero);
    const auto steps_before = hn::LoadU(di, episodes.step + first);
    const auto is_out_of_time = hn::RebindMask(d, hn::Not(hn::Gt(time_limit, steps_before)));
    const auto step = hn::Sub(steps_before, hn::VecFromMask(di, is_flying));
    hn::StoreU(step, di, episodes.step + first);

    const FlightVector step_reward = hn::LoadU(d, step_result.reward + first);
    const auto reached = hn::LoadU(di, step_result.reached + first);
    const FlightMask is_finite = IsFinite(tile, step_reward, first);
    const Verdict found =
        FindTermination(aircraft, limits, tile, is_finite, hn::RebindMask(d, hn::Gt(reached, zero)),
                        is_out_of_time, first);
    hn::StoreU(hn::IfThenElse(is_flying, hn::ConvertTo(di, found.termination), ended), di,
               episodes.termination + first);

    const FlightVector reward =
        hn::Add(hn::IfThenElseZero(is_finite, hn::Mul(step_reward, Constant(limits.reward_scale))),
                found.reward);
    const FlightMask counts = hn::RebindMask(d, is_flying);
    AddWhere(counts, reward, episodes.policy_step_reward + first);
    AddWhere(counts, reward, episodes.episode_return + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

namespace {

TerminationLimits::AngleRange Directions(const Range& range_deg) {
  const double min = range_deg.min / kDegPerRad, max = range_deg.max / kDegPerRad;
  return {static_cast<float>(std::sin(min)), static_cast<float>(std::cos(min)),
          static_cast<float>(std::sin(max)), static_cast<float>(std::cos(max))};
}

}  // namespace

TerminationLimits::TerminationLimits(const EnvConfig& config)
    : alpha(Directions(config.termination.alpha_deg)),
      beta(Directions(config.termination.beta_deg)),
      min_mach_squared(
          static_cast<float>(config.termination.min_mach * config.termination.min_mach)),
      max_mach_squared(
          static_cast<float>(config.termination.max_mach * config.termination.max_mach)),
      min_altitude_ft(static_cast<float>(config.termination.min_altitude_ft)),
      max_load_factor(static_cast<float>(config.termination.max_load_factor)),
      failure_reward(static_cast<float>(config.termination.failure_reward)),
      success_reward(static_cast<float>(config.termination.success_reward)),
      time_limit_reward(config.truncate_at_time_limit ? 0 : failure_reward),
      reward_scale(static_cast<float>(config.reward_scale)),
      time_limit_steps(config.time_limit_steps) {}

HWY_EXPORT(ComputeRewardAndTerminationKernel);

void ComputeRewardAndTermination(const KernelAircraft& aircraft, const TerminationLimits& limits,
                                 Tile tile, const StepResult& step_result,
                                 const EpisodeColumns& episodes) {
  SKEIN_DISPATCH(ComputeRewardAndTerminationKernel)(aircraft, limits, tile, step_result, episodes);
}

}  // namespace skein
#endif
