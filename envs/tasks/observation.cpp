// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/observation.h"

#include <algorithm>
#include <cmath>

#include "envs/aircraft/engine.h"
#include "envs/kernels/kernel_aircraft.h"
#include "envs/plant/sensor_freeze.h"
#include "envs/tasks/task.h"
#include "simd/dispatch.h"
#include "simd/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/observation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/kernels/atmosphere-inl.h"
#include "envs/tasks/flight-inl.h"
#include "simd/random-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

// Noise comes in blocks of eight deviates.
constexpr int kNoiseBlocks = (kObservationSize + 7) / 8;

/// One group of aircraft, [element][lane].
using ObservationColumns = float[kNoiseBlocks * 8][kLanes];

HWY_INLINE void ObserveAttitude(const Tile& tile, int first, ObservationColumns& columns) {
  const FloatTag d;
  const DownInBody down = Down(tile, first);
  // Nose straight up or down there is no roll: both its sine and cosine are then about zero.
  V cos_pitch, per_cos_pitch;
  Length(hn::MulAdd(down.y, down.y, hn::Mul(down.z, down.z)), cos_pitch, per_cos_pitch);
  hn::Store(hn::Mul(down.y, per_cos_pitch), d, columns[4]);
  hn::Store(hn::Mul(down.z, per_cos_pitch), d, columns[5]);
  hn::Store(down.sin_pitch, d, columns[6]);
  hn::Store(cos_pitch, d, columns[7]);
}

HWY_INLINE void ObserveAir(const KernelAircraft& aircraft, const Tile& tile,
                           const PlantTile& plants, int first, ObservationColumns& columns) {
  const FloatTag d;
  const ReferenceUnits& units = aircraft.source.units;
  const VelocityVectors velocity = Velocity(tile, first);
  const V altitude = hn::Neg(Column(tile, kDown, first));
  const auto air = AirAtAltitude(d, aircraft, altitude);
  V density = air.density;
  if (plants.is_drawn()) density = hn::Mul(density, Column(plants.columns, kPlantDensity, first));
  V equivalent_ratio, true_ratio;
  Length(hn::Mul(density, Constant(1 / aircraft.atmosphere.sea_level_density)), equivalent_ratio,
         true_ratio);
  hn::Store(hn::Mul(altitude, Constant(1 / units.altitude_ft)), d, columns[3]);
  hn::Store(hn::Mul(hn::Mul(velocity.speed, equivalent_ratio), Constant(1 / units.speed_ft_s)), d,
            columns[8]);
  hn::Store(hn::Mul(velocity.air.w, velocity.per_forward), d, columns[9]);
  hn::Store(hn::Mul(velocity.air.u, velocity.per_forward), d, columns[10]);
  hn::Store(hn::Mul(velocity.air.v, velocity.per_speed), d, columns[11]);
  hn::Store(hn::Mul(velocity.forward, velocity.per_speed), d, columns[12]);
  hn::Store(true_ratio, d, columns[21]);
}

HWY_INLINE void ObserveControls(const Actuators& actuators, const Tile& tile, int first,
                                ObservationColumns& columns) {
  const FloatTag d;
  for (int k = 0; k < 3; ++k) hn::Store(Column(tile, kP + k, first), d, columns[13 + k]);
  hn::Store(hn::Mul(Column(tile, kPower, first), Constant(1 / kMaximumPower)), d, columns[16]);
  const Actuator* const surfaces[] = {&actuators.elevator, &actuators.aileron, &actuators.rudder,
                                      &actuators.leading_edge_flap};
  for (int k = 0; k < 4; ++k) {
    hn::Store(hn::Mul(Column(tile, kElevator + k, first), Constant(1 / surfaces[k]->max_deg)), d,
              columns[17 + k]);
  }
}

/// Scale errors and biases of the sensors, each number's own.
HWY_INLINE void AddSensorErrors(const Tile& plants, int first, ObservationColumns& columns) {
  const FloatTag d;
  for (int k = 0; k < kNumSensedNumbers; ++k) {
    float* const number = columns[kNumTaskErrors + k];
    hn::Store(hn::MulAdd(hn::Load(d, number), Column(plants, kPlantSensorScale + k, first),
                         Column(plants, kPlantSensorBias + k, first)),
              d, number);
  }
}

