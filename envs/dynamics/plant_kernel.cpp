#include "envs/dynamics/plant_kernel.h"

#include <hwy/cache_control.h>

#include <cstddef>

#include "envs/dynamics/kernel_aircraft.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/dynamics/plant_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/dynamics/plant_kernel_air-inl.h"
#include "envs/dynamics/plant_kernel_block-inl.h"
#include "envs/dynamics/plant_kernel_motion-inl.h"
#include "envs/dynamics/plant_kernel_tables-inl.h"
#include "simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using namespace plant_kernel;  // NOLINT: one room, split into files by phase

/// One evaluation of the equations of motion for a block, phase by phase.
template <bool kEngine, bool kFirst>
HWY_NOINLINE void EvaluateBlock(const KernelAircraft& aircraft, const StageState<kFirst>& state,
                                const BlockControls& controls, Block* block,
                                float (*rates)[kBlock]) {
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    FindFlow(aircraft, state, controls, lane, block);
  }
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    FindAir<kEngine>(aircraft, state, lane, block);
  }
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    FindThrust<kEngine>(aircraft, state, controls, lane, block, rates);
  }
  for (int lane = 0; lane < kBlock; lane += kLanes) ReadTables(aircraft, lane, block);
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    FindRates(aircraft, state, controls, lane, block, rates);
  }
}

/// y = start + dt/6 (k1 + 2 k2 + 2 k3 + k4).
HWY_INLINE V Advanced(const float* column, const Block& block, int index, int lane, float dt) {
  const FloatTag d;
  const auto k = [&](int stage) HWY_ATTR { return hn::Load(d, block.rates[stage][index] + lane); };
  const V outer = hn::Add(k(0), k(3));
  const V inner = hn::Add(k(1), k(2));
  const V change = hn::MulAdd(Constant(dt / 6), outer, hn::Mul(Constant(dt / 3), inner));
  return hn::Add(hn::LoadU(d, column + lane), change);
}

/// Moves the state columns of a block on by one step and renormalises the quaternions.
template <int kColumns>
HWY_INLINE void AdvanceBlock(float* base, std::size_t stride, const Block& block, float dt) {
  const FloatTag d;
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    for (int column = 0; column < kColumns; ++column) {
      if (kQ0 <= column && column <= kQz) continue;
      float* values = base + static_cast<std::size_t>(column) * stride;
      hn::StoreU(Advanced(values, block, column, lane, dt), d, values + lane);
    }
    float* values = base + static_cast<std::size_t>(kQ0) * stride;
    const V q0 = Advanced(values, block, kQ0, lane, dt);
    const V qx = Advanced(values + stride, block, kQx, lane, dt);
    const V qy = Advanced(values + 2 * stride, block, kQy, lane, dt);
    const V qz = Advanced(values + 3 * stride, block, kQz, lane, dt);
    const V square = hn::MulAdd(q0, q0, hn::MulAdd(qx, qx, hn::MulAdd(qy, qy, hn::Mul(qz, qz))));
    const V scale = ReciprocalSqrt(d, square);
    hn::StoreU(hn::Mul(q0, scale), d, values + lane);
    hn::StoreU(hn::Mul(qx, scale), d, values + stride + lane);
    hn::StoreU(hn::Mul(qy, scale), d, values + 2 * stride + lane);
    hn::StoreU(hn::Mul(qz, scale), d, values + 3 * stride + lane);
  }
}

/// One RK4 step of a block.
template <bool kEngine>
HWY_INLINE void StepBlock(const KernelAircraft& aircraft, const BlockControls& controls,
                          float* base, std::size_t stride, float dt, Block* block) {
  EvaluateBlock<kEngine>(aircraft, StageState<true>{base, stride, nullptr, 0}, controls, block,
                         block->rates[0]);
  const float steps[] = {dt / 2, dt / 2, dt};
  for (int stage = 1; stage < 4; ++stage) {
    EvaluateBlock<kEngine>(
        aircraft, StageState<false>{base, stride, block->rates[stage - 1], steps[stage - 1]},
        controls, block, block->rates[stage]);
  }
  AdvanceBlock<kEngine ? kNumIntegrated : kNumRigidBody>(base, stride, *block, dt);
}

