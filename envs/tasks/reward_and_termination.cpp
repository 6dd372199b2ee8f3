// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/reward_and_termination.h"

#include <cmath>

#include "envs/kernels/kernel_aircraft.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/reward_and_termination.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/atmosphere-inl.h"
#include "envs/tasks/flight-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// 0 x of every value that must be finite, summed: zero, or NaN if any is not finite. Four sums
/// side by side, since one would be a long chain of additions.
HWY_INLINE Mask IsFinite(const Tile& tile, V reward, int first) {
  const V zero = hn::Zero(FloatTag());
  V sums[4] = {hn::Mul(zero, reward), zero, zero, zero};
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
HWY_INLINE Mask IsOutside(const TerminationLimits::AngleRange& range, V along, V across) {
  return hn::Or(
      hn::Lt(hn::Mul(across, Constant(range.cos_min)), hn::Mul(along, Constant(range.sin_min))),
      hn::Lt(hn::Mul(along, Constant(range.sin_max)), hn::Mul(across, Constant(range.cos_max))));
}

/// A Termination per lane, as a float number, and its terminal reward.
struct EpisodeEnd {
  V termination, reward;

  HWY_INLINE void SetWhere(Mask where, Termination value, float value_reward) {
    termination = hn::IfThenElse(where, Constant(static_cast<int>(value)), termination);
    reward = hn::IfThenElse(where, Constant(value_reward), reward);
  }
  /// Failures of the task's own, where they are not 0.
  HWY_INLINE void SetTo(V failures, const TerminationLimits& limits) {
    const auto where = hn::Ne(failures, hn::Zero(FloatTag()));
    termination = hn::IfThenElse(where, failures, termination);
    reward = hn::IfThenElse(where, Constant(limits.failure_reward), reward);
  }
};

HWY_INLINE EpisodeEnd FindTermination(const KernelAircraft& aircraft,
                                      const TerminationLimits& limits, const Tile& tile,
                                      Mask is_finite, Mask is_reached, Mask is_out_of_time,
                                      const std::int32_t* ends, int first) {
  const FloatTag d;
  const BodyVelocity<V> air = AirVelocity(d, tile, first);
  const AirspeedSquares<V> squares = SquaresOf(air);
  const V altitude = hn::Neg(Column(tile, kDown, first));
  const V sound_speed_squared = AirAtAltitude(d, aircraft, altitude).sound_speed_squared;

  V forward, per_forward;
  Length(squares.in_plane, forward, per_forward);

  const auto is_extreme =
      hn::Or(IsOutside(limits.alpha, air.u, air.w), IsOutside(limits.beta, forward, air.v));
  const auto is_fast =
      hn::Gt(squares.whole, hn::Mul(Constant(limits.max_mach_squared), sound_speed_squared));
  const auto is_slow =
      hn::Lt(squares.whole, hn::Mul(Constant(limits.min_mach_squared), sound_speed_squared));
  const auto is_low = hn::Lt(altitude, Constant(limits.min_altitude_ft));
  const auto is_overloaded = hn::Gt(Column(tile, kNz, first), Constant(limits.max_load_factor));

  EpisodeEnd end{hn::Zero(d), hn::Zero(d)};
  // Later ones take precedence.
  end.SetWhere(is_out_of_time, Termination::kTimeLimit, limits.time_limit_reward);
  end.SetWhere(is_reached, Termination::kTargetReached, limits.success_reward);
  if (ends != nullptr) end.SetTo(hn::ConvertTo(d, hn::LoadU(IntTag(), ends + first)), limits);
  end.SetWhere(is_overloaded, Termination::kOverload, limits.failure_reward);
  end.SetWhere(is_slow, Termination::kLowSpeed, limits.failure_reward);
  end.SetWhere(is_low, Termination::kLowAltitude, limits.failure_reward);
  end.SetWhere(is_fast, Termination::kHighSpeed, limits.failure_reward);
  end.SetWhere(is_extreme, Termination::kExtremeState, limits.failure_reward);
  end.SetWhere(hn::Not(is_finite), Termination::kNonFinite, limits.failure_reward);
  return end;
}

HWY_INLINE void AddWhere(Mask where, V value, float* column) {
  const FloatTag d;
  const V old = hn::LoadU(d, column);
  hn::StoreU(hn::IfThenElse(where, hn::Add(old, value), old), d, column);
}

void ComputeRewardAndTerminationKernel(const KernelAircraft& aircraft,
                                       const TerminationLimits& limits, Tile tile,
                                       const StepResult& step_result,
                                       const EpisodeColumns& episodes) {
  const FloatTag d;
  const IntTag di;
  const auto zero = hn::Zero(di);
  const auto time_limit = hn::Set(di, limits.time_limit_steps);
  for (int first = 0; first < tile.count; first += kLanes) {
    const auto ended_before = hn::LoadU(di, episodes.termination + first);
    const auto is_flying = hn::Eq(ended_before, zero);
    const auto steps_before = hn::LoadU(di, episodes.step + first);
    const auto deadline =
        step_result.deadline == nullptr ? time_limit : hn::LoadU(di, step_result.deadline + first);
    const auto now = hn::Add(steps_before, hn::Set(di, 1));
    const auto is_out_of_time = hn::RebindMask(d, hn::Not(hn::Gt(deadline, now)));
    const auto step = hn::Sub(steps_before, hn::VecFromMask(di, is_flying));
    hn::StoreU(step, di, episodes.step + first);

    const V step_reward = hn::LoadU(d, step_result.reward + first);
    const auto reached = hn::LoadU(di, step_result.reached + first);
    const Mask is_finite = IsFinite(tile, step_reward, first);
    const EpisodeEnd end =
        FindTermination(aircraft, limits, tile, is_finite, hn::RebindMask(d, hn::Gt(reached, zero)),
                        is_out_of_time, step_result.ends, first);
    hn::StoreU(hn::IfThenElse(is_flying, hn::ConvertTo(di, end.termination), ended_before), di,
               episodes.termination + first);

    const V reward =
        hn::Add(hn::IfThenElseZero(is_finite, hn::Mul(step_reward, Constant(limits.reward_scale))),
                step_result.bonus == nullptr
                    ? end.reward
                    : hn::Add(end.reward, hn::LoadU(d, step_result.bonus + first)));
    const Mask counts = hn::RebindMask(d, is_flying);
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

TerminationLimits::TerminationLimits(const TerminationConfig& config,
                                     const EpisodeSettings& episode)
    : alpha(Directions(config.alpha_deg)),
      beta(Directions(config.beta_deg)),
      min_mach_squared(static_cast<float>(config.min_mach * config.min_mach)),
      max_mach_squared(static_cast<float>(config.max_mach * config.max_mach)),
      min_altitude_ft(static_cast<float>(config.min_altitude_ft)),
      max_load_factor(static_cast<float>(config.max_load_factor)),
      failure_reward(static_cast<float>(config.failure_reward)),
      success_reward(static_cast<float>(config.success_reward)),
      time_limit_reward(episode.truncate_at_time_limit ? 0
                                                       : static_cast<float>(config.late_reward())),
      reward_scale(static_cast<float>(episode.reward_scale)),
      time_limit_steps(episode.time_limit_steps) {}

HWY_EXPORT(ComputeRewardAndTerminationKernel);

void ComputeRewardAndTermination(const KernelAircraft& aircraft, const TerminationLimits& limits,
                                 Tile tile, const StepResult& step_result,
                                 const EpisodeColumns& episodes) {
  SKEIN_DISPATCH(ComputeRewardAndTerminationKernel)(aircraft, limits, tile, step_result, episodes);
}

}  // namespace skein
#endif
