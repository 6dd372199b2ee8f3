// SPDX-License-Identifier: Apache-2.0
#include "envs/plant/delay_line.h"

#include "envs/plant/plant_config.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/plant/delay_line.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

#ifndef SKEIN_ENVS_PLANT_DELAYED_COLUMNS_
#define SKEIN_ENVS_PLANT_DELAYED_COLUMNS_
namespace skein {
namespace {

/// Of a slot: those of a windy flight to a point.
constexpr int kMostColumns = 21;

/// Columns of a slot's layout as they are now and as they are shown.
struct DelayedColumns {
  const float* now[kMostColumns];
  float* shown[kMostColumns];
  int count;
  std::size_t stride;  // between the columns of a slot
};

/// The slots of 1, 2, ... control steps ago: beyond the longest delay, which nobody asks for, the
/// oldest again.
struct Slots {
  float* begin[kLongestDelay];
  int longest;
};

}  // namespace
}  // namespace skein
#endif  // SKEIN_ENVS_PLANT_DELAYED_COLUMNS_

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// Shows each aircraft its columns of `delay` control steps ago, kLongest at most, and, if
/// `remembers`, puts the present ones in place of the oldest.
template <int kLongest>
HWY_INLINE void SelectUpTo(const DelayedColumns& columns, const Slots& slots, bool remembers,
                           const float* delay, int count) {
  const FloatTag d;
  for (int c = 0; c < columns.count; ++c) {
    const std::size_t column = static_cast<std::size_t>(c) * columns.stride;
    const float* old[kLongest];
    for (int k = 0; k < kLongest; ++k) old[k] = slots.begin[k] + column;
    float* const oldest = slots.begin[kLongest - 1] + column;
    for (int first = 0; first < count; first += kLanes) {
      const V steps = hn::LoadU(d, delay + first);
      const V now = hn::LoadU(d, columns.now[c] + first);
      V value = now;
      for (int k = 0; k < kLongest; ++k) {
        const Mask is_asked = hn::Eq(steps, Constant(k + 1));
        value = hn::IfThenElse(is_asked, hn::LoadU(d, old[k] + first), value);
      }
      hn::StoreU(value, d, columns.shown[c] + first);
      if (remembers) hn::StoreU(now, d, oldest + first);
    }
  }
}

void SelectDelayed(const DelayedColumns& columns, const Slots& slots, bool remembers,
                   const float* delay, int count) {
  switch (slots.longest) {
    case 1:
      return SelectUpTo<1>(columns, slots, remembers, delay, count);
    case 2:
      return SelectUpTo<2>(columns, slots, remembers, delay, count);
    case 3:
      return SelectUpTo<3>(columns, slots, remembers, delay, count);
    default:
      return SelectUpTo<kLongestDelay>(columns, slots, remembers, delay, count);
  }
}

