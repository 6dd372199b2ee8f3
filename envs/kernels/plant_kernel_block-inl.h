// SPDX-License-Identifier: Apache-2.0
// What the phases of the plant kernel share: the scratch memory of one block of aircraft and the
// state at one stage of the integration.

#if defined(SKEIN_ENVS_KERNELS_PLANT_KERNEL_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_KERNELS_PLANT_KERNEL_BLOCK_INL_H_
#undef SKEIN_ENVS_KERNELS_PLANT_KERNEL_BLOCK_INL_H_
#else
#define SKEIN_ENVS_KERNELS_PLANT_KERNEL_BLOCK_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "envs/kernels/kernel_aircraft.h"
#include "envs/plant/plant_columns.h"
#include "envs/state/air_velocity-inl.h"
#include "envs/state/state.h"
#include "simd/lookup-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace plant_kernel {

/// Aircraft that go through each phase together: the loads of one half's tables overlap with the
/// arithmetic of the other's.
inline constexpr int kLanesPerBlock = 32;
inline constexpr int kVectors = kLanesPerBlock / kLanes;
/// Integrated columns: the rigid body and the engine's power, kPower.
inline constexpr int kNumIntegrated = kPower + 1;

/// Sets of four functions of alpha and beta: the lateral and the longitudinal.
enum PatchSet : int { kLateral, kLongitudinal, kNumPatchSets };

/// The scratch memory of a block, in vectors of aircraft.
///
/// Alpha, beta, Mach number and altitude move by a small part of a table's cell in one step, and
/// the surfaces stand still. So a step reads the tables once, at its first stage, and adds up the
/// increments by the surfaces' positions: what is left are a few bilinear patches for each
/// aircraft. A stage that finds an aircraft in another cell reads that one's tables again.
struct alignas(64) KernelBlock {
  // Held during a step.
  float flap_up[kLanesPerBlock];  // 1 with the flap up, 0 at full
  float aileron[kLanesPerBlock], aileron_flap[kLanesPerBlock],
      rudder[kLanesPerBlock];  // of the tables' deflections
  float elevator_fraction[kLanesPerBlock], elevator_effect[kLanesPerBlock];
  std::int32_t elevator_slot[kLanesPerBlock];  // the interval's first slot, relative to the cell's
  float gravity[kLanesPerBlock];  // ft/s^2; where it falls with altitude, of the present stage

  // The cells that aircraft are in and the functions there.
  std::int32_t cell_slot[kLanesPerBlock];  // first slot of the aerodynamic cell
  std::int32_t alpha_cell[kLanesPerBlock];
  std::int32_t thrust_cell[kLanesPerBlock];  // and segment of power: see Thrust
  float patch[kNumPatchSets][PatchLine::kNumSlots][kLanesPerBlock];
  float alpha_value[kNumAlphaFunctions][kLanesPerBlock],
      alpha_step[kNumAlphaFunctions][kLanesPerBlock];
  float thrust_low[4][kLanesPerBlock], thrust_gain[4][kLanesPerBlock];

  // What one phase leaves for the next.
  float alpha_fraction[kLanesPerBlock], beta_fraction[kLanesPerBlock];
  float speed_squared[kLanesPerBlock];  // ft^2/s^2
  float inverse_speed[kLanesPerBlock];  // s/ft
  float mach[kLanesPerBlock];
  float qbar_S[kLanesPerBlock];  // dynamic pressure times wing area, lbf
  float thrust[kLanesPerBlock];  // lbf

  // The last stage's rates, and the weighted sum of the stages'.
  float rate[kNumIntegrated][kLanesPerBlock];
  float rate_sum[kNumIntegrated][kLanesPerBlock];
};

/// Columns of a block's controls, at its first aircraft. `thrust_lbf` where thrust is given, power
/// command where the engine makes it.
struct BlockControls {
  const float* thrust_lbf;
  const float* power_command;
  const float* elevator_deg;
  const float* aileron_deg;
  const float* rudder_deg;
  const float* leading_edge_flap_deg;
};

/// The drawn plants of a block's aircraft, or the nominal one, of which nothing is read.
template <bool kDrawnOf>
struct BlockPlant {
  static constexpr bool kDrawn = kDrawnOf;
  const float* base = nullptr;  // of the block's columns
  std::size_t stride = 0;

  HWY_INLINE V Get(PlantColumn column, int lane) const {
    return hn::LoadU(FloatTag(), base + static_cast<std::size_t>(column) * stride + lane);
  }
  /// `x` times the drawn factor; of the nominal plant `x` as it is.
  HWY_INLINE V Scaled(PlantColumn column, int lane, V x) const {
    if constexpr (kDrawn) {
      return hn::Mul(Get(column, lane), x);
    } else {
      return x;
    }
  }
};
using NominalPlant = BlockPlant<false>;

enum Stage : int { kFirstStage, kMiddleStage, kLastStage };

/// What the air does: nothing; moves; moves and turns.
enum AirMotion : int { kStillAir, kMovingAir, kTurningAir };

/// The state at one stage of the integration. It is not stored: `Get` adds `step` times the
/// previous stage's rates to the state at the start of the step, `Put` takes the rates at this
/// stage, after the last `Get` of the same column and lane.
template <Stage kStageOf, AirMotion kAir = kStillAir, class Plant = NominalPlant>
struct StageState {
  static constexpr Stage kStage = kStageOf;
  float* base;  // of the block's state columns
  std::size_t stride;
  KernelBlock* block;
  float step;  // s; at the last stage the whole step
  Plant plant = {};
  float sixth = step / 6;  // s; divided once, not for each column

