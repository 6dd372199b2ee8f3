// SPDX-License-Identifier: Apache-2.0
#include "envs/kernels/flight_control_kernel.h"

#include "envs/kernels/kernel_aircraft.h"
#include "envs/state/attitude.h"
#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/kernels/flight_control_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/atmosphere-inl.h"
#include "envs/state/air_velocity-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// x limited to [low, high]; NaN stays NaN, so that it shows in the state.
HWY_INLINE V Clip(V x, V low, V high) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR
  // Of a number and a NaN, x86 takes the second.
  return hn::Min(high, hn::Max(low, x));
#else
  // Here Min and Max prefer the operand that is a number.
  return hn::IfThenElse(hn::Lt(x, low), low, hn::IfThenElse(hn::Gt(x, high), high, x));
#endif
}

/// min(1, pressure / qbar): how loop gains fall with dynamic pressure.
HWY_INLINE V GainFactor(float pressure_psf, V qbar) {
  const V pressure = Constant(pressure_psf);
  return hn::Mul(pressure, Reciprocal(FloatTag(), hn::Max(pressure, qbar)));
}

HWY_INLINE V Evaluate(const FlightControlConstants::Schedule& schedule, V x) {
  return hn::MulAdd(Constant(schedule.slope),
                    Clip(x, Constant(schedule.x_low), Constant(schedule.x_high)),
                    Constant(schedule.offset));
}

/// Vectors of consecutive aircraft: one load or store per column.
template <bool kDrawn>
struct AircraftGroup {
  Tile tile;
  PlantTile plants;
  int first;

  HWY_INLINE V Get(int column) const { return hn::LoadU(FloatTag(), tile[column] + first); }
  HWY_INLINE void Put(int column, V value) const {
    hn::StoreU(value, FloatTag(), tile[column] + first);
  }
  /// One step of the filter whose state is `column`.
  HWY_INLINE V Filter(const FlightControlConstants::Filter& filter, int column, V x) const {
    const V y = hn::MulAdd(Constant(filter.n0), x, Get(column));
    Put(column, hn::NegMulAdd(Constant(filter.d1), y, hn::Mul(Constant(filter.n1), x)));
    return y;
  }
  /// `x` times the drawn factor; of the nominal plant `x` as it is.
  HWY_INLINE V Scaled(PlantColumn column, V x) const {
    if constexpr (kDrawn) {
      return hn::Mul(x, hn::LoadU(FloatTag(), plants[column] + first));
    } else {
      return x;
    }
  }
  /// `reached_column` is the drawn plant's of what the servo reaches.
  HWY_INLINE void StepActuator(const FlightControlConstants::Servo& servo, int column,
                               PlantColumn reached_column, V command) const {
    const V position = Get(column);
    const V low = Constant(servo.min_deg), high = Constant(servo.max_deg);
    const V largest = Scaled(kPlantActuatorRate, Constant(servo.largest_step_deg));
    V reached = Constant(servo.reached);
    if constexpr (kDrawn) reached = hn::LoadU(FloatTag(), plants[reached_column] + first);
    const V change = hn::Mul(hn::Sub(Clip(command, low, high), position), reached);
    Put(column, Clip(hn::Add(position, Clip(change, hn::Neg(largest), largest)), low, high));
  }
};

struct Sensors {
  V alpha_deg;
  V p_deg_s, q_deg_s, r_deg_s;
  V nz, ny;
  V qbar, static_pressure;
};

struct Sticks {
  V pitch, roll, yaw;
};

