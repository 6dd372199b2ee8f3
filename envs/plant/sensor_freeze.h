// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "envs/plant/plant_columns.h"

namespace skein {

// Sensors that keep their last value. Observations are row-major, [count][observation_size].

/// Whether a sensor of the tile freezes within the next `ahead` control steps, or now: `step` are
/// those flown.
bool AnySensorFreezes(const PlantTile& plants, int count, const std::int32_t* step, int ahead);

/// Freezes those sensors: from now on each shows what `observation` has.
/// `observation` points at where number 0 of the first row would be (envs/tasks/observation.h).
void FreezeSensors(const PlantTile& plants, int count, const std::int32_t* step,
                   const float* observation, int observation_size);

/// Puts what the frozen sensor of aircraft `i` holds into its row of observations, of which `row`
/// is where number 0 would be.
void ShowFrozenSensor(const PlantTile& plants, int i, float* row);

}  // namespace skein
