// SPDX-License-Identifier: Apache-2.0
#include "envs/kernels/plant_kernel.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "envs/kernels/kernel_aircraft.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/kernels/plant_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/plant_kernel_air_data-inl.h"
#include "envs/kernels/plant_kernel_block-inl.h"
#include "envs/kernels/plant_kernel_engine-inl.h"
#include "envs/kernels/plant_kernel_equations-inl.h"
#include "envs/kernels/plant_kernel_tables-inl.h"
#include "envs/state/air_velocity-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using namespace plant_kernel;  // NOLINT: one room, split into files by phase

/// One evaluation of the equations of motion for a block, phase by phase.
template <bool kEngine, class State, class Observer>
HWY_NOINLINE void EvaluateBlock(const KernelAircraft& aircraft, const State& given,
                                const BlockControls& controls, const Observer& coefficients) {
  // A copy of its own: stores of vectors may alias anything, so that what lies behind a reference
  // is loaded anew after each of them. In the first stage the copy makes slower code.
  using Held = std::conditional_t<State::kStage == kFirstStage, const State&, const State>;
  Held state = given;
  MeasureFlowAngles(aircraft, state, state.block);
  MeasureDynamicPressure<kEngine>(aircraft, state, state.block);
  ThrustAndPowerRate<kEngine>(aircraft, state, controls, state.block);
  // Here, not as soon as the cells are known: meanwhile the chains that find them end.
  if constexpr (State::kStage == kFirstStage) ReadTables(aircraft, state.block);
  if constexpr (kEngine) {
    if (HWY_UNLIKELY(aircraft.depends_on_mach)) AddMachEffects(aircraft, state.block);
  }
  if (HWY_UNLIKELY(aircraft.constants.gravity_inverse_radius != 0)) {
    MeasureGravity(aircraft.constants, state, state.block);
  }
  EvaluateStateRates(aircraft.constants, state, *state.block, coefficients);
}

template <class Plant>
HWY_INLINE void LocateSurfacesOfBlock(const KernelAircraft& aircraft, const BlockControls& controls,
                                      const Plant& plant, KernelBlock* block) {
  for (int lane = 0; lane < kLanesPerBlock; lane += kLanes)
    LocateSurfaces(aircraft, controls, plant, lane, block);
}

/// An observer of the coefficients of a stage that ignores them.
struct IgnoreCoefficients {
  HWY_INLINE void operator()(int /*lane*/, const Coefficients& /*c*/) const {}
};

/// Keeps the specific forces, g.
template <class Plant>
struct StoreLoadFactors {
  const KernelConstants& k;
  const KernelBlock& block;
  Plant plant;
  float* nz;
  float* ny;

  HWY_INLINE void operator()(int lane, const Coefficients& c) const {
    const FloatTag d;
    const V inverse_weight = plant.Scaled(kPlantInverseMass, lane, Constant(k.inverse_weight));
    const V g = hn::Mul(hn::Load(d, block.qbar_S + lane), inverse_weight);
    hn::StoreU(hn::Neg(hn::Mul(g, c.Cz)), d, nz + lane);
    hn::StoreU(hn::Mul(g, c.Cy), d, ny + lane);
  }
};

/// Keeps the coefficients in columns.
struct StoreCoefficients {
  float* columns;
  std::size_t stride;

  HWY_INLINE void operator()(int lane, const Coefficients& c) const {
    const V values[] = {c.Cx, c.Cy, c.Cz, c.Cl, c.Cm, c.Cn};
    for (int k = 0; k < 6; ++k) {
      hn::StoreU(values[k], FloatTag(), columns + static_cast<std::size_t>(k) * stride + lane);
    }
  }
};

/// Starts loading the first columns of the block at `first`: more streams than the processor
/// follows by itself.
HWY_INLINE void PrefetchColumns(Tile tile, int num_columns, int first) {
  if (first >= tile.count) return;
  for (int column = 0; column < num_columns; ++column) {
    const float* values = tile[column] + first;
    hwy::Prefetch(values);
    hwy::Prefetch(values + kLanesPerBlock / 2);
  }
}

