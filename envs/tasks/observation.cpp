// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/observation.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

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
constexpr int BlocksFor(int numbers) { return (numbers + 7) / 8; }

/// One group of aircraft, [element][lane].
using ObservationColumns = float[BlocksFor(kMostObservations) * 8][kLanes];

/// The layout of the built-in tasks, known when this is compiled.
struct StandardLayout {
  static constexpr int lead = kNumTaskErrors, actions = 0, size = kObservationSize;
  static constexpr bool flight = true;
};

/// That of any task.
struct AnyLayout {
  int lead, actions, size;
  bool flight;
};

/// What the sensors of a group make of exact numbers: `kErrors` if they have scale errors and
/// biases, each number its own.
template <bool kErrors>
struct Sensors {
  const Tile& plants;
  int first;
  float (*columns)[kLanes];  ///< where number 0 would be

  HWY_INLINE void Show(int number, V exact) const {
    const FloatTag d;
    V shown = exact;
    if constexpr (kErrors) {
      // What PackSensorError has put there.
      const UintTag du;
      const int column = kPlantSensorErrors + number - kNumTaskErrors;
      const auto packed = hn::BitCast(du, Column(plants, column, first));
      const V scale = hn::BitCast(d, hn::And(packed, hn::Set(du, 0xffff0000u)));
      const V bias = hn::BitCast(d, hn::ShiftLeft<16>(packed));
      shown = hn::MulAdd(exact, scale, hn::Add(exact, bias));
    }
    hn::Store(shown, d, columns[number]);
  }
};

template <class Sensors>
HWY_INLINE void ObserveAttitude(const Tile& tile, int first, const Sensors& sensors) {
  const DownInBody down = Down(tile, first);
  // Nose straight up or down there is no roll: both its sine and cosine are then about zero.
  V cos_pitch, per_cos_pitch;
  Length(hn::MulAdd(down.y, down.y, hn::Mul(down.z, down.z)), cos_pitch, per_cos_pitch);
  sensors.Show(4, hn::Mul(down.y, per_cos_pitch));
  sensors.Show(5, hn::Mul(down.z, per_cos_pitch));
  sensors.Show(6, down.sin_pitch);
  sensors.Show(7, cos_pitch);
}

template <class Sensors>
HWY_INLINE void ObserveAir(const KernelAircraft& aircraft, const Tile& tile,
                           const PlantTile& plants, int first, const Sensors& sensors) {
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
  sensors.Show(3, hn::Mul(altitude, Constant(1 / units.altitude_ft)));
  sensors.Show(8,
               hn::Mul(hn::Mul(velocity.speed, equivalent_ratio), Constant(1 / units.speed_ft_s)));
  sensors.Show(9, hn::Mul(velocity.air.w, velocity.per_forward));
  sensors.Show(10, hn::Mul(velocity.air.u, velocity.per_forward));
  sensors.Show(11, hn::Mul(velocity.air.v, velocity.per_speed));
  sensors.Show(12, hn::Mul(velocity.forward, velocity.per_speed));
  sensors.Show(21, true_ratio);
}

template <class Sensors>
HWY_INLINE void ObserveControls(const Actuators& actuators, const Tile& tile, int first,
                                const Sensors& sensors) {
  for (int k = 0; k < 3; ++k) sensors.Show(13 + k, Column(tile, kP + k, first));
  sensors.Show(16, hn::Mul(Column(tile, kPower, first), Constant(1 / kMaximumPower)));
  const Actuator* const surfaces[] = {&actuators.elevator, &actuators.aileron, &actuators.rudder,
                                      &actuators.leading_edge_flap};
  for (int k = 0; k < 4; ++k) {
    sensors.Show(17 + k,
                 hn::Mul(Column(tile, kElevator + k, first), Constant(1 / surfaces[k]->max_deg)));
  }
}

/// Puts what the group's frozen sensors hold into its rows.
HWY_INLINE void ShowFrozen(const PlantTile& plants, int first, int valid, float* rows, int size) {
  const FloatTag d;
  const auto is_frozen = hn::Ne(Column(plants.columns, kPlantIsFrozen, first), hn::Zero(d));
  if (hn::AllFalse(d, is_frozen)) return;
  std::uint8_t bytes[sizeof(std::uint32_t)] = {};
  hn::StoreMaskBits(d, is_frozen, bytes);
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    if (lane < valid) ShowFrozenSensor(plants, first + lane, rows + lane * size);
  }
}

template <int kBlocks>
HWY_INLINE void AddNoise(const ObservationNoise& noise, const PhiloxKeys& keys, int first, int size,
                         ObservationColumns& columns) {
  const FloatTag d;
  const IntTag di;
  const UintTag du;
  const auto index = hn::Iota(du, noise.first_aircraft + static_cast<std::uint32_t>(first));
  const auto episode = hn::BitCast(du, hn::LoadU(di, noise.episode + first));
  const auto step = hn::BitCast(du, hn::LoadU(di, noise.step + first));
  V scale = Constant(noise.standard_deviation);
  if (noise.max_standard_deviation > noise.standard_deviation) {
    const V uniform =
        FirstUniform(d, keys, index, episode, hn::Zero(du), simd::RandomPurpose::kNoiseLevel);
    V share = uniform;
    for (int k = 1; k < noise.power; ++k) share = hn::Mul(share, uniform);
    scale =
        hn::MulAdd(share, Constant(noise.max_standard_deviation - noise.standard_deviation), scale);
  }
  V deviates[8 * kBlocks];
  CoarseNormals<kBlocks>(d, keys, index, episode, step, simd::RandomPurpose::kObservationNoise,
                         deviates);
  for (int k = 0; k < size; ++k) {
    hn::Store(hn::MulAdd(scale, deviates[k], hn::Load(d, columns[k])), d, columns[k]);
  }
}

