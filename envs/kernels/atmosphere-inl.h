// SPDX-License-Identifier: Apache-2.0
// The atmosphere models of envs/air/atmosphere.h in vectors.

#if defined(SKEIN_ENVS_KERNELS_ATMOSPHERE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_ENVS_KERNELS_ATMOSPHERE_INL_H_
#undef SKEIN_ENVS_KERNELS_ATMOSPHERE_INL_H_
#else
#define SKEIN_ENVS_KERNELS_ATMOSPHERE_INL_H_
#endif

#include <hwy/highway.h>

#include "envs/kernels/kernel_aircraft.h"
#include "simd/lookup-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
template <class V>
struct AirVectors {
  V density;              ///< slug/ft^3
  V temperature;          ///< degR
  V sound_speed_squared;  ///< ft^2/s^2
  V pressure;             ///< lbf/ft^2
};

/// Air at geometric altitude `altitude_ft` for `aircraft`'s atmosphere: relative error 2e-6 against
/// AirAt from -5000 to 60,000 ft, 1e-5 to 100,000 ft. Density stays what it is at -5000 ft below
/// and at about 140,000 ft above. Members that are not used cost nothing.
template <class D, class V = hn::Vec<D>>
HWY_INLINE AirVectors<V> AirAtAltitude(D d, const KernelAircraft& aircraft, V altitude_ft) {
  const hn::RebindToSigned<D> di;
  const KernelAtmosphere& k = aircraft.atmosphere;
  const V limited = ClampTo(d, altitude_ft, k.low_ft, k.high_ft);
  const V position = hn::MulAdd(limited, hn::Set(d, k.cells_per_ft), hn::Set(d, k.offset));
  const auto cell = hn::Min(hn::Max(TruncateToInt(d, position), hn::Zero(di)),
                            hn::Set(di, CellTable::kMaxCells - 1));
  const V f = hn::Sub(position, hn::ConvertTo(d, cell));
  const auto c = [&](int power) HWY_ATTR { return Lookup32(d, k.density.c[power], cell); };
  V density = hn::MulAdd(f, c(3), c(2));
  density = hn::MulAdd(f, density, c(1));

  V H = altitude_ft;
  if (k.inverse_earth_radius != 0) {
    H = hn::Mul(H,
                Reciprocal(d, hn::MulAdd(H, hn::Set(d, k.inverse_earth_radius), hn::Set(d, 1.0f))));
  }
  const V troposphere =
      hn::NegMulAdd(hn::Set(d, k.lapse_per_ft), H, hn::Set(d, k.sea_level_temperature));
  AirVectors<V> air;
  air.density = hn::MulAdd(f, density, c(0));
  air.temperature = hn::IfThenElse(hn::Lt(H, hn::Set(d, k.tropopause_ft)), troposphere,
                                   hn::Set(d, k.stratosphere_temperature));
  air.sound_speed_squared = hn::Mul(hn::Set(d, k.sound_constant), air.temperature);
  air.pressure = hn::Mul(hn::Set(d, k.pressure_constant), hn::Mul(air.density, air.temperature));
  return air;
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_ENVS_KERNELS_ATMOSPHERE_INL_H_
