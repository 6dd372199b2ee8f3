// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/lookup_tables.h"
#include "bench/report.h"
#include "envs/kernels/kernel_aircraft.h"
#include "envs/state/state.h"

namespace skein::bench {

/// Stages of an RK4 step.
inline constexpr int kStages = 4;

/// Where aircraft are in the tables at the stages of one step: columns of a Tile. Cells are whole
/// numbers as float.
enum PlaceColumn : int {
  kPlaceAlphaCell,
  kPlaceBetaCell,
  kPlaceElevatorCell,
  kPlaceElevatorFraction,
  kPlaceFlapUp,
  kPlaceAileron,
  kPlaceRudder,
  kPlaceAlphaFraction,  ///< kStages of them
  kPlaceBetaFraction = kPlaceAlphaFraction + kStages,
  kNumPlaceColumns = kPlaceBetaFraction + kStages
};

/// What is read: the functions of alpha, beta, elevator and the other surfaces that the build-up
/// adds dampings to, each summed over the stages. Columns of a Tile.
enum ReadingColumn : int {
  kReadCy,
  kReadCn,
  kReadCl,
  kReadCmFlap,
  kReadCx,
  kReadCz,
  kReadCm,
  kNumReadingColumns
};

/// How the aerodynamic tables may lie in memory and be read.
enum class LookupLayout {
  /// The plant kernel's: a cell's bilinear patches in whole lines, added up at the first stage.
  kPatchesOnceAStep,
  /// The same, at every stage.
  kPatchesEveryStage,
  /// The functions' values at a node in whole lines; four nodes blended at every stage.
  kNodeLines,
  /// An array for each function; a gather for each corner at every stage.
  kGathers,
};

/// Reads what a step needs for the aircraft of `places` into `readings`, by `layout`.
void ReadByLayout(LookupLayout layout, const KernelAircraft& aircraft, const LookupTables& tables,
                  Tile places, Tile readings);

/// Per aircraft and step; for kernels of sixteen lanes.
Cost CostOf(LookupLayout layout);

}  // namespace skein::bench
