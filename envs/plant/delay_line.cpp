// SPDX-License-Identifier: Apache-2.0
#include "envs/plant/delay_line.h"

#include <algorithm>

#include "envs/plant/plant_config.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/plant/delay_line.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// out = the line's column of `delay` control steps ago, `longest` at most, or where that is 0
/// `now`.
void SelectDelayed(const DelayLine& line, int column, int longest, const float* delay, int count,
                   const float* now, float* out) {
  const FloatTag d;
  const float* old[kLongestDelay];
  for (int k = 0; k < longest; ++k) old[k] = line.Column(k + 1, column);
  for (int first = 0; first < count; first += kLanes) {
    const V steps = hn::LoadU(d, delay + first);
    V value = hn::LoadU(d, now + first);
    for (int k = 0; k < longest; ++k) {
      const Mask is_asked = hn::Eq(steps, Constant(static_cast<float>(k + 1)));
      value = hn::IfThenElse(is_asked, hn::LoadU(d, old[k] + first), value);
    }
    hn::StoreU(value, d, out + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(SelectDelayed);

namespace {

constexpr int kNumDelayedStates = kLeadingEdgeFlap + 1;
constexpr int kNumAirVelocities = 3;

/// The flight's column that is remembered in a slot's column.
int FlightColumn(int slot_column) {
  return slot_column < kNumDelayedStates ? slot_column : kAirU + slot_column - kNumDelayedStates;
}

}  // namespace

int Delays::state_columns() const {
  if (observation == 0) return 0;
  return kNumDelayedStates + (windy ? kNumAirVelocities : 0);
}

float* DelayLine::Column(int age, int column) const {
  const int slots = delays.slots(), slot = (*newest + slots - (age - 1)) % slots;
  return base + static_cast<std::size_t>(slot * delays.slot_columns() + column) * stride;
}

void FillDelayLine(const DelayLine& line, const Tile& flight,
                   const std::array<float, kNumDelayedCommands>& commands, int i) {
  const int states = line.delays.state_columns();
  for (int age = 1; age <= line.delays.slots(); ++age) {
    for (int c = 0; c < states; ++c) line.Column(age, c)[i] = flight[FlightColumn(c)][i];
    for (int c = 0; c < kNumDelayedCommands; ++c) {
      line.Column(age, states + c)[i] = commands[static_cast<std::size_t>(c)];
    }
  }
}

void PushDelayLine(const DelayLine& line, const Tile& flight, const float* command,
                   std::size_t command_stride) {
  *line.newest = (*line.newest + 1) % line.delays.slots();
  const int states = line.delays.state_columns();
  for (int c = 0; c < states; ++c) {
    std::copy_n(flight[FlightColumn(c)], flight.count, line.Column(1, c));
  }
  for (std::size_t c = 0; c < kNumDelayedCommands; ++c) {
    std::copy_n(command + c * command_stride, flight.count,
                line.Column(1, states + static_cast<int>(c)));
  }
}

void DelayCommands(const DelayLine& line, const PlantTile& plants, int count, const float* command,
                   std::size_t command_stride, float* delayed) {
  const auto select = SKEIN_DISPATCH(SelectDelayed);
  for (std::size_t c = 0; c < kNumDelayedCommands; ++c) {
    select(line, line.delays.state_columns() + static_cast<int>(c), line.delays.action,
           plants[kPlantActionDelay], count, command + c * command_stride,
           delayed + c * command_stride);
  }
}

void DelayState(const DelayLine& line, const PlantTile& plants, const Tile& flight,
                const Tile& sensed) {
  const auto select = SKEIN_DISPATCH(SelectDelayed);
  for (int c = 0; c < line.delays.state_columns(); ++c) {
    const int column = FlightColumn(c);
    select(line, c, line.delays.observation, plants[kPlantObservationDelay], flight.count,
           flight[column], sensed[column]);
  }
}

}  // namespace skein
#endif
