// SPDX-License-Identifier: Apache-2.0
// Total energy control: the throttle follows the aircraft's total energy; height alone is left to
// pitch. ArduPilot's TECS with a speed weight of 0. Energies are specific, ft^2/s^2.

#include <cmath>

#include "envs/aircraft/aircraft.h"
#include "envs/autopilot/gains.h"

#if defined(SKEIN_ENVS_AUTOPILOT_TECS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_TECS_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_TECS_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_TECS_INL_H_
#endif

#include "envs/autopilot/clock-inl.h"
#include "envs/autopilot/estimator-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// Filters and integrator of the throttle; a row of zeros is the beginning.
template <class T>
struct TecsMemory {
  T speed, acceleration;  ///< of a filter of its own, ft/s, ft/s^2
  T integrator;           ///< of throttle
  T throttle;             ///< 0..1, between outer steps
};

/// What the aircraft's energy should become.
template <class T>
struct EnergyDemand {
  T speed_error;   ///< target minus actual, ft/s
  T height_error;  ///< ft; 0 where height is no target
  T climb_rate;    ///< ft/s, asked of pitch; the present one where height is no target
};

/// The climb rate, ft/s, that brings a height error to zero: proportional to it, and beyond where
/// that would need more than the deceleration, along a parabola of just that.
template <class T>
HWY_INLINE T ClimbRateFor(const TecsGains& k, T height_error, T speed) {
  const double bandwidth = k.height_bandwidth, deceleration = k.height_deceleration;
  const T distance = Abs(height_error);
  const T parabola =
      Sqrt(2 * deceleration * Max(distance - deceleration / (2 * bandwidth * bandwidth), 0));
  const T rate =
      Select(distance < T(deceleration / (bandwidth * bandwidth)), bandwidth * distance, parabola);
  const T most = Min(speed * std::sin(k.max_climb_angle), k.max_climb_rate);
  return Select(height_error < 0, -1, 1) * Min(rate, most);
}

/// Where a number lies on an axis of `count` nodes: the one below it, and the share of the way to
/// the next. What is beyond the axis, and NaN, is at an end.
template <class T>
struct NodeBelow {
  T node, share;

  HWY_INLINE NodeBelow(T position, int count) {
    const T within = Min(Select(position > 0, position, 0), count - 1);
    node = Min(Floor(within), count - 2);
    share = within - node;
  }
};

template <class T>
HWY_INLINE T LevelThrottleAt(const LevelThrottle& level, T speed, T altitude) {
  using Grid = LevelThrottle;
  const NodeBelow<T> column((speed - Grid::kLeastSpeed) / Grid::kSpeedStep, Grid::kSpeeds);
  const NodeBelow<T> row(altitude / Grid::kAltitudeStep, Grid::kAltitudes);
  const T first = row.node * Grid::kSpeeds + column.node;
  const auto along = [&](T node) HWY_ATTR {
    const T left = Element(level.at, node);
    return left + column.share * (Element(level.at, node + 1) - left);
  };
  const T lower = along(first);
  return lower + row.share * (along(first + Grid::kSpeeds) - lower);
}

/// An outer step, every `dt` seconds, of the aircraft whose outer loops run now: leaves the
/// throttle in `memory`. In the order of AP_TECS::_update_throttle: what the demanded energy rate
/// needs, more in a bank, a part of the energy error, damping by the rate's error, an integrator
/// that stops while the throttle is at the limit that it pushes to.
template <class T, class Mask>
HWY_INLINE void UpdateThrottle(const TecsGains& k, double dt, const FlightEstimate<T>& flight,
                               const Kinematics<T>& motion, const EnergyDemand<T>& demand,
                               const Now<Mask>& now, TecsMemory<T>& memory) {
  T speed = memory.speed, acceleration = memory.acceleration;
  FilterSpeed(k.speed_filter, k.damping, dt, flight.speed, now.begins, speed, acceleration);

  const T wanted_acceleration =
      Clip(demand.speed_error / k.time_constant_s, -k.max_acceleration, k.max_acceleration);
  const T error = kGravityFtS2 * demand.height_error + flight.speed * demand.speed_error;
  const T rate = kGravityFtS2 * demand.climb_rate + flight.speed * wanted_acceleration;
  const T rate_error = rate - kGravityFtS2 * motion.up - flight.speed * acceleration;

  const T level = Max(motion.cos_roll, 0.2);
  const T bank = k.bank_compensation * (1 / (level * level) - 1);
  const double per_throttle = 1 / (k.max_energy_rate - k.min_energy_rate);
  const T sufficient = Clip(rate, k.min_energy_rate, k.max_energy_rate) + bank +
                       error / k.time_constant_s + k.throttle_damping * rate_error;
  const T level_throttle = LevelThrottleAt(k.level_throttle, flight.speed, flight.altitude);
  const T wanted = level_throttle + per_throttle * sufficient + memory.integrator;

  const auto pushes = Or(And(wanted > 1, error > 0), And(wanted < 0, error < 0));
  const T integrated =
      memory.integrator + dt * k.integrator_gain * per_throttle / k.time_constant_s * error;
  Assign(And(now.is_outer_step, Not(pushes)), memory.integrator,
         Clip(integrated, -k.integrator_limit, k.integrator_limit));
  Assign(now.is_outer_step, memory.throttle, Clip(wanted, 0, 1));
  Assign(now.is_outer_step, memory.acceleration, acceleration);
  Assign(now.is_outer_step, memory.speed, speed);
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_TECS_INL_H_
