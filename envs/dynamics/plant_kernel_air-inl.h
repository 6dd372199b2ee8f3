// First phase of the plant kernel: air data, places in the tables, thrust.

#if defined(SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_AIR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_AIR_INL_H_
#undef SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_AIR_INL_H_
#else
#define SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_AIR_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/aircraft/engine.h"
#include "envs/dynamics/air-inl.h"
#include "envs/dynamics/plant_kernel_block-inl.h"
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

/// Thrust of one power level, lbf.
HWY_INLINE V ThrustOf(const KernelCells& cells, VI cell, V altitude, V mach) {
  const FloatTag d;
  const V low = hn::MulAdd(mach, Lookup32(d, cells.c[2], cell), Lookup32(d, cells.c[0], cell));
  const V high = hn::MulAdd(mach, Lookup32(d, cells.c[3], cell), Lookup32(d, cells.c[1], cell));
  return hn::MulAdd(altitude, high, low);
}

/// Thrust, lbf: linear in power below and above military.
HWY_INLINE V Thrust(const KernelEngine& engine, V power, V altitude_ft, V mach) {
  constexpr float kMilitary = static_cast<float>(kPowerLag.military_power);
  constexpr float kInverseMilitary = static_cast<float>(1 / kPowerLag.military_power);
  constexpr float kInverseAfterburner =
      static_cast<float>(1 / (kPowerLag.maximum_power - kPowerLag.military_power));
  const Cell h = FindCell(engine.altitude, altitude_ft);
  const Cell m = FindCell(engine.mach, mach);
  const VI cell =
      TruncateToInt(FloatTag(), hn::MulAdd(h.start, Constant(engine.mach_cells), m.start));
  const auto level = [&](KernelEngine::Level which) HWY_ATTR {
    return ThrustOf(engine.thrust_lbf[which], cell, h.fraction, m.fraction);
  };
  const V idle = level(KernelEngine::kIdle);
  const V military = level(KernelEngine::kMilitary);
  const V maximum = level(KernelEngine::kMaximum);
  const V over = hn::Sub(power, Constant(kMilitary));
  const V dry =
      hn::MulAdd(hn::Mul(power, Constant(kInverseMilitary)), hn::Sub(military, idle), idle);
  const V wet = hn::MulAdd(hn::Mul(over, Constant(kInverseAfterburner)), hn::Sub(maximum, military),
                           military);
  return hn::IfThenElse(hn::Lt(power, Constant(kMilitary)), dry, wet);
}

/// Rate of change of power, 1/s; the law of PowerRate in envs/aircraft/engine.h.
HWY_INLINE V PowerRateOf(V power, V command) {
  constexpr const PowerLag& k = kPowerLag;
  const V military = Constant(static_cast<float>(k.military_power));
  const auto lit = hn::Ge(power, military);
  const auto asked = hn::Ge(command, military);
  const V target_lit =
      hn::IfThenElse(asked, command, Constant(static_cast<float>(k.blow_out_power)));
  const V target_dry =
      hn::IfThenElse(asked, Constant(static_cast<float>(k.light_up_power)), command);
  const V missing = hn::Sub(hn::IfThenElse(lit, target_lit, target_dry), power);
  const V lag = ClampTo(FloatTag(),
                        hn::NegMulAdd(Constant(static_cast<float>(k.rate_slope_per_s)), missing,
                                      Constant(static_cast<float>(k.rate_offset_per_s))),
                        static_cast<float>(k.min_rate_per_s), static_cast<float>(k.max_rate_per_s));
  const V rate = hn::IfThenElse(lit, Constant(static_cast<float>(k.afterburner_rate_per_s)), lag);
  return hn::Mul(rate, missing);
}

// The parts of the phase, each for the aircraft in lanes `lane` to `lane + kLanes`. They are chains
// of dependent operations, so each part runs over the whole block before the next: the processor
// then overlaps the chains of different aircraft.