/// Elevator command, deg.
template <class Group>
HWY_INLINE V PitchChannel(const FlightControlConstants& k, const Group& group,
                          const Sensors& sensors, const Sticks& sticks, V alpha) {
  const V zero = Constant(0), one = Constant(1);
  const V lateral_stick = hn::Max(hn::Abs(sticks.roll), hn::Abs(sticks.yaw));
  const V g_min = Evaluate(k.min_load_factor_command, sensors.qbar);
  const V g_max = Constant(k.max_load_factor_command);
  const V asked =
      hn::Mul(hn::Abs(sticks.pitch), hn::IfThenElse(hn::Ge(sticks.pitch, zero), g_max, g_min));
  const V least = hn::Mul(
      g_min, hn::NegMulAdd(Constant(k.min_load_factor_relative_reduction), lateral_stick, one));
  const V most = hn::NegMulAdd(Constant(k.max_load_factor_reduction), lateral_stick, g_max);
  const V g_command =
      group.Filter(k.load_factor_command, kLoadFactorCommandFilter, Clip(asked, least, most));

  const V q = group.Filter(k.pitch_rate, kPitchRateFilter, sensors.q_deg_s);
  const V q_washed = group.Filter(k.pitch_rate_washout, kPitchRateWashout, q);
  const V nz = group.Filter(k.load_factor, kLoadFactorFilter, hn::Sub(sensors.nz, one));

  const V lead =
      hn::Mul(hn::Mul(Constant(k.limiter_rate_lead_s), Evaluate(k.limiter_rate_fade, sensors.qbar)),
              q_washed);
  const V anticipated_alpha = hn::Add(alpha, lead);
  const V onset = hn::Max(zero, hn::Mul(Constant(k.alpha_onset_gain_g_per_deg),
                                        hn::Sub(anticipated_alpha, Constant(k.alpha_onset_deg))));
  const V feedback =
      hn::Add(onset, hn::MulAdd(Constant(k.pitch_rate_gain_g_s_per_deg), q_washed, nz));
  const V limiter = hn::Max(zero, hn::Mul(Constant(k.alpha_limit_gain_g_per_deg),
                                          hn::Sub(anticipated_alpha, Constant(k.alpha_limit_deg))));
  const V error_g =
      hn::Add(hn::Sub(limiter, g_command), group.Filter(k.pitch_lead, kPitchLeadFilter, feedback));
  const V proportional = hn::Mul(hn::Mul(Constant(k.pitch_proportional_deg_per_g),
                                         GainFactor(k.pitch_gain_pressure_psf, sensors.qbar)),
                                 error_g);

  const V integrator = group.Get(kPitchIntegrator);
  const V raw = hn::Add(integrator, hn::MulAdd(Constant(k.alpha_to_elevator), alpha, proportional));
  const V elevator = Clip(raw, Constant(k.elevator.min_deg), Constant(k.elevator.max_deg));
  // Back-calculation: what the limits cut off unwinds the integrator.
  const V moved = hn::MulAdd(Constant(k.pitch_integral_per_step),
                             hn::Sub(proportional, hn::Sub(raw, elevator)), integrator);
  const V limit = Constant(k.pitch_integrator_limit_deg);
  group.Put(kPitchIntegrator, Clip(moved, hn::Neg(limit), limit));
  return elevator;
}

/// Aileron command, deg. `p` is the filtered roll rate, deg/s.
template <class Group>
HWY_INLINE V RollChannel(const FlightControlConstants& k, const Group& group,
                         const Sensors& sensors, const Sticks& sticks, V alpha, V p) {
  const V asked = hn::Mul(
      hn::Mul(Constant(k.max_roll_rate_deg_s), Evaluate(k.roll_rate_fade, alpha)), sticks.roll);
  const V p_command = group.Filter(k.roll_command, kRollCommandFilter, asked);
  const V proportional = hn::Mul(
      hn::Mul(Constant(k.roll_rate_gain_s), GainFactor(k.roll_gain_pressure_psf, sensors.qbar)),
      hn::Sub(p, p_command));
  const V integrator = group.Get(kRollIntegrator);
  const V raw = hn::Add(hn::Add(proportional, integrator), group.Get(kTrimAileron));
  const V aileron = Clip(raw, Constant(k.aileron.min_deg), Constant(k.aileron.max_deg));

  const V fade = Evaluate(k.roll_integrator_fade, alpha);
  const auto hands_off = hn::Lt(hn::Abs(sticks.roll), Constant(k.roll_integrator_gate));
  const V driven = hn::IfThenElseZero(
      hands_off, hn::Mul(hn::Mul(Constant(k.roll_integral_per_s), fade), proportional));
  const V unwound = hn::Mul(Constant(k.roll_integrator_antiwindup_per_s), hn::Sub(raw, aileron));
  const V leaked = hn::Mul(hn::Mul(Constant(k.roll_integrator_leak_per_s), integrator),
                           hn::Sub(Constant(1), fade));
  const V moved = hn::MulAdd(Constant(k.dt), hn::Sub(driven, hn::Add(unwound, leaked)), integrator);
  const V limit = Constant(k.roll_integrator_limit_deg);
  group.Put(kRollIntegrator, Clip(moved, hn::Neg(limit), limit));
  return aileron;
}

