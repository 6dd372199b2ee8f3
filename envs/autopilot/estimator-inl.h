// SPDX-License-Identifier: Apache-2.0
// What the autopilot takes the aircraft to do: its noisy observation, held against the kinematics
// of flight. Angular rates and the path of the aircraft pass at once, noise does not.

#include <cmath>

#include "envs/aircraft/f16_units.h"
#include "envs/autopilot/gains.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"

#if defined(SKEIN_ENVS_AUTOPILOT_ESTIMATOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_AUTOPILOT_ESTIMATOR_INL_H_
#undef SKEIN_ENVS_AUTOPILOT_ESTIMATOR_INL_H_
#else
#define SKEIN_ENVS_AUTOPILOT_ESTIMATOR_INL_H_
#endif

#include "envs/autopilot/real-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// An observation in foot, second and radian; the task's errors as they came.
template <class T>
struct Measurement {
  T errors[kNumTaskErrors];
  T altitude, roll, pitch, true_airspeed, alpha, beta, p, q, r;
};

/// From the elements of an observation, in the order of envs/tasks/observation.h.
template <class T>
HWY_INLINE Measurement<T> MeasurementOf(const T* observation) {
  Measurement<T> measured;
  for (int k = 0; k < kNumTaskErrors; ++k) measured.errors[k] = observation[k];
  measured.altitude = observation[3] * kAltitudeUnitFt;
  measured.roll = ArcTangent(observation[4], observation[5]);
  measured.pitch = ArcTangent(observation[6], observation[7]);
  measured.true_airspeed = observation[8] * kSpeedUnitFtS * observation[21];
  measured.alpha = ArcTangent(observation[9], observation[10]);
  measured.beta = ArcTangent(observation[11], observation[12]);
  measured.p = observation[13];
  measured.q = observation[14];
  measured.r = observation[15];
  return measured;
}

/// What is remembered of the flight.
template <class T>
struct FlightEstimate {
  T p, q, r;
  T alpha, beta;
  T roll, pitch;
  T speed, acceleration;  ///< ft/s of true airspeed, ft/s^2
  T altitude;
};

/// What follows from an estimate.
template <class T>
struct Kinematics {
  T sin_roll, cos_roll, sin_pitch, cos_pitch;
  T yaw_rate, pitch_rate;  ///< of the Euler angles
  T ahead, right, up;      ///< airspeed in heading axes, ft/s
  T sin_climb, climb;      ///< of the climb angle through the air, rad
};

/// The speed that divisions by it take at least, ft/s.
inline constexpr double kLeastSpeed = 100;

/// One step of an estimate: moved by `change`, what is then missing to `measured` is corrected by
/// the share `correction`. At the beginning of an episode it is the measurement.
template <class T, class Mask>
HWY_INLINE T Corrected(T estimate, T change, T measured, double correction, Mask begins) {
  const T predicted = estimate + change;
  return Select(begins, measured, predicted + correction * (measured - predicted));
}

/// The same for an angle, in [-pi, pi].
template <class T, class Mask>
HWY_INLINE T CorrectedAngle(T estimate, T change, T measured, double correction, Mask begins) {
  const T predicted = estimate + change;
  const T corrected = predicted + correction * Wrapped(measured - predicted);
  return Wrapped(Select(begins, measured, corrected));
}

/// A speed, ft/s, and its rate, ft/s^2, by a second-order filter of `bandwidth` rad/s and twice the
/// damping ratio `damping`.
template <class T, class Mask>
HWY_INLINE void FilterSpeed(double bandwidth, double damping, double dt, T measured, Mask begins,
                            T& speed, T& acceleration) {
  const T missing = measured - (speed + dt * acceleration);
  acceleration = Select(begins, 0, acceleration + dt * bandwidth * bandwidth * missing);
  speed = Corrected(speed, dt * acceleration, measured, damping * bandwidth * dt, begins);
}

/// Airspeed in heading axes (ahead, right, up) from body axes.
template <class T>
HWY_INLINE void ResolveAirspeed(const FlightEstimate<T>& flight, Kinematics<T>& motion) {
  T sin_alpha, cos_alpha, sin_beta, cos_beta;
  SinCos(flight.alpha, sin_alpha, cos_alpha);
  SinCos(flight.beta, sin_beta, cos_beta);
  const T u = cos_alpha * cos_beta, v = sin_beta, w = sin_alpha * cos_beta;
  const T below = v * motion.sin_roll + w * motion.cos_roll;
  motion.sin_climb = u * motion.sin_pitch - below * motion.cos_pitch;
  motion.climb = ArcSine(motion.sin_climb);
  motion.ahead = flight.speed * (u * motion.cos_pitch + below * motion.sin_pitch);
  motion.right = flight.speed * (v * motion.cos_roll - w * motion.sin_roll);
  motion.up = flight.speed * motion.sin_climb;
}

/// One step of the estimate: rates and air angles by lags, attitude by the rates, speed by a
/// second-order filter, altitude by the climb. Returns what follows from it.
template <class T, class Mask>
HWY_INLINE Kinematics<T> Estimate(const EstimatorGains& k, double dt,
                                  const Measurement<T>& measured, Mask begins,
                                  FlightEstimate<T>& flight) {
  const double rate_share = 1 - std::exp(-k.body_rate * dt);
  flight.p = Corrected(flight.p, T(0), measured.p, rate_share, begins);
  flight.q = Corrected(flight.q, T(0), measured.q, rate_share, begins);
  flight.r = Corrected(flight.r, T(0), measured.r, rate_share, begins);
  const double angle_share = 1 - std::exp(-k.air_angle * dt);
  flight.alpha = Corrected(flight.alpha, T(0), measured.alpha, angle_share, begins);
  flight.beta = Corrected(flight.beta, T(0), measured.beta, angle_share, begins);

  Kinematics<T> motion;
  T sin_roll, cos_roll, sin_pitch, cos_pitch;
  SinCos(flight.roll, sin_roll, cos_roll);
  SinCos(flight.pitch, sin_pitch, cos_pitch);
  motion.yaw_rate = (flight.q * sin_roll + flight.r * cos_roll) / Max(cos_pitch, 0.1);
  motion.pitch_rate = flight.q * cos_roll - flight.r * sin_roll;
  const T roll_rate = flight.p + sin_pitch * motion.yaw_rate;
  flight.roll = CorrectedAngle(flight.roll, dt * roll_rate, measured.roll, k.attitude * dt, begins);
  flight.pitch =
      Corrected(flight.pitch, dt * motion.pitch_rate, measured.pitch, k.attitude * dt, begins);
  SinCos(flight.roll, motion.sin_roll, motion.cos_roll);
  SinCos(flight.pitch, motion.sin_pitch, motion.cos_pitch);

  FilterSpeed(k.speed, k.damping, dt, measured.true_airspeed, begins, flight.speed,
              flight.acceleration);
  ResolveAirspeed(flight, motion);
  flight.altitude =
      Corrected(flight.altitude, dt * motion.up, measured.altitude, k.altitude * dt, begins);
  return motion;
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_AUTOPILOT_ESTIMATOR_INL_H_
