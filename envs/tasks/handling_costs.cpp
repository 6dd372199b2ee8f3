// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/handling_costs.h"

#include <algorithm>
#include <cmath>

#include "base/field_list.h"
#include "envs/tasks/task.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/handling_costs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// Costs of what is only asked for where the target is held.
HWY_INLINE V NearCost(const HandlingCosts& costs, const Tile& flight, int first) {
  const DownInBody down = Down(flight, first);
  V cos_pitch, per_cos_pitch;
  Length(hn::MulAdd(down.y, down.y, hn::Mul(down.z, down.z)), cos_pitch, per_cos_pitch);
  const V excess = hn::Abs(hn::Sub(Column(flight, kNz, first), down.z));
  const V bank = hn::NegMulAdd(down.z, per_cos_pitch, Constant(1));
  V cost = hn::MulAdd(Constant(costs.near_load_factor), excess,
                      hn::Mul(Constant(costs.near_bank), bank));
  const double weights[] = {costs.near_roll_rate, costs.near_pitch_rate, costs.near_yaw_rate};
  for (int k = 0; k < 3; ++k) {
    cost = hn::MulAdd(Constant(weights[k]), hn::Abs(Column(flight, kP + k, first)), cost);
  }
  return cost;
}

/// Where the target counts as reached: nowhere, if that is not remembered.
HWY_INLINE hn::Mask<FloatTag> IsReached(const std::int32_t* reached_step, int first) {
  const IntTag di;
  const auto zero = hn::Zero(di);
  const auto reached = reached_step == nullptr ? zero : hn::LoadU(di, reached_step + first);
  return hn::RebindMask(FloatTag(), hn::Gt(reached, zero));
}

void SubtractHandlingCostsKernel(const HandlingCosts& costs, Tile flight, const float* errors,
                                 std::size_t error_stride, const std::int32_t* reached_step,
                                 float* reward) {
  const FloatTag d;
  const V floor = Constant(costs.near_floor);
  for (int first = 0; first < flight.count; first += kLanes) {
    V square = hn::Zero(d);
    for (int k = 0; k < kNumTaskErrors; ++k) {
      const V error = hn::LoadU(d, errors + k * error_stride + first);
      square = hn::MulAdd(error, error, square);
    }
    const V nearness =
        hn::Div(Constant(1), hn::MulAdd(Constant(costs.near_sharpness), square, Constant(1)));
    const V near =
        hn::IfThenElse(IsReached(reached_step, first), hn::Max(nearness, floor), nearness);
    const VelocityVectors velocity = Velocity(flight, first);
    const V sin_beta = hn::Mul(velocity.air.v, velocity.per_speed);
    const V anywhere =
        hn::MulAdd(Constant(costs.sideslip), hn::Abs(sin_beta),
                   hn::Mul(Constant(costs.roll_rate), hn::Abs(Column(flight, kP, first))));
    const V cost = hn::MulAdd(near, NearCost(costs, flight, first), anywhere);
    hn::StoreU(hn::Sub(hn::LoadU(d, reward + first), cost), d, reward + first);
  }
}