/// Specific forces of the last evaluation, g.
HWY_INLINE void StoreLoadFactors(const KernelConstants& k, const Block& block, float* nz,
                                 float* ny) {
  const FloatTag d;
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    const V g = hn::Mul(hn::Load(d, block.force + lane), Constant(k.inverse_weight));
    hn::StoreU(hn::Neg(hn::Mul(g, hn::Load(d, block.coefficients[2] + lane))), d, nz + lane);
    hn::StoreU(hn::Mul(g, hn::Load(d, block.coefficients[1] + lane)), d, ny + lane);
  }
}

/// Starts loading the next block's columns: more streams than the processor follows by itself.
HWY_INLINE void PrefetchColumns(Tile tile, int first) {
  if (first >= tile.count) return;
  for (int column = 0; column <= kNy; ++column) {
    const float* values = tile[column] + first;
    hwy::Prefetch(values);
    hwy::Prefetch(values + kBlock / 2);
  }
}

void EvaluateTileKernel(const KernelAircraft& aircraft, Tile tile, const ControlColumns& controls,
                        float* state_rate, float* coefficients) {
  const FloatTag d;
  Block block;
  for (int first = 0; first < tile.count; first += kBlock) {
    const BlockControls at{controls.thrust_lbf + first,   nullptr,
                           controls.elevator_deg + first, controls.aileron_deg + first,
                           controls.rudder_deg + first,   controls.leading_edge_flap_deg + first};
    EvaluateBlock<false>(aircraft, StageState<true>{tile.base + first, tile.stride, nullptr, 0}, at,
                         &block, block.rates[0]);
    for (int lane = 0; lane < kBlock; lane += kLanes) {
      const std::size_t i = static_cast<std::size_t>(first + lane);
      for (int column = 0; column < kNumRigidBody; ++column) {
        hn::StoreU(hn::Load(d, block.rates[0][column] + lane), d,
                   state_rate + column * tile.stride + i);
      }
      for (int c = 0; c < 6; ++c) {
        hn::StoreU(hn::Load(d, block.coefficients[c] + lane), d,
                   coefficients + c * tile.stride + i);
      }
    }
  }
}

void StepTileOpenLoopKernel(const KernelAircraft& aircraft, Tile tile,
                            const ControlColumns& controls, float dt, int substeps) {
  Block block;
  for (int first = 0; first < tile.count; first += kBlock) {
    const BlockControls at{controls.thrust_lbf + first,   nullptr,
                           controls.elevator_deg + first, controls.aileron_deg + first,
                           controls.rudder_deg + first,   controls.leading_edge_flap_deg + first};
    for (int substep = 0; substep < substeps; ++substep) {
      StepBlock<false>(aircraft, at, tile.base + first, tile.stride,
                       dt / static_cast<float>(substeps), &block);
    }
  }
}

void StepTileKernel(const KernelAircraft& aircraft, Tile tile, float dt, int substeps) {
  Block block;
  for (int first = 0; first < tile.count; first += kBlock) {
    const BlockControls at{nullptr,
                           tile[kPowerCommand] + first,
                           tile[kElevator] + first,
                           tile[kAileron] + first,
                           tile[kRudder] + first,
                           tile[kLeadingEdgeFlap] + first};
    PrefetchColumns(tile, first + kBlock);
    for (int substep = 0; substep < substeps; ++substep) {
      StepBlock<true>(aircraft, at, tile.base + first, tile.stride,
                      dt / static_cast<float>(substeps), &block);
    }
    StoreLoadFactors(aircraft.constants, block, tile[kNz] + first, tile[kNy] + first);
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

void StepTile(const KernelAircraft& aircraft, Tile tile, float dt, int substeps) {
  SKEIN_DISPATCH(StepTileKernel)(aircraft, tile, dt, substeps);
}

}  // namespace skein
#endif
