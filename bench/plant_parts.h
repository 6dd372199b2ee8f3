// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "envs/kernels/plant_kernel.h"
#include "envs/state/state.h"

namespace skein::bench {

/// Parts of one stage of the plant kernel, each by itself, as at a middle stage of RK4: it adds the
/// previous stage's rates to the state and to the sum of rates.
enum class StagePart {
  kAirData,                   ///< flow angles, cells of the tables, dynamic pressure, Mach number
  kEngine,                    ///< thrust and the rate of power
  kAerodynamicsAndEquations,  ///< bilinear patches, coefficients, rates of the state
};

/// Aircraft of the blocks in which the plant kernel works.
inline constexpr int kPlantBlock = 32;

/// Runs `part` `rounds` times for the first kPlantBlock aircraft of `tile`, after one whole
/// evaluation. They stay in their cells, as nearly all aircraft do between the stages of a step.
void RunStagePart(StagePart part, const KernelAircraft& aircraft, Tile tile, int rounds);

/// Writes each aircraft's place in the aerodynamic tables, for ReadTablesOf: both `tile.stride`
/// long.
void FindTableCells(const KernelAircraft& aircraft, Tile tile, std::int32_t* cell_slot,
                    std::int32_t* alpha_cell);

/// What the plant kernel does with the aerodynamic tables once in a step: the meaning of the
/// surfaces' positions, the patches of each aircraft's cell added up, the functions of alpha.
void ReadTablesOf(const KernelAircraft& aircraft, Tile tile, const std::int32_t* cell_slot,
                  const std::int32_t* alpha_cell);

}  // namespace skein::bench
