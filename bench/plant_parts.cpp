// SPDX-License-Identifier: Apache-2.0
#include "bench/plant_parts.h"

#include <benchmark/benchmark.h>

#include <algorithm>

#include "envs/kernels/kernel_aircraft.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/plant_parts.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/plant_kernel_air_data-inl.h"
#include "envs/kernels/plant_kernel_block-inl.h"
#include "envs/kernels/plant_kernel_engine-inl.h"
#include "envs/kernels/plant_kernel_equations-inl.h"
#include "envs/kernels/plant_kernel_tables-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using namespace plant_kernel;  // NOLINT: as in plant_kernel.cpp
static_assert(bench::kPlantBlock == kLanesPerBlock, "the public header's blocks are the kernel's");

struct IgnoreCoefficients {
  HWY_INLINE void operator()(int /*lane*/, const Coefficients& /*c*/) const {}
};

BlockControls ControlsOf(const Tile& tile, int first) {
  return {nullptr,
          tile[kPowerCommand] + first,
          tile[kElevator] + first,
          tile[kAileron] + first,
          tile[kRudder] + first,
          tile[kLeadingEdgeFlap] + first};
}

/// Keeps the compiler from leaving out what fills the block, or from doing it once for all rounds.
HWY_INLINE void Touch(KernelBlock* block) {
  benchmark::DoNotOptimize(block);
  benchmark::ClobberMemory();
}

void RunStagePartKernel(bench::StagePart part, const KernelAircraft& aircraft, Tile tile,
                        int rounds) {
  KernelBlock block;
  const BlockControls controls = ControlsOf(tile, 0);
  const StageState<kFirstStage> first{tile.base, tile.stride, &block, 0};
  for (int lane = 0; lane < kLanesPerBlock; lane += kLanes)
    LocateSurfaces(aircraft, controls, NominalPlant(), lane, &block);
  MeasureFlowAngles(aircraft, first, &block);
  MeasureDynamicPressure<true>(aircraft, first, &block);
  ThrustAndPowerRate<true>(aircraft, first, controls, &block);
  ReadTables(aircraft, &block);
  EvaluateStateRates(aircraft.constants, first, block, IgnoreCoefficients());

  // A step of no time: the rounds find the state as it is.
  const StageState<kMiddleStage> middle{tile.base, tile.stride, &block, 0};
  Touch(&block);
  for (int round = 0; round < rounds; ++round) {
    switch (part) {
      case bench::StagePart::kAirData:
        MeasureFlowAngles(aircraft, middle, &block);
        MeasureDynamicPressure<true>(aircraft, middle, &block);
        break;
      case bench::StagePart::kEngine:
        ThrustAndPowerRate<true>(aircraft, middle, controls, &block);
        break;
      case bench::StagePart::kAerodynamicsAndEquations:
        EvaluateStateRates(aircraft.constants, middle, block, IgnoreCoefficients());
        break;
    }
    Touch(&block);
  }
}

void FindTableCellsKernel(const KernelAircraft& aircraft, Tile tile, std::int32_t* cell_slot,
                          std::int32_t* alpha_cell) {
  KernelBlock block;
  for (int first = 0; first < tile.count; first += kLanesPerBlock) {
    MeasureFlowAngles(aircraft, StageState<kFirstStage>{tile.base + first, tile.stride, &block, 0},
                      &block);
    std::copy_n(block.cell_slot, kLanesPerBlock, cell_slot + first);
    std::copy_n(block.alpha_cell, kLanesPerBlock, alpha_cell + first);
  }
}

void ReadTablesOfKernel(const KernelAircraft& aircraft, Tile tile, const std::int32_t* cell_slot,
                        const std::int32_t* alpha_cell) {
  KernelBlock block;
  for (int first = 0; first < tile.count; first += kLanesPerBlock) {
    const BlockControls controls = ControlsOf(tile, first);
    for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
      LocateSurfaces(aircraft, controls, NominalPlant(), lane, &block);
    }
    std::copy_n(cell_slot + first, kLanesPerBlock, block.cell_slot);
    std::copy_n(alpha_cell + first, kLanesPerBlock, block.alpha_cell);
    ReadTables(aircraft, &block);
    Touch(&block);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(RunStagePartKernel);
HWY_EXPORT(FindTableCellsKernel);
HWY_EXPORT(ReadTablesOfKernel);

void bench::RunStagePart(StagePart part, const KernelAircraft& aircraft, Tile tile, int rounds) {
  SKEIN_DISPATCH(RunStagePartKernel)(part, aircraft, tile, rounds);
}

void bench::FindTableCells(const KernelAircraft& aircraft, Tile tile, std::int32_t* cell_slot,
                           std::int32_t* alpha_cell) {
  SKEIN_DISPATCH(FindTableCellsKernel)(aircraft, tile, cell_slot, alpha_cell);
}

void bench::ReadTablesOf(const KernelAircraft& aircraft, Tile tile, const std::int32_t* cell_slot,
                         const std::int32_t* alpha_cell) {
  SKEIN_DISPATCH(ReadTablesOfKernel)(aircraft, tile, cell_slot, alpha_cell);
}

}  // namespace skein
#endif