void RewardTolerancesKernel(const HandlingCosts& costs, int count, const std::int32_t* within,
                            const std::int32_t* reached_step, float* reward) {
  const FloatTag d;
  const IntTag di;
  const auto zero = hn::Zero(di);
  const V gain = Constant(costs.within_tolerances), loss = Constant(-costs.outside_tolerances);
  const V price = Constant(costs.before_reached);
  for (int first = 0; first < count; first += kLanes) {
    const auto is_outside = hn::RebindMask(d, hn::Eq(hn::LoadU(di, within + first), zero));
    const V step_reward =
        hn::Add(hn::LoadU(d, reward + first), hn::IfThenElse(is_outside, loss, gain));
    hn::StoreU(
        hn::IfThenElse(IsReached(reached_step, first), step_reward, hn::Sub(step_reward, price)), d,
        reward + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(SubtractHandlingCostsKernel);
HWY_EXPORT(RewardTolerancesKernel);

HandlingCosts HandlingCosts::Times(double factor) const {
  HandlingCosts scaled = *this;
  for (double* const weight :
       {&scaled.near_roll_rate, &scaled.near_pitch_rate, &scaled.near_yaw_rate,
        &scaled.near_load_factor, &scaled.near_bank, &scaled.roll_rate, &scaled.sideslip,
        &scaled.within_tolerances, &scaled.outside_tolerances, &scaled.before_reached,
        &scaled.action_change}) {
    *weight *= factor;
  }
  return scaled;
}

bool HandlingCosts::of_control_steps() const {
  return std::max({near_roll_rate, near_pitch_rate, near_yaw_rate, near_load_factor, near_bank,
                   roll_rate, sideslip}) > 0;
}

void ListFields(HandlingCosts& config, FieldList& list) {
  const auto add = [&](const char* key, double* weight, const char* help) {
    list.Add(key, weight, Bounds::NotNegative(), help).OffUnless(*weight > 0);
  };
  add("near_roll_rate", &config.near_roll_rate,
      "reward lost per control step and rad/s of roll rate near the target");
  add("near_pitch_rate", &config.near_pitch_rate, "the same of pitch rate");
  add("near_yaw_rate", &config.near_yaw_rate, "the same of yaw rate");
  add("near_load_factor", &config.near_load_factor,
      "reward lost per control step and g of load factor beside that of unaccelerated flight near "
      "the target");
  add("near_bank", &config.near_bank,
      "reward lost per control step and unit of 1 - cos(roll) near the target");
  add("roll_rate", &config.roll_rate,
      "reward lost per control step and rad/s of roll rate everywhere");
  add("sideslip", &config.sideslip,
      "reward lost per control step and unit of sin(beta) everywhere");
  list.Add("near_sharpness", &config.near_sharpness, Bounds::NotNegative(),
           "the near terms are multiplied by 1 / (1 + this |normalised error|^2)")
      .OffUnless(config.of_control_steps());
  list.Add("near_floor", &config.near_floor, Bounds::NotNegative(),
           "what they are multiplied by at least while the target is held, having counted as "
           "reached, be it near or not; in missions nothing")
      .OffUnless(config.of_control_steps());
  add("within_tolerances", &config.within_tolerances,
      "reward gained per control step within the episode's tolerances");
  add("outside_tolerances", &config.outside_tolerances,
      "reward lost per control step outside them: a time penalty");
  add("before_reached", &config.before_reached,
      "the same until the target counts as reached, and not while it is held; in missions always");
  add("action_change", &config.action_change,
      "reward lost per policy step and squared change of each action but the throttle");
}

void SubtractHandlingCosts(const HandlingCosts& costs, Tile flight, const float* errors,
                           std::size_t error_stride, const std::int32_t* reached_step,
                           float* reward) {
  SKEIN_DISPATCH(SubtractHandlingCostsKernel)
  (costs, flight, errors, error_stride, reached_step, reward);
}

void RewardTolerances(const HandlingCosts& costs, int count, const std::int32_t* within,
                      const std::int32_t* reached_step, float* reward) {
  SKEIN_DISPATCH(RewardTolerancesKernel)(costs, count, within, reached_step, reward);
}

void SubtractActionChange(const HandlingCosts& costs, const float* action, int action_size,
                          int first, Tile last, float* reward) {
  const auto weight = static_cast<float>(costs.action_change);
  for (int i = 0; i < last.count; ++i) {
    float squares = 0;
    for (int k = 0; k < action_size; ++k) {
      const float now = std::clamp(action[i * action_size + k], -1.0f, 1.0f);
      const float change = now - last[k][i];
      if (k >= first) squares += change * change;
      last[k][i] = now;
    }
    reward[i] -= weight * squares;
  }
}

}  // namespace skein
#endif
