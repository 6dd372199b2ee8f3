// SPDX-License-Identifier: Apache-2.0
// Second phase of the plant kernel: thrust and the lag of power, as in envs/aircraft/engine.h.

#if defined(SKEIN_ENVS_KERNELS_PLANT_KERNEL_ENGINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_KERNELS_PLANT_KERNEL_ENGINE_INL_H_
#undef SKEIN_ENVS_KERNELS_PLANT_KERNEL_ENGINE_INL_H_
#else
#define SKEIN_ENVS_KERNELS_PLANT_KERNEL_ENGINE_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/aircraft/engine.h"
#include "envs/kernels/plant_kernel_block-inl.h"
#include "simd/lookup-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace plant_kernel {

/// A bilinear function whose coefficients lie in vectors.
HWY_INLINE V ReadPatch(const float (*c)[kLanesPerBlock], int lane, V first, V second) {
  const FloatTag d;
  const V low = hn::MulAdd(first, hn::Load(d, c[1] + lane), hn::Load(d, c[0] + lane));
  const V step = hn::MulAdd(first, hn::Load(d, c[3] + lane), hn::Load(d, c[2] + lane));
  return hn::MulAdd(second, step, low);
}

/// Reads the engine's tables for the aircraft in lanes `lane` to `lane + kLanes`.
inline HWY_NOINLINE void ReadThrust(const KernelEngine& engine, VI cell, Mask is_lit, int lane,
                                    KernelBlock* block) {
  const FloatTag d;
  const auto read = [&](const KernelCells* segments, float(*c)[kLanesPerBlock]) HWY_ATTR {
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
                    KernelBlock* block) {
  const FloatTag d;
  const IntTag di;
  const Cell h = LocateUniform(engine.altitude, altitude_ft);
  const Cell m = LocateUniform(engine.mach, mach);
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
HWY_INLINE V PowerRate(const KernelEngine& k, V power, V command) {
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

/// Thrust and the rate of power, or the given thrust.
template <bool kEngine, class State>
HWY_INLINE void ThrustAndPowerRate(const KernelAircraft& aircraft, const State& state,
                                   const BlockControls& controls, KernelBlock* block) {
  const FloatTag d;
  for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
    if constexpr (kEngine) {
      const V altitude = hn::Neg(state.Get(kDown, lane));
      const V power = state.Get(kPower, lane);
      const V mach = hn::Load(d, block->mach + lane);
      const V thrust = Thrust<State::kStage>(aircraft.engine, power, altitude, mach, lane, block);
      hn::Store(state.plant.Scaled(kPlantThrust, lane, thrust), d, block->thrust + lane);
      const V command = hn::LoadU(d, controls.power_command + lane);
      const V rate = PowerRate(aircraft.engine, power, command);
      state.Put(kPower, lane, state.plant.Scaled(kPlantPowerRate, lane, rate));
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
inline HWY_NOINLINE void AddMachEffects(const KernelAircraft& aircraft, KernelBlock* block) {
  const FloatTag d;
  for (int lane = 0; lane < kLanesPerBlock; lane += kLanes) {
    const V mach = hn::Load(d, block->mach + lane);
    const V thrust =
        hn::Mul(hn::Load(d, block->thrust + lane), ValueAt(aircraft.thrust_growth, mach));
    const V drag = hn::Mul(hn::Load(d, block->qbar_S + lane), ValueAt(aircraft.drag_rise, mach));
    hn::Store(hn::Sub(thrust, drag), d, block->thrust + lane);
  }
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_KERNELS_PLANT_KERNEL_ENGINE_INL_H_
