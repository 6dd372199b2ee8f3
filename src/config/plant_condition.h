// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/plant/plant_config.h"
#include "src/config/condition_level.h"

namespace skein {

/// What levels of the condition `plant` look like.
inline constexpr const char* kPlantForm =
    "a share of the middle level (0.5; 0 is the nominal plant), or quantities with a value or "
    "range "
    "each (mass:0.9..1.1,cg_shift:-0.05..0.05), or mild, middle, hard";

/// The assignments of every key of env.plant: what the level does not name is nominal, whatever the
/// configuration has. Throws Error on what cannot be read.
std::vector<std::string> PlantAssignments(const LevelRequest& request, const std::string& level);

/// In short what is not nominal: "plant: cg_shift -0.05 to 0.05, mass 1.05" of three quantities at
/// most, "plant at 0.5 of the middle level", or how many quantities; empty if there are none.
std::string DescribePlant(const PlantConfig& plant);

}  // namespace skein