/// Rudder command, deg. `p` is the filtered roll rate, deg/s.
template <class Group>
HWY_INLINE V YawChannel(const FlightControlConstants& k, const Group& group, const Sensors& sensors,
                        const Sticks& sticks, V alpha, V p, V aileron) {
  const V gain = GainFactor(k.yaw_gain_pressure_psf, sensors.qbar);
  const V pedal =
      group.Filter(k.pedal, kPedalFilter, hn::Mul(Constant(k.max_pedal_rudder_deg), sticks.yaw));
  const V r = group.Filter(k.yaw_rate, kYawRateFilter, sensors.r_deg_s);
  const V stability_rate =
      hn::NegMulAdd(hn::Mul(p, Constant(static_cast<float>(1 / kDegPerRad))), alpha, r);
  const V damper = group.Filter(k.yaw_lead, kYawLeadFilter,
                                group.Filter(k.yaw_washout, kYawWashout, stability_rate));
  const V ny = group.Filter(k.lateral_acceleration, kLateralAccelerationFilter, sensors.ny);

  const V scheduled =
      hn::NegMulAdd(pedal, Evaluate(k.pedal_fade, alpha),
                    hn::MulAdd(Constant(k.yaw_rate_gain_s), damper,
                               hn::Mul(Constant(k.lateral_acceleration_gain_deg_per_g), ny)));
  const V interconnect = Clip(hn::Mul(Constant(k.aileron_rudder_interconnect_per_deg), alpha),
                              Constant(k.interconnect_min), Constant(k.interconnect_max));
  const V raw = hn::MulAdd(
      gain, scheduled,
      hn::MulAdd(interconnect, hn::Sub(aileron, group.Get(kTrimAileron)), group.Get(kTrimRudder)));
  return Clip(raw, Constant(k.rudder.min_deg), Constant(k.rudder.max_deg));
}

/// Leading-edge flap command, deg, from `alpha_deg` through the flap's lead filter or as it is.
HWY_INLINE V LeadingEdgeFlap(const FlightControlConstants& k, const Sensors& sensors, V alpha_deg) {
  const V pressure_ratio = hn::Mul(sensors.qbar, Reciprocal(FloatTag(), sensors.static_pressure));
  return hn::MulAdd(
      Constant(k.flap_alpha_gain), alpha_deg,
      hn::NegMulAdd(Constant(k.flap_pressure_gain_deg), pressure_ratio, Constant(k.flap_bias_deg)));
}

/// Where a stick in [-1, 1] moves its surface by itself, deg: the full stick to a limit.
HWY_INLINE V Deflection(const FlightControlConstants::Servo& surface, V stick) {
  const auto pulls = hn::Gt(stick, Constant(0));
  return hn::Mul(stick,
                 hn::IfThenElse(pulls, Constant(surface.min_deg), Constant(-surface.max_deg)));
}

HWY_INLINE V PowerCommand(const FlightControlConstants& k, V throttle) {
  const V dry = hn::Mul(Constant(k.dry_gain), throttle);
  const V wet = hn::MulAdd(Constant(k.afterburner_gain), throttle, Constant(k.afterburner_offset));
  return hn::IfThenElse(hn::Le(throttle, Constant(k.military_throttle)), dry, wet);
}

template <class Group>
HWY_INLINE Sensors Sense(const KernelAircraft& aircraft, const Group& group) {
  const FloatTag d;
  Sensors sensors;
  const BodyVelocity<V> velocity = AirVelocity(d, group.tile, group.first);
  const V degrees = Constant(static_cast<float>(kDegPerRad));
  sensors.alpha_deg = AlphaDegrees(d, velocity.u, velocity.w);
  sensors.p_deg_s = hn::Mul(group.Get(kP), degrees);
  sensors.q_deg_s = hn::Mul(group.Get(kQ), degrees);
  sensors.r_deg_s = hn::Mul(group.Get(kR), degrees);
  sensors.nz = group.Get(kNz);
  sensors.ny = group.Get(kNy);
  const AirVectors<V> air = AirAtAltitude(d, aircraft, hn::Neg(group.Get(kDown)));
  // In another order than SquaresOf, which rounds differently: with these bits policies were
  // trained.
  const auto [u, v, w] = velocity;
  const V speed_squared = hn::MulAdd(u, u, hn::MulAdd(v, v, hn::Mul(w, w)));
  const V density = group.Scaled(kPlantDensity, air.density);
  sensors.qbar = hn::Mul(hn::Mul(Constant(0.5), density), speed_squared);
  sensors.static_pressure = group.Scaled(kPlantDensity, air.pressure);
  return sensors;
}

