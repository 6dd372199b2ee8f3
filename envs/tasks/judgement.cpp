#include "envs/tasks/judgement.h"

#include "envs/dynamics/kernel_aircraft.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/judgement.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/dynamics/air-inl.h"
#include "envs/tasks/flight-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using FlightMask = hn::Mask<FlightTag>;

/// x - x of every value that must be finite, summed: zero, or NaN if any is not finite.
HWY_INLINE FlightMask IsFinite(const Tile& tile, FlightVector reward, int first) {
  FlightVector sum = hn::Sub(reward, reward);
  for (int column = 0; column < kNumColumns; ++column) {
    const FlightVector x = Column(tile, column, first);
    sum = hn::Add(sum, hn::Sub(x, x));
  }
  return hn::Eq(sum, hn::Zero(FlightTag()));
}

HWY_INLINE FlightMask IsOutside(FlightVector x, const Range& range) {
  return hn::Or(hn::Lt(x, Constant(range.min)), hn::Gt(x, Constant(range.max)));
}

/// The termination that each aircraft's state asks for, as float numbers.
HWY_INLINE FlightVector FindTermination(const KernelAircraft& aircraft, const EnvConfig& config,
                                        const Tile& tile, FlightMask is_finite,
                                        FlightMask is_reached, FlightMask is_out_of_time,
                                        int first) {
  const FlightTag d;
  const TerminationConfig& limits = config.termination;
  const VelocityVectors velocity = Velocity(tile, first);
  const FlightVector altitude = hn::Neg(Column(tile, kDown, first));
  const FlightVector sound_speed = AirAtAltitude(d, aircraft, altitude).sound_speed;
  const FlightVector alpha_deg = Atan2Degrees(d, velocity.w, velocity.u);
  const FlightVector beta_deg = Atan2Degrees(d, velocity.v, velocity.forward);

  FlightVector found = hn::Zero(d);
  const auto set = [&](Termination termination, FlightMask where) HWY_ATTR {
    found = hn::IfThenElse(where, Constant(static_cast<int>(termination)), found);
  };
  // Later ones take precedence.
  set(Termination::kUnreachTarget, is_out_of_time);
  set(Termination::kResetTarget, is_reached);
  set(Termination::kOverload, hn::Gt(Column(tile, kNz, first), Constant(limits.max_load_factor)));
  set(Termination::kLowSpeed,
      hn::Lt(velocity.speed, hn::Mul(Constant(limits.min_mach), sound_speed)));
  set(Termination::kLowAltitude, hn::Lt(altitude, Constant(limits.min_altitude_ft)));
  set(Termination::kHighSpeed,
      hn::Gt(velocity.speed, hn::Mul(Constant(limits.max_mach), sound_speed)));
  set(Termination::kExtremeState,
      hn::Or(IsOutside(alpha_deg, limits.alpha_deg), IsOutside(beta_deg, limits.beta_deg)));
  set(Termination::kNonFinite, hn::Not(is_finite));
  return found;
}

HWY_INLINE FlightVector TerminalReward(const EnvConfig& config, FlightVector termination) {
  const FlightTag d;
  const auto is = [&](Termination value)
                      HWY_ATTR { return hn::Eq(termination, Constant(static_cast<int>(value))); };
  FlightVector reward = Constant(config.termination.failure_reward);
  reward = hn::IfThenElse(is(Termination::kResetTarget),
                          Constant(config.termination.success_reward), reward);
  if (config.truncate_at_time_limit) {
    reward = hn::IfThenElse(is(Termination::kUnreachTarget), hn::Zero(d), reward);
  }
  return hn::IfThenElse(is(Termination::kNone), hn::Zero(d), reward);
}

HWY_INLINE void AddWhere(FlightMask where, FlightVector value, float* column) {
  const FlightTag d;
  const FlightVector old = hn::LoadU(d, column);
  hn::StoreU(hn::IfThenElse(where, hn::Add(old, value), old), d, column);
}

void JudgeTileKernel(const KernelAircraft& aircraft, const EnvConfig& config, Tile tile,
                     const TaskVerdict& verdict, const EpisodeColumns& episodes) {
  const FlightTag d;
  const hn::RebindToSigned<FlightTag> di;
  const auto zero = hn::Zero(di);
  const auto time_limit = hn::Set(di, config.time_limit_steps - 1);
  for (int first = 0; first < tile.count; first += static_cast<int>(hn::Lanes(d))) {
    const auto ended = hn::LoadU(di, episodes.termination + first);
    const auto is_flying = hn::Eq(ended, zero);
    const auto steps_before = hn::LoadU(di, episodes.step + first);
    const auto is_out_of_time = hn::RebindMask(d, hn::Not(hn::Gt(time_limit, steps_before)));
    const auto step = hn::Sub(steps_before, hn::VecFromMask(di, is_flying));
    hn::StoreU(step, di, episodes.step + first);

    const FlightVector step_reward = hn::LoadU(d, verdict.reward + first);
    const auto reached = hn::LoadU(di, verdict.reached + first);
    const FlightMask is_finite = IsFinite(tile, step_reward, first);
    const FlightVector termination =
        FindTermination(aircraft, config, tile, is_finite, hn::RebindMask(d, hn::Gt(reached, zero)),
                        is_out_of_time, first);
    hn::StoreU(hn::IfThenElse(is_flying, hn::ConvertTo(di, termination), ended), di,
               episodes.termination + first);

    const FlightVector reward =
        hn::Add(hn::IfThenElseZero(is_finite, hn::Mul(step_reward, Constant(config.reward_scale))),
                TerminalReward(config, termination));
    const FlightMask counts = hn::RebindMask(d, is_flying);
    AddWhere(counts, reward, episodes.decision_reward + first);
    AddWhere(counts, reward, episodes.episode_return + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(JudgeTileKernel);

void JudgeTile(const KernelAircraft& aircraft, const EnvConfig& config, Tile tile,
               const TaskVerdict& verdict, const EpisodeColumns& episodes) {
  SKEIN_DISPATCH(JudgeTileKernel)(aircraft, config, tile, verdict, episodes);
}

}  // namespace skein
#endif