HWY_INLINE void AddNoise(const ObservationNoise& noise, const PhiloxKeys& keys, int first,
                         ObservationColumns& columns) {
  const FloatTag d;
  const IntTag di;
  const UintTag du;
  const auto index = hn::Iota(du, noise.first_aircraft + static_cast<std::uint32_t>(first));
  const auto episode = hn::BitCast(du, hn::LoadU(di, noise.episode + first));
  const auto step = hn::BitCast(du, hn::LoadU(di, noise.step + first));
  V scale = Constant(noise.standard_deviation);
  if (noise.max_standard_deviation > noise.standard_deviation) {
    const V share =
        FirstUniform(d, keys, index, episode, hn::Zero(du), simd::RandomPurpose::kNoiseLevel);
    scale =
        hn::MulAdd(share, Constant(noise.max_standard_deviation - noise.standard_deviation), scale);
  }
  V deviates[8 * kNoiseBlocks];
  CoarseNormals<kNoiseBlocks>(d, keys, index, episode, step, simd::RandomPurpose::kObservationNoise,
                              deviates);
  for (int k = 0; k < kObservationSize; ++k) {
    hn::Store(hn::MulAdd(scale, deviates[k], hn::Load(d, columns[k])), d, columns[k]);
  }
}

/// Transposes the group's first `valid` aircraft into rows.
HWY_INLINE void StoreRows(const ObservationColumns& columns, int valid, float* rows) {
#if HWY_TARGET == HWY_SCALAR
  static_cast<void>(valid);
  for (int k = 0; k < kObservationSize; ++k) rows[k] = columns[k][0];
#else
  const FloatTag d;
  const hn::RepartitionToWide<FloatTag> wide;
  const hn::Full128<float> d4;
  // Four elements at a time; the last four overlap the ones before, not the next row.
  for (const int k : {0, 4, 8, 12, 16, kObservationSize - 4}) {
    const V a = hn::Load(d, columns[k]), b = hn::Load(d, columns[k + 1]);
    const V c = hn::Load(d, columns[k + 2]), e = hn::Load(d, columns[k + 3]);
    const auto ab_low = hn::BitCast(wide, hn::InterleaveLower(d, a, b));
    const auto ab_high = hn::BitCast(wide, hn::InterleaveUpper(d, a, b));
    const auto ce_low = hn::BitCast(wide, hn::InterleaveLower(d, c, e));
    const auto ce_high = hn::BitCast(wide, hn::InterleaveUpper(d, c, e));
    // quads[i] holds, in its j-th four floats, the four elements of aircraft 4 j + i.
    alignas(64) float quads[4][kLanes];
    hn::Store(hn::BitCast(d, hn::InterleaveLower(wide, ab_low, ce_low)), d, quads[0]);
    hn::Store(hn::BitCast(d, hn::InterleaveUpper(wide, ab_low, ce_low)), d, quads[1]);
    hn::Store(hn::BitCast(d, hn::InterleaveLower(wide, ab_high, ce_high)), d, quads[2]);
    hn::Store(hn::BitCast(d, hn::InterleaveUpper(wide, ab_high, ce_high)), d, quads[3]);
    for (int lane = 0; lane < valid; ++lane) {
      const auto quad = hn::Load(d4, quads[lane % 4] + lane / 4 * 4);
      hn::StoreU(quad, d4, rows + lane * kObservationSize + k);
    }
  }
#endif
}

void ObserveTileKernel(const KernelAircraft& aircraft, Tile tile, const float* errors,
                       std::size_t error_stride, const ObservationNoise& noise,
                       const PlantTile& plants, float* observation) {
  const FloatTag d;
  const PhiloxKeys keys(noise.seed);
  const bool is_noisy = noise.standard_deviation > 0 || noise.max_standard_deviation > 0;
  alignas(64) ObservationColumns columns = {};
  for (int first = 0; first < tile.count; first += kLanes) {
    for (int k = 0; k < kNumTaskErrors; ++k) {
      hn::Store(hn::LoadU(d, errors + k * error_stride + first), d, columns[k]);
    }
    ObserveAttitude(tile, first, columns);
    ObserveAir(aircraft, tile, plants, first, columns);
    ObserveControls(aircraft.source.actuators, tile, first, columns);
    if (plants.has_sensor_errors) AddSensorErrors(plants.columns, first, columns);
    if (is_noisy) AddNoise(noise, keys, first, columns);

    const int valid = std::min(tile.count - first, kLanes);
    StoreRows(columns, valid, observation + static_cast<std::size_t>(first) * kObservationSize);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(ObserveTileKernel);

static_assert(kNumTaskErrors + kNumSensedNumbers == kObservationSize);

void ObserveTile(const KernelAircraft& aircraft, Tile tile, const float* errors,
                 std::size_t error_stride, const ObservationNoise& noise, float* observation,
                 const PlantTile& plants) {
  SKEIN_DISPATCH(ObserveTileKernel)
  (aircraft, tile, errors, error_stride, noise, plants, observation);
  if (plants.is_drawn()) {
    ShowFrozenSensors(plants, tile.count, observation, kObservationSize);
  }
}

}  // namespace skein
#endif