/// Copies `count` aircraft's columns into a slot.
void Remember(const DelayedColumns& columns, float* slot, int count) {
  const FloatTag d;
  for (int c = 0; c < columns.count; ++c) {
    float* const to = slot + static_cast<std::size_t>(c) * columns.stride;
    for (int first = 0; first < count; first += kLanes) {
      hn::StoreU(hn::LoadU(d, columns.now[c] + first), d, to + first);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(SelectDelayed);
HWY_EXPORT(Remember);

namespace {

// What observations read of every flight beside the velocity, what those of positions and
// velocities over the ground read beside, and what of these only in wind is no velocity relative to
// the air.
constexpr int kObserved[] = {
    kP, kQ, kR, kDown, kQ0, kQx, kQy, kQz, kPower, kElevator, kAileron, kRudder, kLeadingEdgeFlap};
constexpr int kPosition[] = {kNorth, kEast};
constexpr int kGroundVelocity[] = {kU, kV, kW};

/// The flight's columns that are remembered, in the order of a slot.
struct StateColumns {
  explicit StateColumns(const Delays& delays) {
    const int air = delays.windy ? kAirU : kU;
    for (int k = 0; k < 3; ++k) Add(air + k);
    for (const int column : kObserved) Add(column);
    if (!delays.over_ground) return;
    for (const int column : kPosition) Add(column);
    if (!delays.windy) return;
    for (const int column : kGroundVelocity) Add(column);
  }
  void Add(int column) { columns[count++] = column; }

  int columns[kMostColumns];
  int count = 0;
};

/// Where the slot of `age` lies in a ring.
int Slot(int newest, int slots, int age) { return (newest + slots - (age - 1)) % slots; }

/// The columns of `delays`, made once.
const StateColumns& StatesOf(const Delays& delays) {
  const auto make = [](bool windy, bool over_ground) {
    Delays of;
    of.windy = windy;
    of.over_ground = over_ground;
    return StateColumns(of);
  };
  static const StateColumns all[] = {make(false, false), make(false, true), make(true, false),
                                     make(true, true)};
  return all[2 * delays.windy + delays.over_ground];
}

template <class SlotOfAge>
Slots SlotsOf(int longest, const SlotOfAge& slot_of_age) {
  Slots slots;
  slots.longest = longest;
  for (int k = 0; k < kLongestDelay; ++k) {
    slots.begin[k] = k < longest ? slot_of_age(k + 1) : slots.begin[longest - 1];
  }
  return slots;
}

}  // namespace

int Delays::state_columns() const { return observation == 0 ? 0 : StatesOf(*this).count; }

int Delays::columns() const { return action * kNumDelayedCommands + observation * state_columns(); }

float* DelayLine::Command(int age, int column) const {
  const int slot = Slot(newest->action, delays.action, age);
  return base + static_cast<std::size_t>(slot * kNumDelayedCommands + column) * stride;
}

float* DelayLine::State(int age, int column) const {
  const int slot = Slot(newest->state, delays.observation, age);
  const int before = delays.action * kNumDelayedCommands;
  return base + static_cast<std::size_t>(before + slot * delays.state_columns() + column) * stride;
}

float* DelayLine::Column(int index) const {
  const int of_states = index - delays.action * kNumDelayedCommands;
  if (of_states < 0) return Command(1 + index / kNumDelayedCommands, index % kNumDelayedCommands);
  const int columns = delays.state_columns();
  return State(1 + of_states / columns, of_states % columns);
}

void FillDelayLine(const DelayLine& line, const Tile& flight,
                   const std::array<float, kNumDelayedCommands>& commands, int i) {
  for (int age = 1; age <= line.delays.action; ++age) {
    for (int c = 0; c < kNumDelayedCommands; ++c) {
      line.Command(age, c)[i] = commands[static_cast<std::size_t>(c)];
    }
  }
  const StateColumns& states = StatesOf(line.delays);
  for (int age = 1; age <= line.delays.observation; ++age) {
    for (int c = 0; c < states.count; ++c) line.State(age, c)[i] = flight[states.columns[c]][i];
  }
}

void DelayCommands(const DelayLine& line, const PlantTile& plants, int count, const float* command,
                   std::size_t command_stride, float* delayed) {
  const int longest = line.delays.action;
  DelayedColumns columns;
  columns.count = kNumDelayedCommands;
  columns.stride = line.stride;
  for (std::size_t c = 0; c < kNumDelayedCommands; ++c) {
    columns.now[c] = command + c * command_stride;
    columns.shown[c] = delayed + c * command_stride;
  }
  const Slots slots = SlotsOf(longest, [&](int age) { return line.Command(age, 0); });
  SKEIN_DISPATCH(SelectDelayed)(columns, slots, true, plants[kPlantActionDelay], count);
  line.newest->action = Slot(line.newest->action, longest, longest);
}

void RememberState(const DelayLine& line, const Tile& flight) {
  const int longest = line.delays.observation;
  line.newest->state = Slot(line.newest->state, longest, longest);
  const StateColumns& states = StatesOf(line.delays);
  DelayedColumns columns;
  columns.count = states.count;
  columns.stride = line.stride;
  for (int c = 0; c < states.count; ++c) columns.now[c] = flight[states.columns[c]];
  SKEIN_DISPATCH(Remember)(columns, line.State(1, 0), flight.count);
}

void DelayState(const DelayLine& line, const PlantTile& plants, const Tile& flight,
                const Tile& sensed) {
  const StateColumns& states = StatesOf(line.delays);
  DelayedColumns columns;
  columns.count = states.count;
  columns.stride = line.stride;
  for (int c = 0; c < states.count; ++c) {
    columns.now[c] = flight[states.columns[c]];
    columns.shown[c] = sensed[states.columns[c]];
  }
  const Slots slots = SlotsOf(line.delays.observation, [&](int age) { return line.State(age, 0); });
  SKEIN_DISPATCH(SelectDelayed)
  (columns, slots, false, plants[kPlantObservationDelay], flight.count);
}

}  // namespace skein
#endif