/// Transposes the group's first `valid` aircraft into rows.
HWY_INLINE void StoreRows(const ObservationColumns& columns, int valid, int size, float* rows) {
#if HWY_TARGET == HWY_SCALAR
  static_cast<void>(valid);
  for (int k = 0; k < size; ++k) rows[k] = columns[k][0];
#else
  const FloatTag d;
  const hn::RepartitionToWide<FloatTag> wide;
  const hn::Full128<float> d4;
  // Four elements at a time; the last four overlap the ones before, not the next row.
  for (int next = 0; next < size; next += 4) {
    const int k = std::min(next, size - 4);
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
      hn::StoreU(quad, d4, rows + lane * size + k);
    }
  }
#endif
}

template <bool kErrors, int kBlocks, class Layout>
HWY_INLINE void ObserveTileWith(const KernelAircraft& aircraft, const Tile& tile,
                                const ObservedTask& task, const Layout& layout,
                                const ObservationNoise& noise, const PlantTile& plants,
                                float* observation) {
  const FloatTag d;
  const PhiloxKeys keys(noise.seed);
  const bool is_noisy = noise.standard_deviation > 0 || noise.max_standard_deviation > 0;
  alignas(64) ObservationColumns columns = {};
  for (int first = 0; first < tile.count; first += kLanes) {
    for (int k = 0; k < layout.lead; ++k) {
      hn::Store(hn::LoadU(d, task.numbers + k * task.stride + first), d, columns[k]);
    }
    if (layout.flight) {
      const Sensors<kErrors> sensors{plants.columns, first, columns + layout.lead - kNumTaskErrors};
      ObserveAttitude(tile, first, sensors);
      ObserveAir(aircraft, tile, plants, first, sensors);
      ObserveControls(aircraft.source.actuators, tile, first, sensors);
    }
    for (int k = 0; k < layout.actions; ++k) {
      const V action = Column(task.last_action, k, first);
      hn::Store(action, d, columns[layout.size - layout.actions + k]);
    }
    if (is_noisy) AddNoise<kBlocks>(noise, keys, first, layout.size, columns);

    const int valid = std::min(tile.count - first, kLanes);
    float* const rows = observation + static_cast<std::ptrdiff_t>(first) * layout.size;
    StoreRows(columns, valid, layout.size, rows);
    if (plants.is_drawn() && layout.flight) {
      ShowFrozen(plants, first, valid, rows + layout.lead - kNumTaskErrors, layout.size);
    }
  }
}

template <int kBlocks, class Layout>
HWY_INLINE void ObserveTileAs(const KernelAircraft& aircraft, const Tile& tile,
                              const ObservedTask& task, const Layout& layout,
                              const ObservationNoise& noise, const PlantTile& plants,
                              float* observation) {
  if (plants.has_sensor_errors) {
    ObserveTileWith<true, kBlocks>(aircraft, tile, task, layout, noise, plants, observation);
  } else {
    ObserveTileWith<false, kBlocks>(aircraft, tile, task, layout, noise, plants, observation);
  }
}

void ObserveTileKernel(const KernelAircraft& aircraft, Tile tile, const ObservedTask& task,
                       const ObservationNoise& noise, const PlantTile& plants, float* observation) {
  ObserveTileAs<BlocksFor(kObservationSize)>(aircraft, tile, task, StandardLayout(), noise, plants,
                                             observation);
}

/// The same of a layout that is not the standard one.
void ObserveAnyTileKernel(const KernelAircraft& aircraft, Tile tile, const ObservedTask& task,
                          const ObservationNoise& noise, const PlantTile& plants,
                          float* observation) {
  const ObservationLayout& of = task.layout;
  const AnyLayout layout{of.lead, of.actions, of.size(), of.flight};
  const auto observe = layout.size <= 8 * BlocksFor(kObservationSize)
                           ? ObserveTileAs<BlocksFor(kObservationSize), AnyLayout>
                           : ObserveTileAs<BlocksFor(kMostObservations), AnyLayout>;
  observe(aircraft, tile, task, layout, noise, plants, observation);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(ObserveTileKernel);
HWY_EXPORT(ObserveAnyTileKernel);

static_assert(kNumTaskErrors + kNumSensedNumbers == kObservationSize);

void ObserveTile(const KernelAircraft& aircraft, Tile tile, const ObservedTask& task,
                 const ObservationNoise& noise, float* observation, const PlantTile& plants) {
  const ObservationLayout& layout = task.layout;
  if (layout.lead == kNumTaskErrors && layout.flight && layout.actions == 0) {
    SKEIN_DISPATCH(ObserveTileKernel)(aircraft, tile, task, noise, plants, observation);
  } else {
    SKEIN_DISPATCH(ObserveAnyTileKernel)(aircraft, tile, task, noise, plants, observation);
  }
}

}  // namespace skein
#endif
