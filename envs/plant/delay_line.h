// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "envs/plant/plant_columns.h"
#include "envs/state/state.h"

namespace skein {

/// Throttle and sticks, in the order of PilotColumns.
inline constexpr int kNumDelayedCommands = 4;

/// The longest delays, control steps, and with them what is remembered.
struct Delays {
  int action = 0, observation = 0;
  bool windy = false;        ///< the velocity relative to the air is a state of its own
  bool over_ground = false;  ///< position and velocity over the ground are observed

  /// Columns of the flight that sensors and errors read; 0 where nothing is observed late.
  int state_columns() const;
  /// Columns of all control steps that are remembered.
  int columns() const;
};

/// Where two rings of control steps have been written last.
struct NewestSlots {
  std::int32_t action = 0, state = 0;
};

/// What a block's aircraft were commanded and were in the control steps before: a ring of commands
/// and behind it one of states, as many slots each as their longest delay, of columns as long as
/// the block's stride. A view; the memory lies with the block.
struct DelayLine {
  Delays delays;
  float* base = nullptr;
  std::size_t stride = 0;
  NewestSlots* newest = nullptr;

  /// A column of the slot that was written as the `age`-th last, from 1 on: at the end of a policy
  /// step that of so many control steps ago.
  float* Command(int age, int column) const;
  float* State(int age, int column) const;
  /// The `index`-th of all delays.columns(), the newest first in each ring.
  float* Column(int index) const;
};

/// An episode of aircraft `i` begins: it has always been as `flight` has it, with these commands.
void FillDelayLine(const DelayLine& line, const Tile& flight,
                   const std::array<float, kNumDelayedCommands>& commands, int i);

/// A control step begins with the commands in columns `command_stride` apart: they are remembered
/// in place of the oldest, and what reaches each aircraft, those of its kPlantActionDelay control
/// steps before, goes to `delayed`. Only where actions are delayed.
void DelayCommands(const DelayLine& line, const PlantTile& plants, int count, const float* command,
                   std::size_t command_stride, float* delayed);

/// A control step begins: remembers the state in place of the oldest. Only where observations are
/// delayed, as what follows.
void RememberState(const DelayLine& line, const Tile& flight);

/// The state that each aircraft's sensors show, that of kPlantObservationDelay control steps
/// before: the columns that observations and errors read go to `sensed`.
void DelayState(const DelayLine& line, const PlantTile& plants, const Tile& flight,
                const Tile& sensed);

}  // namespace skein