template <class Group>
HWY_INLINE V Stick(const float* column, const Group& group, PlantColumn gain) {
  const V stick = group.Scaled(gain, hn::LoadU(FloatTag(), column + group.first));
  return Clip(stick, Constant(-1), Constant(1));
}

template <FlightControlMode kMode, bool kDrawn>
void ControlTileIn(const KernelAircraft& aircraft, const FlightControlConstants& k, Tile tile,
                   const PilotColumns& pilot, const PlantTile& plants) {
  const FloatTag d;
  for (int first = 0; first < tile.count; first += kLanes) {
    const AircraftGroup<kDrawn> group{tile, plants, first};
    const Sensors sensors = Sense(aircraft, group);
    const Sticks sticks{Stick(pilot.pitch, group, kPlantPitchStick),
                        Stick(pilot.roll, group, kPlantRollStick),
                        Stick(pilot.yaw, group, kPlantYawStick)};
    const V throttle = Clip(hn::LoadU(d, pilot.throttle + first), Constant(0), Constant(1));
    group.Put(kPowerCommand, PowerCommand(k, throttle));

    V elevator, aileron, rudder, flap;
    if constexpr (kMode == FlightControlMode::kFull) {
      const V sensed_alpha =
          Clip(sensors.alpha_deg, Constant(k.alpha_min_deg), Constant(k.alpha_max_deg));
      const V alpha = group.Filter(k.alpha, kAlphaFilter, sensed_alpha);
      const V p = group.Filter(k.roll_rate, kRollRateFilter, sensors.p_deg_s);
      elevator = PitchChannel(k, group, sensors, sticks, alpha);
      aileron = RollChannel(k, group, sensors, sticks, alpha, p);
      rudder = YawChannel(k, group, sensors, sticks, alpha, p, aileron);
      flap = LeadingEdgeFlap(k, sensors, group.Filter(k.flap, kFlapFilter, sensors.alpha_deg));
    } else {
      elevator = Deflection(k.elevator, sticks.pitch);
      aileron = Deflection(k.aileron, sticks.roll);
      rudder = Deflection(k.rudder, sticks.yaw);
      flap = LeadingEdgeFlap(k, sensors, sensors.alpha_deg);
    }
    group.StepActuator(k.elevator, kElevator, kPlantElevatorReached, elevator);
    group.StepActuator(k.aileron, kAileron, kPlantAileronReached, aileron);
    group.StepActuator(k.rudder, kRudder, kPlantRudderReached, rudder);
    group.StepActuator(k.leading_edge_flap, kLeadingEdgeFlap, kPlantFlapReached, flap);
  }
}

template <FlightControlMode kMode>
void ControlPlants(const KernelAircraft& aircraft, const FlightControlConstants& k, Tile tile,
                   const PilotColumns& pilot, const PlantTile& plants) {
  if (plants.is_drawn()) {
    ControlTileIn<kMode, true>(aircraft, k, tile, pilot, plants);
  } else {
    ControlTileIn<kMode, false>(aircraft, k, tile, pilot, plants);
  }
}

void ControlTileFull(const KernelAircraft& aircraft, const FlightControlConstants& k, Tile tile,
                     const PilotColumns& pilot, const PlantTile& plants) {
  ControlPlants<FlightControlMode::kFull>(aircraft, k, tile, pilot, plants);
}

void ControlTileDirect(const KernelAircraft& aircraft, const FlightControlConstants& k, Tile tile,
                       const PilotColumns& pilot, const PlantTile& plants) {
  ControlPlants<FlightControlMode::kDirect>(aircraft, k, tile, pilot, plants);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(ControlTileFull);
HWY_EXPORT(ControlTileDirect);

void ControlTile(const KernelAircraft& aircraft, const FlightControlConstants& constants, Tile tile,
                 const PilotColumns& pilot, const PlantTile& plants) {
  if (constants.mode == FlightControlMode::kFull) {
    SKEIN_DISPATCH(ControlTileFull)(aircraft, constants, tile, pilot, plants);
  } else {
    SKEIN_DISPATCH(ControlTileDirect)(aircraft, constants, tile, pilot, plants);
  }
}

void ControlTile(const KernelAircraft& aircraft, Tile tile, const PilotColumns& pilot,
                 FlightControlMode mode, float dt) {
  ControlTile(aircraft, FlightControlConstants(aircraft.source, mode, dt), tile, pilot);
}

}  // namespace skein
#endif
