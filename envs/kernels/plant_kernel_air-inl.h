// SPDX-License-Identifier: Apache-2.0
// First phase of the plant kernel: air data and thrust.

#if defined(SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_INL_H_
#undef SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_INL_H_
#else
#define SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/aircraft/engine.h"
#include "envs/kernels/air-inl.h"
#include "envs/kernels/plant_kernel_block-inl.h"
#include "envs/kernels/plant_kernel_tables-inl.h"
#include "simd/lookup-inl.h"
#include "simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace plant_kernel {

/// Squares of speeds below which angles and dimensionless rates stay as they are, ft^2/s^2: the
/// float64 plant's least airspeed of 0.01 ft/s, and one that only avoids a division by zero.
inline constexpr float kMinSpeedSquared = 1e-4f;
inline constexpr float kMinPlaneSpeedSquared = 1e-12f;

/// A bilinear function whose coefficients lie in vectors.
HWY_INLINE V ReadPatch(const float (*c)[kBlock], int lane, V first, V second) {
  const FloatTag d;
  const V low = hn::MulAdd(first, hn::Load(d, c[1] + lane), hn::Load(d, c[0] + lane));
  const V step = hn::MulAdd(first, hn::Load(d, c[3] + lane), hn::Load(d, c[2] + lane));
  return hn::MulAdd(second, step, low);
}

/// Reads the engine's tables for the aircraft in lanes `lane` to `lane + kLanes`.
inline HWY_NOINLINE void ReadThrust(const KernelEngine& engine, VI cell, hn::Mask<FloatTag> is_lit,
                                    int lane, Block* block) {
  const FloatTag d;
  const auto read = [&](const KernelCells* segments, float(*c)[kBlock]) HWY_ATTR {
    for (int k = 0; k < 4; ++k) {
      const V dry = Lookup32(d, segments[KernelEngine::kDry].c[k], cell);
      const V lit = Lookup32(d, segments[KernelEngine::kAfterburner].c[k], cell);
      hn::Store(hn::IfThenElse(is_lit, lit, dry), d, c[k] + lane);
    }
  };
  read(engine.low_lbf, block->thrust_low);
  read(engine.gain_lbf, block->thrust_gain);
}

/// Thrust, lbf: linear in power below and above military.
template <Stage kStage>
HWY_INLINE V Thrust(const KernelEngine& engine, V power, V altitude_ft, V mach, int lane,
                    Block* block) {
  const FloatTag d;
  const IntTag di;
  const Cell h = FindUniformCell(engine.altitude, altitude_ft);
  const Cell m = FindUniformCell(engine.mach, mach);
  const VI cell = TruncateToInt(d, hn::MulAdd(h.start, Constant(engine.mach_cells), m.start));
  const V military = Constant(static_cast<float>(kMilitaryPower));
  const auto is_lit = hn::Ge(power, military);
  // The cell with the segment as its sign: both at once are compared with those of before.
  const VI place = hn::Xor(cell, hn::VecFromMask(di, hn::RebindMask(di, is_lit)));
  if (kStage == kFirstStage ||
      !hn::AllTrue(di, hn::Eq(place, hn::Load(di, block->thrust_cell + lane)))) {
    hn::Store(place, di, block->thrust_cell + lane);
    ReadThrust(engine, cell, is_lit, lane, block);
  }
  const V low = ReadPatch(block->thrust_low, lane, h.fraction, m.fraction);
  const V gain = ReadPatch(block->thrust_gain, lane, h.fraction, m.fraction);
  const V over = hn::Sub(power, hn::IfThenElseZero(is_lit, military));
  return hn::MulAdd(over, gain, low);
}

/// Rate of change of power, 1/s; the law of PowerRate in envs/aircraft/engine.h.
HWY_INLINE V PowerRateOf(const KernelEngine& k, V power, V command) {
  const V afterburner = Constant(k.afterburner_power);
  const auto lit = hn::Ge(power, afterburner);
  const auto asked = hn::Ge(command, afterburner);
  const V target_lit = hn::IfThenElse(asked, command, Constant(k.blow_out_power));
  const V target_dry = hn::IfThenElse(asked, Constant(k.light_up_power), command);
  const V missing = hn::Sub(hn::IfThenElse(lit, target_lit, target_dry), power);
  const V lag =
      ClampTo(FloatTag(),
              hn::NegMulAdd(Constant(k.rate_slope_per_s), missing, Constant(k.rate_offset_per_s)),
              k.min_rate_per_s, k.max_rate_per_s);
  const V rate = hn::IfThenElse(lit, Constant(k.afterburner_rate_per_s), lag);
  return hn::Mul(rate, missing);
}

// The parts of the phase. They are chains of dependent operations, so each goes over all vectors of
// the block before the next: the processor then overlaps the chains of different aircraft.

