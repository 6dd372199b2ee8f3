// SPDX-License-Identifier: Apache-2.0
#include "envs/low_level_flight.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/tasks/control.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/low_level_flight.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

void SetTargetsKernel(const HighLevelConfig& config, const float* action, Tile flight, Tile sensed,
                      Tile target) {
  const FloatTag d;
  const V one = Constant(1), zero = hn::Zero(d), vertical = Constant(1.5707963267948966);
  alignas(64) float last_rows[kLanes * kHighLevelActionSize] = {};
  for (int first = 0; first < flight.count; first += kLanes) {
    const float* rows = action + first * kHighLevelActionSize;
    if (flight.count - first < kLanes) {
      std::copy(rows, action + flight.count * kHighLevelActionSize, last_rows);
      rows = last_rows;
    }
    V pitch, yaw, speed;
    hn::LoadInterleaved3(d, rows, pitch, yaw, speed);
    // Zero, or NaN where any of the three is not finite: clipping may lose it.
    const V poison = hn::MulAdd(zero, pitch, hn::MulAdd(zero, yaw, hn::Mul(zero, speed)));
    float* const u = flight[kU] + first;
    hn::StoreU(hn::Add(hn::LoadU(d, u), poison), d, u);

    const auto change = [&](V command, double full) {
      return hn::Mul(hn::Min(hn::Max(command, hn::Neg(one)), one), Constant(full));
    };
    const V target_pitch = hn::Add(Pitch(sensed, first), change(pitch, config.pitch_change_rad));
    hn::StoreU(hn::Min(hn::Max(target_pitch, hn::Neg(vertical)), vertical), d,
               target[kControlPitch] + first);
    hn::StoreU(WrapAngle(hn::Add(Yaw(sensed, first), change(yaw, config.yaw_change_rad))), d,
               target[kControlYaw] + first);
    hn::StoreU(hn::Add(Velocity(sensed, first).speed, change(speed, config.speed_change_fps)), d,
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

HWY_EXPORT(SetTargetsKernel);

static_assert(kControlPitch == 0 && kControlYaw == 1 && kControlSpeed == 2 &&
              kHighLevelActionSize == 3);

/// Memory of nothing may be null, which memcpy must not see.
void CopyWords(const void* from, std::size_t count, void* to) {
  if (count > 0) std::memcpy(to, from, count * sizeof(std::uint32_t));
}

void RequireSize(const char* what, int size, int expected) {
  if (size == expected) return;
  throw Error("environment: the low-level policy has " + std::to_string(size) + " " + what +
              ", but one that flies for a high-level policy has " + std::to_string(expected));
}

}  // namespace

LowLevelFlight::LowLevelFlight(const EnvConfig& config, int num_aircraft,
                               std::shared_ptr<const Policy> low_level)
    : high_level_(config.high_level),
      control_(MakeControlTask(config.control, LoadAircraft(config.aircraft).units)),
      low_level_(std::move(low_level)),
      observation_sums_size_(config.high_level.averages_observations ? kObservationSize + 1 : 0) {
  RequireSize("observations", low_level_->observation_size(), kObservationSize);
  RequireSize("actions", low_level_->action_size(), kActionSize);
  const auto count = static_cast<std::size_t>(num_aircraft);
  state_.assign(count * static_cast<std::size_t>(low_level_->state_size()), 0.0f);
  observation_sums_.assign(count * static_cast<std::size_t>(observation_sums_size_), 0.0f);
}

std::size_t LowLevelFlight::StateBegin(int aircraft) const {
  return static_cast<std::size_t>(aircraft) * static_cast<std::size_t>(low_level_->state_size());
}

std::size_t LowLevelFlight::SumsBegin(int aircraft) const {
  return static_cast<std::size_t>(aircraft) * static_cast<std::size_t>(observation_sums_size_);
}

std::size_t LowLevelFlight::memory_words() const { return StateBegin(1) + SumsBegin(1); }

void LowLevelFlight::SaveMemory(int aircraft, std::uint32_t* words) const {
  const std::size_t state_size = StateBegin(1);
  CopyWords(state_.data() + StateBegin(aircraft), state_size, words);
  CopyWords(observation_sums_.data() + SumsBegin(aircraft), SumsBegin(1), words + state_size);
}

void LowLevelFlight::RestoreMemory(int aircraft, const std::uint32_t* words) {
  const std::size_t state_size = StateBegin(1);
  CopyWords(words, state_size, state_.data() + StateBegin(aircraft));
  CopyWords(words + state_size, SumsBegin(1), observation_sums_.data() + SumsBegin(aircraft));
}

void LowLevelFlight::Reset(int aircraft) {
  std::fill_n(state_.data() + StateBegin(aircraft), low_level_->state_size(), 0.0f);
  ResetObservationMean(aircraft, 1);
}

void LowLevelFlight::ResetObservationMean(int first, int count) {
  std::fill(observation_sums_.data() + SumsBegin(first),
            observation_sums_.data() + SumsBegin(first + count), 0.0f);
}

void LowLevelFlight::AccumulateObservations(int first, int count, const float* errors,
                                            const Scratch& scratch) {
  for (int i = 0; i < count; ++i) {
    float* const sum = observation_sums_.data() + SumsBegin(first + i);
    const float* const sample = scratch.observation + i * kObservationSize;
    for (int k = 0; k < kNumTaskErrors; ++k) {
      // What is left of the low-level policy's errors is their noise.
      sum[k] += sample[k] - scratch.error[k][i] + errors[k * kMaxCount + i];
    }
    for (int k = kNumTaskErrors; k < kObservationSize; ++k) sum[k] += sample[k];
    sum[kObservationSize] += 1;
  }
}

void LowLevelFlight::AverageObservations(int first, int count, float* observation) const {
  for (int i = 0; i < count; ++i) {
    const float* const sum = observation_sums_.data() + SumsBegin(first + i);
    const float share = 1 / (sum[kObservationSize] + 1);
    float* const row = observation + i * kObservationSize;
    for (int k = 0; k < kObservationSize; ++k) row[k] = (row[k] + sum[k]) * share;
  }
}

void LowLevelFlight::SetTargets(const float* action, Tile flight, Tile sensed,
                                Scratch& scratch) const {
  SKEIN_DISPATCH(SetTargetsKernel)
  (high_level_, action, flight, sensed, scratch.targets(flight.count));
}

void LowLevelFlight::Act(int first, const KernelAircraft& aircraft, Tile flight,
                         const ObservationNoise& noise, const PlantTile& plants, Scratch& scratch) {
  // Of the Control task's columns, those that its errors are made of.
  control_->Errors(flight, scratch.targets(flight.count), scratch.error[0], kMaxCount);
  ObserveTile(aircraft, flight, {scratch.error[0], kMaxCount}, noise, scratch.observation, plants);
  low_level_->Act(flight.count, scratch.observation, state_.data() + StateBegin(first),
                  scratch.action);
}

}  // namespace skein
#endif