  HWY_INLINE float* Column(int column, int lane) const {
    return base + static_cast<std::size_t>(column) * stride + lane;
  }

  HWY_INLINE V Get(int column, int lane) const {
    const FloatTag d;
    const V start = hn::LoadU(d, Column(column, lane));
    if constexpr (kStage == kFirstStage) {
      return start;
    } else {
      return hn::MulAdd(Constant(step), hn::Load(d, block->rate[column] + lane), start);
    }
  }

  /// Velocity relative to the air, which moves as at the start of the step.
  HWY_INLINE BodyVelocity<V> AirVelocity(int lane) const {
    const BodyVelocity<V> inertial{Get(kU, lane), Get(kV, lane), Get(kW, lane)};
    if constexpr (kAir != kStillAir) {
      const auto wind = [&](int column)
                            HWY_ATTR { return hn::LoadU(FloatTag(), Column(column, lane)); };
      const auto attitude =
          AttitudeMatrixOf(Get(kQ0, lane), Get(kQx, lane), Get(kQy, lane), Get(kQz, lane));
      return LessWind(inertial, attitude, wind(kWindNorth), wind(kWindEast), wind(kWindDown));
    } else {
      return inertial;
    }
  }

  /// The angular rate `column` relative to the air, which turns as at the start of the step.
  HWY_INLINE V RateThroughAir(int column, int lane) const {
    const V rate = Get(column, lane);
    if constexpr (kAir == kTurningAir) {
      const int of_air = kGustRollRate + column - kP;
      return hn::Sub(rate, hn::LoadU(FloatTag(), Column(of_air, lane)));
    } else {
      return rate;
    }
  }

  /// The state at the end of the step: start + step / 6 (k1 + 2 k2 + 2 k3 + k4).
  HWY_INLINE V End(int column, int lane, V rate) const {
    const FloatTag d;
    const V sum = hn::Add(rate, hn::Load(d, block->rate_sum[column] + lane));
    return hn::MulAdd(Constant(sixth), sum, hn::LoadU(d, Column(column, lane)));
  }

  HWY_INLINE void Put(int column, int lane, V rate) const {
    const FloatTag d;
    if constexpr (kStage == kLastStage) {
      hn::StoreU(End(column, lane, rate), d, Column(column, lane));
    } else {
      if constexpr (kStage == kFirstStage) {
        hn::Store(rate, d, block->rate_sum[column] + lane);
      } else {
        const V sum = hn::Load(d, block->rate_sum[column] + lane);
        hn::Store(hn::MulAdd(Constant(2), rate, sum), d, block->rate_sum[column] + lane);
      }
      hn::Store(rate, d, block->rate[column] + lane);
    }
  }

  /// Put for the attitude, which the last stage brings back to unit length.
  HWY_INLINE void PutAttitude(int lane, V q0, V qx, V qy, V qz) const {
    V q[] = {q0, qx, qy, qz};
    if constexpr (kStage == kLastStage) {
      const FloatTag d;
      for (int k = 0; k < 4; ++k) q[k] = End(kQ0 + k, lane, q[k]);
      const V square = hn::MulAdd(
          q[0], q[0], hn::MulAdd(q[1], q[1], hn::MulAdd(q[2], q[2], hn::Mul(q[3], q[3]))));
      const V scale = ReciprocalSqrt(d, square);
      for (int k = 0; k < 4; ++k) hn::StoreU(hn::Mul(q[k], scale), d, Column(kQ0 + k, lane));
    } else {
      for (int k = 0; k < 4; ++k) Put(kQ0 + k, lane, q[k]);
    }
  }
};

struct Cell {
  VI index;
  V start;     // index as float
  V fraction;  // in [0, 1] for finite values
};

/// The cell at a position from 0 to the axis' number of cells, give or take a rounding.
HWY_INLINE Cell CellAt(const KernelAxis& axis, V position) {
  const FloatTag d;
  Cell cell;
  cell.index = hn::Min(TruncateToInt(d, position), hn::Set(IntTag(), axis.last_cell));
  cell.start = hn::ConvertTo(d, cell.index);
  cell.fraction = hn::Sub(position, cell.start);
  return cell;
}

/// Always a cell of the axis, also for NaN: tables are never read outside.
HWY_INLINE Cell Locate(const KernelAxis& axis, V x) {
  const FloatTag d;
  const V whole = ClampTo(d, x, axis.low, axis.high);
  const V inner = ClampTo(d, x, axis.inner_low, axis.inner_high);
  return CellAt(axis, hn::MulAdd(whole, Constant(axis.cells_per_unit),
                                 hn::MulAdd(inner, Constant(axis.inner_more_cells_per_unit),
                                            Constant(axis.offset))));
}

/// The same for an axis whose cells all have one width.
HWY_INLINE Cell LocateUniform(const KernelAxis& axis, V x) {
  const V whole = ClampTo(FloatTag(), x, axis.low, axis.high);
  return CellAt(axis, hn::MulAdd(whole, Constant(axis.cells_per_unit), Constant(axis.offset)));
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_KERNELS_PLANT_KERNEL_BLOCK_INL_H_