/// Speed, flow angles, and the aerodynamic tables where those are.
template <class State>
HWY_INLINE void FindFlow(const KernelAircraft& aircraft, const State& state, Block* block) {
  const FloatTag d;
  const IntTag di;
  V u[kVectors], w[kVectors], tan_beta[kVectors];
  for (int n = 0; n < kVectors; ++n) {
    const int lane = n * kLanes;
    const BodyVelocity<V> velocity = state.AirVelocity(lane);
    u[n] = velocity.u;
    w[n] = velocity.w;
    const V v = velocity.v;
    const V plane_squared = hn::MulAdd(u[n], u[n], hn::Mul(w[n], w[n]));
    const V speed_squared = hn::Max(hn::MulAdd(v, v, plane_squared), Constant(kMinSpeedSquared));
    hn::Store(speed_squared, d, block->speed_squared + lane);
    hn::Store(ReciprocalSqrt(d, speed_squared), d, block->inverse_speed + lane);
    tan_beta[n] =
        hn::Mul(v, ReciprocalSqrt(d, hn::Max(plane_squared, Constant(kMinPlaneSpeedSquared))));
  }
  V alpha_deg[kVectors], beta_deg[kVectors];
  for (int n = 0; n < kVectors; ++n) {
    alpha_deg[n] = Atan2Degrees(d, w[n], u[n]);
    beta_deg[n] =
        AtanDegrees(d, ClampTo(d, tan_beta[n], aircraft.tan_beta_low, aircraft.tan_beta_high));
  }
  VI cell_slot[kVectors], alpha_cell[kVectors];
  for (int n = 0; n < kVectors; ++n) {
    const Cell alpha = FindCell(aircraft.alpha, alpha_deg[n]);
    const Cell beta = FindCell(aircraft.beta, beta_deg[n]);
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
      ReadTables(aircraft, cell_slot[n], alpha_cell[n], lane, block);
    } else if (!hn::AllTrue(di, hn::Eq(cell_slot[n], hn::Load(di, block->cell_slot + lane)))) {
      ReadChangedTables(aircraft, cell_slot[n], alpha_cell[n], lane, block);
    }
  }
}

/// Dynamic pressure times wing area; Mach number where the engine needs it.
template <bool kEngine, class State>
HWY_INLINE void FindAir(const KernelAircraft& aircraft, const State& state, Block* block) {
  const FloatTag d;
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    const V altitude = hn::Neg(state.Get(kDown, lane));
    const V speed_squared = hn::Load(d, block->speed_squared + lane);
    const AirVectors<V> air = AirAtAltitude(d, aircraft, altitude);
    const V wing = Constant(aircraft.constants.half_wing_area);
    hn::Store(hn::Mul(hn::Mul(air.density, wing), speed_squared), d, block->force + lane);
    if constexpr (kEngine) {
      const V speed = hn::Mul(speed_squared, hn::Load(d, block->inverse_speed + lane));
      hn::Store(hn::Mul(speed, ReciprocalSqrt(d, air.sound_speed_squared)), d, block->mach + lane);
    }
  }
}

/// Thrust and the rate of power, or the given thrust.
template <bool kEngine, class State>
HWY_INLINE void FindThrust(const KernelAircraft& aircraft, const State& state,
                           const BlockControls& controls, Block* block) {
  const FloatTag d;
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    if constexpr (kEngine) {
      const V altitude = hn::Neg(state.Get(kDown, lane));
      const V power = state.Get(kPower, lane);
      const V mach = hn::Load(d, block->mach + lane);
      hn::Store(Thrust<State::kStage>(aircraft.engine, power, altitude, mach, lane, block), d,
                block->thrust + lane);
      const V command = hn::LoadU(d, controls.power_command + lane);
      state.Put(kPower, lane, PowerRateOf(aircraft.engine, power, command));
    } else {
      hn::Store(hn::LoadU(d, controls.thrust_lbf + lane), d, block->thrust + lane);
    }
  }
}

HWY_INLINE V ValueAt(const KernelMachFunction& function, V mach) {
  const FloatTag d;
  V value = Constant(function.start);
  for (int k = 0; k < function.num_ramps; ++k) {
    const V way =
        hn::Sub(ClampTo(d, mach, function.from[k], function.to[k]), Constant(function.from[k]));
    value = hn::MulAdd(way, Constant(function.slope[k]), value);
  }
  return value;
}

/// What the Mach number changes of thrust and, along the same axis, of drag. Apart from the rest:
/// few aircraft are asked for it.
inline HWY_NOINLINE void AddMachEffects(const KernelAircraft& aircraft, Block* block) {
  const FloatTag d;
  for (int lane = 0; lane < kBlock; lane += kLanes) {
    const V mach = hn::Load(d, block->mach + lane);
    const V thrust =
        hn::Mul(hn::Load(d, block->thrust + lane), ValueAt(aircraft.thrust_growth, mach));
    const V drag = hn::Mul(hn::Load(d, block->force + lane), ValueAt(aircraft.drag_rise, mach));
    hn::Store(hn::Sub(thrust, drag), d, block->thrust + lane);
  }
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_KERNELS_PLANT_KERNEL_AIR_INL_H_
