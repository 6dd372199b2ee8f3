// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "bench/report.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/state/state.h"

namespace skein::bench {

/// Parts of one stage of the plant kernel, each by itself. They are counted as at a middle stage of
/// RK4, which adds the previous stage's rates to the state (two more operations and one more load
/// for each column) and to the sum of rates.
enum class StagePart {
  kAirData,              ///< flow angles, cells of the tables, density, dynamic pressure, Mach
  kEngine,               ///< thrust and the rate of power
  kBuildUpAndEquations,  ///< bilinear patches, coefficients, rates of the state
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

// Counted in envs/dynamics/plant_kernel_*-inl.h and air-inl.h; see Cost for the rules.

inline constexpr Cost kAirDataCost{4 * 2            // velocity and altitude at the stage
                                       + 22         // speed, its reciprocal, tangent of sideslip
                                       + 32 + 23    // alpha, beta
                                       + 2 * 9 + 3  // cells
                                       + 14         // density, speed of sound
                                       + 2 + 9,     // force of dynamic pressure, Mach number
                                   4 * (4 * 2       // velocity and altitude: start and rate
                                        + 1         // cell at the stage before
                                        + 2)        // speed, left by one loop for the next
                                       + 4 * 8};    // density's cubic

inline constexpr Cost kEngineCost{2 * 2         // altitude and power at the stage
                                      + 2 * 9   // cells
                                      + 2       // their number
                                      + 2 * 6   // patches
                                      + 1 + 2   // thrust
                                      + 6 + 2,  // rate of power, its sum
                                  4 * (2 * 2    // altitude, power
                                       + 3      // Mach number, command, cell before
                                       + 2 * 4  // patches
                                       + 1)};   // sum of rates

inline constexpr Cost kBuildUpAndEquationsCost{
    10 * 2            // velocity, angular rates, attitude at the stage
        + 62          // patches and functions of alpha
        + 34          // build-up
        + 125         // equations of motion
        + 13 * 2,     // sums of rates
    4 * (10 * 2       // state
         + 7 * 4      // patches
         + 10 * 2     // functions of alpha
         + 2 + 1 + 1  // fractions, speed, elevator's effect
         + 2          // forces
         + 13)};      // sums of rates

inline constexpr Cost kTableReadingCost{
    kFlopsPerTableReading,
    4 * 4                   // surfaces
        + 2 * 8             // elevator's effect
        + 9 * 64 + 11 * 4   // lines of patches; their places and multipliers, aircraft by aircraft
        + 38 * 8 + 2 * 4};  // functions of alpha: ten, and nine increments by the flap

/// A step of RK4 with engine: four stages, the tables read once.
inline constexpr Cost kRk4Cost{
    kFlopsPerRk4Step,
    kTableReadingCost.bytes_loaded + 4 * (kAirDataCost.bytes_loaded + kEngineCost.bytes_loaded +
                                          kBuildUpAndEquationsCost.bytes_loaded)};

}  // namespace skein::bench