/// Speed, flow angles and from them the places in the aerodynamic tables.
template <bool kFirst>
HWY_INLINE void FindFlow(const KernelAircraft& aircraft, const StageState<kFirst>& state,
                         const BlockControls& controls, int lane, Block* block) {
  const FloatTag d;
  const IntTag di;
  const V u = state.Get(kU, lane), v = state.Get(kV, lane), w = state.Get(kW, lane);
  const V plane_squared = hn::MulAdd(u, u, hn::Mul(w, w));
  const V speed_squared = hn::Max(hn::MulAdd(v, v, plane_squared), Constant(kMinSpeedSquared));
  hn::Store(speed_squared, d, block->speed_squared + lane);
  hn::Store(ReciprocalSqrt(d, speed_squared), d, block->inverse_speed + lane);

  const V tan_beta =
      hn::Mul(v, ReciprocalSqrt(d, hn::Max(plane_squared, Constant(kMinPlaneSpeedSquared))));
  const V limited = ClampTo(d, tan_beta, aircraft.tan_beta_low, aircraft.tan_beta_high);
  const Cell alpha = FindCell(aircraft.alpha, Atan2Degrees(d, w, u));
  const Cell beta = FindCell(aircraft.beta, AtanDegrees(d, limited));
  const Cell elevator = FindCell(aircraft.elevator, hn::LoadU(d, controls.elevator_deg + lane));
  hn::Store(alpha.fraction, d, block->alpha_fraction + lane);
  hn::Store(beta.fraction, d, block->beta_fraction + lane);
  hn::Store(elevator.fraction, d, block->elevator_fraction + lane);
  hn::Store(alpha.index, di, block->alpha_cell + lane);
  hn::Store(elevator.index, di, block->elevator_cell + lane);
  // Exact in float32: there are far fewer than 2^24 lines.
  const V line = hn::MulAdd(beta.start, Constant(aircraft.lines_per_beta),
                            hn::Mul(alpha.start, Constant(aircraft.lines_per_node)));
  const VI plane_line = TruncateToInt(d, line);
  hn::Store(plane_line, di, block->plane_line + lane);
  hn::Store(hn::Add(plane_line, hn::Add(elevator.index, hn::Set(di, 1))), di,
            block->elevator_line + lane);
}

/// Dynamic pressure times wing area; Mach number where the engine needs it.
template <bool kEngine, bool kFirst>
HWY_INLINE void FindAir(const KernelAircraft& aircraft, const StageState<kFirst>& state, int lane,
                        Block* block) {
  const FloatTag d;
  const V altitude = hn::Neg(state.Get(kDown, lane));
  const V speed_squared = hn::Load(d, block->speed_squared + lane);
  const AirVectors<V> air = AirAtAltitude(d, aircraft, altitude);
  const V wing = Constant(aircraft.constants.half_wing_area);
  hn::Store(hn::Mul(hn::Mul(air.density, wing), speed_squared), d, block->force + lane);
  if constexpr (kEngine) {
    const V sound_squared = hn::Mul(Constant(aircraft.atmosphere.sound_constant), air.temperature);
    const V speed = hn::Mul(speed_squared, hn::Load(d, block->inverse_speed + lane));
    hn::Store(hn::Mul(speed, ReciprocalSqrt(d, sound_squared)), d, block->mach + lane);
  }
}

/// Thrust and the rate of power, or the given thrust.
template <bool kEngine, bool kFirst>
HWY_INLINE void FindThrust(const KernelAircraft& aircraft, const StageState<kFirst>& state,
                           const BlockControls& controls, int lane, Block* block,
                           float (*rates)[kBlock]) {
  const FloatTag d;
  if constexpr (kEngine) {
    const V altitude = hn::Neg(state.Get(kDown, lane));
    const V power = state.Get(kPower, lane);
    const V mach = hn::Load(d, block->mach + lane);
    hn::Store(Thrust(aircraft.engine, power, altitude, mach), d, block->thrust + lane);
    hn::Store(PowerRateOf(power, hn::LoadU(d, controls.power_command + lane)), d,
              rates[kPower] + lane);
  } else {
    hn::Store(hn::LoadU(d, controls.thrust_lbf + lane), d, block->thrust + lane);
  }
}

}  // namespace plant_kernel
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_DYNAMICS_PLANT_KERNEL_AIR_INL_H_