inline constexpr std::size_t kCacheLine = 64;

/// Memory to be fetched into the second-level cache, a part at a time: all at once would hold up
/// the kernel's own loads.
struct Prefetcher {
  MemoryAhead ahead;
  std::size_t part;  // bytes

  HWY_INLINE void FetchPart() {
    const std::size_t now = std::min(part, ahead.bytes);
    for (std::size_t i = 0; i < now; i += kCacheLine) __builtin_prefetch(ahead.begin + i, 0, 2);
    ahead.begin += now;
    ahead.bytes -= now;
  }
};

/// One RK4 step of a block.
template <bool kEngine, AirMotion kAir, class Plant, class Observer>
HWY_INLINE void StepBlock(const KernelAircraft& aircraft, const BlockControls& controls,
                          float* base, std::size_t stride, float dt, const Plant& plant,
                          const Observer& coefficients, Prefetcher* prefetcher,
                          KernelBlock* block) {
  const IgnoreCoefficients ignore;
  prefetcher->FetchPart();
  EvaluateBlock<kEngine>(aircraft,
                         StageState<kFirstStage, kAir, Plant>{base, stride, block, 0, plant},
                         controls, ignore);
  for (int middle = 0; middle < 2; ++middle) {
    prefetcher->FetchPart();
    EvaluateBlock<kEngine>(
        aircraft, StageState<kMiddleStage, kAir, Plant>{base, stride, block, dt / 2, plant},
        controls, ignore);
  }
  prefetcher->FetchPart();
  EvaluateBlock<kEngine>(aircraft,
                         StageState<kLastStage, kAir, Plant>{base, stride, block, dt, plant},
                         controls, coefficients);
}

void EvaluateTileKernel(const KernelAircraft& aircraft, Tile tile, const ControlColumns& controls,
                        float* state_rate, float* coefficients) {
  const FloatTag d;
  KernelBlock block;
  for (int first = 0; first < tile.count; first += kLanesPerBlock) {
    const BlockControls at{controls.thrust_lbf + first,   nullptr,
                           controls.elevator_deg + first, controls.aileron_deg + first,
                           controls.rudder_deg + first,   controls.leading_edge_flap_deg + first};
    LocateSurfacesOfBlock(aircraft, at, NominalPlant(), &block);
    EvaluateBlock<false>(aircraft,
                         StageState<kFirstStage>{tile.base + first, tile.stride, &block, 0}, at,
                         StoreCoefficients{coefficients + first, tile.stride});
    for (int column = 0; column < kNumRigidBody; ++column) {
      float* rates = state_rate + static_cast<std::size_t>(column) * tile.stride + first;
      for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
        hn::StoreU(hn::Load(d, block.rate[column] + lane), d, rates + lane);
      }
    }
  }
}

void StepTileOpenLoopKernel(const KernelAircraft& aircraft, Tile tile,
                            const ControlColumns& controls, float dt, int substeps) {
  KernelBlock block;
  Prefetcher prefetcher{};
  for (int first = 0; first < tile.count; first += kLanesPerBlock) {
    const BlockControls at{controls.thrust_lbf + first,   nullptr,
                           controls.elevator_deg + first, controls.aileron_deg + first,
                           controls.rudder_deg + first,   controls.leading_edge_flap_deg + first};
    LocateSurfacesOfBlock(aircraft, at, NominalPlant(), &block);
    for (int substep = 0; substep < substeps; ++substep) {
      StepBlock<false, kStillAir>(aircraft, at, tile.base + first, tile.stride,
                                  dt / static_cast<float>(substeps), NominalPlant(),
                                  IgnoreCoefficients(), &prefetcher, &block);
    }
  }
}

