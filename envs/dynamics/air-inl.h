// The atmosphere models of envs/air/atmosphere.h in vectors.

#if defined(SKEIN_ENVS_DYNAMICS_AIR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_DYNAMICS_AIR_INL_H_
#undef SKEIN_ENVS_DYNAMICS_AIR_INL_H_
#else
#define SKEIN_ENVS_DYNAMICS_AIR_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/dynamics/kernel_aircraft.h"
#include "simd/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct AirVectors {
  V density;      ///< slug/ft^3
  V temperature;  ///< degR
  V sound_speed;  ///< ft/s
  V pressure;     ///< lbf/ft^2
};

/// Air at geometric altitude `altitude_ft` in [-5000, 140000] for `aircraft`'s atmosphere: relative
/// error 3e-6 against AirAt up to 65,000 ft, 2e-5 up to 120,000 ft (where temperature ratios get
/// small). Members that are not used cost nothing.
template <class D, class V = hn::Vec<D>>
HWY_INLINE AirVectors<V> AirAtAltitude(D d, const KernelAircraft& aircraft, V altitude_ft) {
  const KernelAtmosphere& k = aircraft.atmosphere;
  const V one = hn::Set(d, 1.0f);
  V H = altitude_ft;
  if (k.inverse_earth_radius != 0) {
    H = hn::Mul(H, Reciprocal(d, hn::MulAdd(H, hn::Set(d, k.inverse_earth_radius), one)));
  }
  const V lapse = hn::Set(d, k.lapse_per_ft);
  const V top = hn::Set(d, k.lapse_top_ft);
  const V theta = hn::NegMulAdd(lapse, hn::Min(H, top), one);
  V log_density = hn::Mul(hn::Set(d, k.density_exponent), Log(d, theta));
  if (k.decay_per_ft != 0) {
    log_density = hn::NegMulAdd(hn::Set(d, k.decay_per_ft), hn::Max(hn::Sub(H, top), hn::Zero(d)),
                                log_density);
  }
  AirVectors<V> air;
  air.density = hn::Mul(hn::Set(d, k.sea_level_density), Exp(d, log_density));
  air.temperature =
      hn::IfThenElse(hn::Lt(H, hn::Set(d, k.tropopause_ft)),
                     hn::Mul(hn::Set(d, k.sea_level_temperature), hn::NegMulAdd(lapse, H, one)),
                     hn::Set(d, k.stratosphere_temperature));
  air.sound_speed = hn::Sqrt(hn::Mul(hn::Set(d, k.sound_constant), air.temperature));
  air.pressure = hn::Mul(hn::Set(d, k.pressure_constant), hn::Mul(air.density, air.temperature));
  return air;
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_DYNAMICS_AIR_INL_H_
