// SPDX-License-Identifier: Apache-2.0
#include "envs/guided_flight.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "envs/tasks/control.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/guided_flight.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void PlanKernel(const HighLevelConfig& config, const float* action, Tile flight, Tile target) {
  const FlightTag d;
  constexpr int kMaxLanes = 16;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const FlightVector one = Constant(1), zero = hn::Zero(d), vertical = Constant(1.5707963267948966);
  alignas(64) float last_rows[kMaxLanes * kHighLevelActionSize] = {};
  for (int first = 0; first < flight.count; first += lanes) {
    const float* rows = action + first * kHighLevelActionSize;
    if (flight.count - first < lanes) {
      std::copy(rows, action + flight.count * kHighLevelActionSize, last_rows);
      rows = last_rows;
    }
    FlightVector pitch, yaw, speed;
    hn::LoadInterleaved3(d, rows, pitch, yaw, speed);
    // Zero, or NaN where any of the three is not finite: clipping may lose it.
    const FlightVector poison =
        hn::MulAdd(zero, pitch, hn::MulAdd(zero, yaw, hn::Mul(zero, speed)));
    float* const u = flight[kU] + first;
    hn::StoreU(hn::Add(hn::LoadU(d, u), poison), d, u);

    const auto change = [&](FlightVector command, double full) {
      return hn::Mul(hn::Min(hn::Max(command, hn::Neg(one)), one), Constant(full));
    };
    const FlightVector target_pitch =
        hn::Add(Pitch(flight, first), change(pitch, config.pitch_change_rad));
    hn::StoreU(hn::Min(hn::Max(target_pitch, hn::Neg(vertical)), vertical), d,
               target[kControlPitch] + first);
    hn::StoreU(WrapAngle(hn::Add(Yaw(flight, first), change(yaw, config.yaw_change_rad))), d,
               target[kControlYaw] + first);
    hn::StoreU(hn::Add(Velocity(flight, first).speed, change(speed, config.speed_change_fps)), d,
               target[kControlSpeed] + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
namespace {

HWY_EXPORT(PlanKernel);

static_assert(kControlPitch == 0 && kControlYaw == 1 && kControlSpeed == 2 &&
              kHighLevelActionSize == 3);

void RequireSize(const char* what, int size, int expected) {
  if (size == expected) return;
  throw Error("environment: the low-level policy has " + std::to_string(size) + " " + what +
              ", but one that flies for a high-level policy has " + std::to_string(expected));
}

}  // namespace

GuidedFlight::GuidedFlight(const EnvConfig& config, int num_aircraft,
                           std::shared_ptr<const Policy> low_level)
    : high_level_(config.high_level),
      control_(MakeControlTask(config)),
      low_level_(std::move(low_level)),
      observation_sums_size_(config.high_level.averages_observations ? kObservationSize + 1 : 0) {
  RequireSize("observations", low_level_->observation_size(), kObservationSize);
  RequireSize("actions", low_level_->action_size(), kActionSize);
  const auto count = static_cast<std::size_t>(num_aircraft);
  state_.assign(count * static_cast<std::size_t>(low_level_->state_size()), 0.0f);
  observation_sums_.assign(count * static_cast<std::size_t>(observation_sums_size_), 0.0f);
}

void GuidedFlight::Forget(int aircraft) {
  std::fill_n(state(aircraft), low_level_->state_size(), 0.0f);
  ResetObservationMean(aircraft, 1);
}

void GuidedFlight::ResetObservationMean(int first, int count) {
  std::fill_n(observation_sums(first), static_cast<std::ptrdiff_t>(count) * observation_sums_size_,
              0.0f);
}

void GuidedFlight::AccumulateObservations(int first, int count, const float* errors,
                                          const PolicyStep& policy_step) {
  for (int i = 0; i < count; ++i) {
    float* const sum = observation_sums(first + i);
    const float* const look = policy_step.observation + i * kObservationSize;
    for (int k = 0; k < kNumTaskErrors; ++k) {
      // What is left of the low-level policy's errors is their noise.
      sum[k] += look[k] - policy_step.error[k][i] + errors[k * kMaxCount + i];
    }
    for (int k = kNumTaskErrors; k < kObservationSize; ++k) sum[k] += look[k];
    sum[kObservationSize] += 1;
  }
}

void GuidedFlight::Average(int first, int count, float* observation) const {
  for (int i = 0; i < count; ++i) {
    const float* const sum =
        observation_sums_.data() + static_cast<std::ptrdiff_t>(first + i) * observation_sums_size_;
    const float share = 1 / (sum[kObservationSize] + 1);
    float* const row = observation + i * kObservationSize;
    for (int k = 0; k < kObservationSize; ++k) row[k] = (row[k] + sum[k]) * share;
  }
}

void GuidedFlight::Plan(const float* action, Tile flight, PolicyStep& policy_step) const {
  SKEIN_DISPATCH(PlanKernel)
  (high_level_, action, flight, {policy_step.target[0], kMaxCount, flight.count});
}

void GuidedFlight::Act(const KernelAircraft& aircraft, Tile flight, const ObservationNoise& noise,
                       PolicyStep& policy_step) {
  // Of the Control task's columns, those that its errors are made of.
  const Tile target{policy_step.target[0], kMaxCount, flight.count};
  control_->Errors(flight, target, policy_step.error[0], kMaxCount);
  ObserveTile(aircraft, flight, policy_step.error[0], kMaxCount, noise, policy_step.observation);
  low_level_->Act(flight.count, policy_step.observation,
                  state(static_cast<int>(noise.first_aircraft)), policy_step.stick);
}

}  // namespace skein
#endif