template <AirMotion kAir, bool kDrawn>
HWY_NOINLINE void StepTileIn(const KernelAircraft& aircraft, Tile tile, float dt, int substeps,
                             MemoryAhead ahead, const PlantTile& plants) {
  KernelBlock block;
  const int parts = 4 * ((tile.count + kLanesPerBlock - 1) / kLanesPerBlock);
  Prefetcher prefetcher{
      ahead, ahead.bytes / static_cast<std::size_t>(parts) / kCacheLine * kCacheLine + kCacheLine};
  for (int first = 0; first < tile.count; first += kLanesPerBlock) {
    const BlockControls at{nullptr,
                           tile[kPowerCommand] + first,
                           tile[kElevator] + first,
                           tile[kAileron] + first,
                           tile[kRudder] + first,
                           tile[kLeadingEdgeFlap] + first};
    BlockPlant<kDrawn> plant;
    if constexpr (kDrawn) plant = {plants.columns.base + first, plants.columns.stride};
    const StoreLoadFactors<BlockPlant<kDrawn>> load_factors{aircraft.constants, block, plant,
                                                            tile[kNz] + first, tile[kNy] + first};
    PrefetchColumns(tile, kNy + 1, first + kLanesPerBlock);
    if constexpr (kDrawn) {
      PrefetchColumns(plants.columns, kPlantDensity + 1, first + kLanesPerBlock);
    }
    LocateSurfacesOfBlock(aircraft, at, plant, &block);
    for (int substep = 0; substep < substeps; ++substep) {
      StepBlock<true, kAir>(aircraft, at, tile.base + first, tile.stride,
                            dt / static_cast<float>(substeps), plant, load_factors, &prefetcher,
                            &block);
    }
    if constexpr (kAir != kStillAir) {
      for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
        UpdateAirVelocity(FloatTag(), tile, first + lane);
      }
    }
  }
}

template <bool kDrawn>
HWY_INLINE void StepTileOf(const KernelAircraft& aircraft, Tile tile, float dt, int substeps,
                           MemoryAhead ahead, const PlantTile& plants) {
  if (tile.rotational_gusts) {
    StepTileIn<kTurningAir, kDrawn>(aircraft, tile, dt, substeps, ahead, plants);
  } else if (tile.windy) {
    StepTileIn<kMovingAir, kDrawn>(aircraft, tile, dt, substeps, ahead, plants);
  } else {
    StepTileIn<kStillAir, kDrawn>(aircraft, tile, dt, substeps, ahead, plants);
  }
}

void StepTileKernel(const KernelAircraft& aircraft, Tile tile, float dt, int substeps,
                    MemoryAhead ahead, const PlantTile& plants) {
  if (plants.is_drawn()) {
    StepTileOf<true>(aircraft, tile, dt, substeps, ahead, plants);
  } else {
    StepTileOf<false>(aircraft, tile, dt, substeps, ahead, plants);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(EvaluateTileKernel);
HWY_EXPORT(StepTileOpenLoopKernel);
HWY_EXPORT(StepTileKernel);

void EvaluateTile(const KernelAircraft& aircraft, Tile tile, const ControlColumns& controls,
                  float* state_rate, float* coefficients) {
  SKEIN_DISPATCH(EvaluateTileKernel)(aircraft, tile, controls, state_rate, coefficients);
}

void StepTileOpenLoop(const KernelAircraft& aircraft, Tile tile, const ControlColumns& controls,
                      float dt, int substeps) {
  SKEIN_DISPATCH(StepTileOpenLoopKernel)(aircraft, tile, controls, dt, substeps);
}

void StepTile(const KernelAircraft& aircraft, Tile tile, float dt, int substeps, MemoryAhead ahead,
              const PlantTile& plants) {
  SKEIN_DISPATCH(StepTileKernel)(aircraft, tile, dt, substeps, ahead, plants);
}

}  // namespace skein
#endif
