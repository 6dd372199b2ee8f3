// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "envs/air/atmosphere.h"
#include "envs/air/gravity.h"
#include "envs/aircraft/aircraft.h"
#include "envs/plant/plant_columns.h"
#include "envs/state/state.h"

namespace skein {

/// An aircraft arranged for the SIMD kernels: float32 node lines on one alpha x beta grid, the
/// engine tables and every constant. Immutable once made, shared by all tiles and threads. Opaque
/// outside the kernels.
struct KernelAircraft;

/// Throws Error if the aircraft's tables do not fit the kernels' arrangement (kernel_aircraft.h).
std::shared_ptr<const KernelAircraft> MakeKernelAircraft(const Aircraft& aircraft,
                                                         AtmosphereModel atmosphere,
                                                         const Gravity& gravity = {});

/// Floating-point operations for one aircraft of one evaluation of the equations of motion with
/// given thrust, and of one RK4 step with engine, for rates as a fraction of simd::MeasurePeak. As
/// written for the scalar target, whatever a target's estimates of reciprocals add: a multiply-add
/// is two; an addition, product, division, root, minimum or maximum is one; comparisons,
/// selections, conversions and integers are none. tests/envs/kernels/operation_count_test.cpp
/// counts them.
inline constexpr double kFlopsPerEvaluation = 595;
inline constexpr double kFlopsPerRk4Step = 1922;

/// Read-only columns of given controls: thrust [lbf], elevator, aileron, rudder, leading-edge flap
/// [deg], each `count` long (padded as Tile says).
struct ControlColumns {
  const float* thrust_lbf = nullptr;
  const float* elevator_deg = nullptr;
  const float* aileron_deg = nullptr;
  const float* rudder_deg = nullptr;
  const float* leading_edge_flap_deg = nullptr;
};

/// One evaluation of the equations of motion for the thirteen rigid-body columns of `tile` with
/// given controls in still air, without drag rise; within 2e-4 of the float64 Plant, relative to
/// the larger of a quantity's value and 1 % of its largest, on every SIMD target. `state_rate` gets
/// 13 columns and `coefficients` 6 (Cx, Cy, Cz, Cl, Cm, Cn), each of `tile.stride`.
void EvaluateTile(const KernelAircraft& aircraft, Tile tile, const ControlColumns& controls,
                  float* state_rate, float* coefficients);

/// `substeps` RK4 steps of dt / substeps seconds each with given, held controls (no engine) in
/// still air, without drag rise: the kernel of `skein fdm simulate`.
void StepTileOpenLoop(const KernelAircraft& aircraft, Tile tile, const ControlColumns& controls,
                      float dt, int substeps);

/// Memory that the caller works on next.
struct MemoryAhead {
  const std::byte* begin = nullptr;
  std::size_t bytes = 0;
};

/// `substeps` RK4 steps of dt / substeps seconds each: rigid body and engine power (lag towards
/// kPowerCommand, thrust by power, altitude and Mach at every stage) with the surfaces held at the
/// columns' positions, in the wind and rotational gusts of the tile's columns. Afterwards kNz and
/// kNy hold the specific forces of the last stage of the last step, which is what the
/// accelerometers read at the next control step, and kAirU, kAirV, kAirW of a windy tile are up to
/// date. On the way `ahead` is fetched into the caches: many aircraft would else wait for memory.
/// `plants` may be drawn.
void StepTile(const KernelAircraft& aircraft, Tile tile, float dt, int substeps,
              MemoryAhead ahead = {}, const PlantTile& plants = {});

}  // namespace skein
