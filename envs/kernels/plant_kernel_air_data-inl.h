// SPDX-License-Identifier: Apache-2.0
// First phase of the plant kernel: the air data of MeasureAir in envs/reference/plant.h, and the
// aerodynamic tables where they lie.

#if defined(SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_DATA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_DATA_INL_H_
#undef SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_DATA_INL_H_
#else
#define SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_DATA_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/kernels/atmosphere-inl.h"
#include "envs/kernels/plant_kernel_block-inl.h"
#include "envs/kernels/plant_kernel_tables-inl.h"
#include "envs/state/air_velocity-inl.h"
#include "simd/lookup-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace plant_kernel {

/// Squares of speeds below which angles and dimensionless rates stay as they are, ft^2/s^2: the
/// float64 plant's least airspeed of 0.01 ft/s, and one that only avoids a division by zero.
inline constexpr float kMinSpeedSquared = 1e-4f;
inline constexpr float kMinPlaneSpeedSquared = 1e-12f;

// The parts of the phase. They are chains of dependent operations, so each goes over all vectors of
// the block before the next: the processor then overlaps the chains of different aircraft.

/// Airspeed, flow angles and the cells of the tables where those are. The first stage leaves the
/// cells to ReadTables; the others read the tables of aircraft that have changed theirs.
template <class State>
HWY_INLINE void MeasureFlowAngles(const KernelAircraft& aircraft, const State& state,
                                  KernelBlock* block) {
  const FloatTag d;
  const IntTag di;
  V u[kVectors], w[kVectors], tan_beta[kVectors];
  for (int n = 0; n < kVectors; ++n) {
    const int lane = n * kLanes;
    const BodyVelocity<V> air = state.AirVelocity(lane);
    u[n] = air.u;
    w[n] = air.w;
    const AirspeedSquares<V> squares = SquaresOf(air);
    const V speed_squared = hn::Max(squares.whole, Constant(kMinSpeedSquared));
    hn::Store(speed_squared, d, block->speed_squared + lane);
    hn::Store(ReciprocalSqrt(d, speed_squared), d, block->inverse_speed + lane);
    const V in_plane = hn::Max(squares.in_plane, Constant(kMinPlaneSpeedSquared));
    tan_beta[n] = hn::Mul(air.v, ReciprocalSqrt(d, in_plane));
  }
  V alpha_deg[kVectors], beta_deg[kVectors];
  for (int n = 0; n < kVectors; ++n) {
    alpha_deg[n] = AlphaDegrees(d, u[n], w[n]);
    beta_deg[n] =
        AtanDegrees(d, ClampTo(d, tan_beta[n], aircraft.tan_beta_low, aircraft.tan_beta_high));
  }
  VI cell_slot[kVectors], alpha_cell[kVectors];
  for (int n = 0; n < kVectors; ++n) {
    const Cell alpha = Locate(aircraft.alpha, alpha_deg[n]);
    const Cell beta = Locate(aircraft.beta, beta_deg[n]);
    hn::Store(alpha.fraction, d, block->alpha_fraction + n * kLanes);
    hn::Store(beta.fraction, d, block->beta_fraction + n * kLanes);
    // Exact in float32: FillAerodynamics makes fewer than 2^24 slots.
    cell_slot[n] =
        TruncateToInt(d, hn::MulAdd(beta.start, Constant(aircraft.slots_per_beta),
                                    hn::Mul(alpha.start, Constant(aircraft.slots_per_cell))));
    alpha_cell[n] = alpha.index;
  }
  for (int n = 0; n < kVectors; ++n) {
    const int lane = n * kLanes;
    if constexpr (State::kStage == kFirstStage) {
      hn::Store(cell_slot[n], di, block->cell_slot + lane);
      hn::Store(alpha_cell[n], di, block->alpha_cell + lane);
    } else if (!hn::AllTrue(di, hn::Eq(cell_slot[n], hn::Load(di, block->cell_slot + lane)))) {
      ReadChangedTables(aircraft, cell_slot[n], alpha_cell[n], lane, block);
    }
  }
}

/// Gravity that falls with altitude.
template <class State>
HWY_INLINE void MeasureGravity(const KernelConstants& k, const State& state, KernelBlock* block) {
  const FloatTag d;
  for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
    const V distance = hn::NegMulAdd(state.Get(kDown, lane), Constant(k.gravity_inverse_radius),
                                     Constant(1));  // from the earth's centre, in its radii
    hn::Store(hn::Div(Constant(k.gravity), hn::Mul(distance, distance)), d, block->gravity + lane);
  }
}

/// Dynamic pressure times wing area; Mach number where the engine needs it.
template <bool kEngine, class State>
HWY_INLINE void MeasureDynamicPressure(const KernelAircraft& aircraft, const State& state,
                                       KernelBlock* block) {
  const FloatTag d;
  for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
    const V altitude = hn::Neg(state.Get(kDown, lane));
    const V speed_squared = hn::Load(d, block->speed_squared + lane);
    const AirVectors<V> air = AirAtAltitude(d, aircraft, altitude);
    const V wing = Constant(aircraft.constants.half_wing_area);
    const V density = state.plant.Scaled(kPlantDensity, lane, air.density);
    hn::Store(hn::Mul(hn::Mul(density, wing), speed_squared), d, block->qbar_S + lane);
    if constexpr (kEngine) {
      const V speed = hn::Mul(speed_squared, hn::Load(d, block->inverse_speed + lane));
      hn::Store(hn::Mul(speed, ReciprocalSqrt(d, air.sound_speed_squared)), d, block->mach + lane);
    }
  }
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_DATA_INL_H_
