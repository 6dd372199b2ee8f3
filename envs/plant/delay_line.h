// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
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
  bool windy = false;  ///< the velocity relative to the air is a state of its own

  /// Control steps remembered.
  int slots() const { return std::max(action, observation); }
  /// Columns of one: states only where they are observed late, and commands.
  int state_columns() const;
  int slot_columns() const { return state_columns() + kNumDelayedCommands; }
};

/// What a block's aircraft were and were commanded in the control steps before: a ring of slots,
/// each of columns as long as the block's stride. A view; the memory lies with the block.
struct DelayLine {
  Delays delays;
  float* base = nullptr;
  std::size_t stride = 0;
  std::int32_t* newest = nullptr;  ///< index of the slot written last

  /// A column of the slot written `age` control steps ago, from 1 on.
  float* Column(int age, int column) const;
};

/// An episode of aircraft `i` begins: it has always been as `flight` has it, with these commands.
void FillDelayLine(const DelayLine& line, const Tile& flight,
                   const std::array<float, kNumDelayedCommands>& commands, int i);

/// A control step begins: remembers the state and its commands, columns `command_stride` apart, in
/// place of the oldest.
void PushDelayLine(const DelayLine& line, const Tile& flight, const float* command,
                   std::size_t command_stride);

/// The commands that reach each aircraft: those of its kPlantActionDelay control steps before, or
/// `command`. To be called before they are pushed.
void DelayCommands(const DelayLine& line, const PlantTile& plants, int count, const float* command,
                   std::size_t command_stride, float* delayed);

/// The state that each aircraft's sensors show, that of kPlantObservationDelay control steps
/// before: the columns of the rigid body, power, surfaces and velocity relative to the air go to
/// `sensed`.
void DelayState(const DelayLine& line, const PlantTile& plants, const Tile& flight,
                const Tile& sensed);

}  // namespace skein
