#include "envs/tasks/observation.h"

#include <cmath>

#include "envs/dynamics/kernel_aircraft.h"
#include "envs/tasks/normalisation.h"
#include "envs/tasks/task.h"
#include "simd/dispatch.h"
#include "simd/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/tasks/observation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/dynamics/air-inl.h"
#include "envs/tasks/flight-inl.h"
#include "simd/random-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMaxLanes = 16;
// Noise comes in blocks of four normals.
constexpr int kNoiseBlocks = (kObservationSize + 3) / 4;

/// One group of aircraft, [element][lane].
using ObservationColumns = float[kNoiseBlocks * 4][kMaxLanes];

HWY_INLINE void ObserveAttitude(const Tile& tile, int first, ObservationColumns& columns) {
  const FlightTag d;
  const FlightVector q0 = Column(tile, kQ0, first), qx = Column(tile, kQx, first);
  const FlightVector qy = Column(tile, kQy, first), qz = Column(tile, kQz, first);
  // The third row of the attitude matrix: -sin(pitch), sin(roll) cos(pitch), cos(roll) cos(pitch).
  const FlightVector sin_pitch = TwiceSum(q0, qy, hn::Neg(qx), qz);
  const FlightVector y = TwiceSum(qy, qz, q0, qx);
  const FlightVector z =
      hn::MulAdd(q0, q0, hn::MulAdd(qz, qz, hn::NegMulAdd(qx, qx, hn::Neg(hn::Mul(qy, qy)))));
  const FlightVector cos_pitch = hn::Sqrt(hn::MulAdd(y, y, hn::Mul(z, z)));
  // Nose straight up or down there is no roll: both its sine and cosine are then about zero.
  const FlightVector divisor = hn::Max(cos_pitch, Constant(1e-6));
  hn::Store(hn::Div(y, divisor), d, columns[4]);
  hn::Store(hn::Div(z, divisor), d, columns[5]);
  hn::Store(sin_pitch, d, columns[6]);
  hn::Store(cos_pitch, d, columns[7]);
}

HWY_INLINE void ObserveAir(const KernelAircraft& aircraft, double sea_level_density,
                           const Tile& tile, int first, ObservationColumns& columns) {
  const FlightTag d;
  const VelocityVectors velocity = Velocity(tile, first);
  const FlightVector altitude = hn::Neg(Column(tile, kDown, first));
  const auto air = AirAtAltitude(d, aircraft, altitude);
  const FlightVector equivalent_ratio =
      hn::Sqrt(hn::Mul(air.density, Constant(1 / sea_level_density)));
  hn::Store(hn::Mul(altitude, Constant(1 / kAltitudeUnitFt)), d, columns[3]);
  hn::Store(hn::Mul(hn::Mul(velocity.speed, equivalent_ratio), Constant(1 / kSpeedUnitFtS)), d,
            columns[8]);
  hn::Store(hn::Div(velocity.w, velocity.forward), d, columns[9]);
  hn::Store(hn::Div(velocity.u, velocity.forward), d, columns[10]);
  hn::Store(hn::Div(velocity.v, velocity.speed), d, columns[11]);
  hn::Store(hn::Div(velocity.forward, velocity.speed), d, columns[12]);
  hn::Store(hn::Div(Constant(1), equivalent_ratio), d, columns[21]);
}

HWY_INLINE void ObserveControls(const Actuators& actuators, const Tile& tile, int first,
                                ObservationColumns& columns) {
  const FlightTag d;
  for (int k = 0; k < 3; ++k) hn::Store(Column(tile, kP + k, first), d, columns[13 + k]);
  hn::Store(hn::Mul(Column(tile, kPower, first), Constant(1 / kPowerUnit)), d, columns[16]);
  const Actuator* const surfaces[] = {&actuators.elevator, &actuators.aileron, &actuators.rudder,
                                      &actuators.leading_edge_flap};
  for (int k = 0; k < 4; ++k) {
    hn::Store(hn::Mul(Column(tile, kElevator + k, first), Constant(1 / surfaces[k]->max_deg)), d,
              columns[17 + k]);
  }
}

HWY_INLINE void AddNoise(const ObservationNoise& noise, int first, ObservationColumns& columns) {
  const FlightTag d;
  const hn::RebindToSigned<FlightTag> di;
  const hn::RebindToUnsigned<FlightTag> du;
  const auto index = hn::Iota(du, noise.first_aircraft + static_cast<std::uint32_t>(first));
  const auto episode = hn::BitCast(du, hn::LoadU(di, noise.episode + first));
  const auto step = hn::BitCast(du, hn::LoadU(di, noise.step + first));
  const FlightVector scale = Constant(noise.standard_deviation);
  for (int block = 0; block < kNoiseBlocks; ++block) {
    FlightVector normals[4];
    NormalBlock(d, noise.seed, index, episode, step, simd::RandomPurpose::kObservationNoise,
                static_cast<std::uint32_t>(block), normals);
    for (int k = 0; k < 4; ++k) {
      float* const column = columns[block * 4 + k];
      hn::Store(hn::MulAdd(scale, normals[k], hn::Load(d, column)), d, column);
    }
  }
}

void ObserveTileKernel(const KernelAircraft& aircraft, Tile tile, const float* errors,
                       std::size_t error_stride, double sea_level_density,
                       const ObservationNoise& noise, float* observation) {
  const FlightTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  alignas(64) ObservationColumns columns = {};
  for (int first = 0; first < tile.count; first += lanes) {
    for (int k = 0; k < kNumTaskErrors; ++k) {
      hn::Store(hn::LoadU(d, errors + k * error_stride + first), d, columns[k]);
    }
    ObserveAttitude(tile, first, columns);
    ObserveAir(aircraft, sea_level_density, tile, first, columns);
    ObserveControls(aircraft.source.actuators, tile, first, columns);
    if (noise.standard_deviation > 0) AddNoise(noise, first, columns);

    const int valid = tile.count - first < lanes ? tile.count - first : lanes;
    float* row = observation + static_cast<std::size_t>(first) * kObservationSize;
    for (int lane = 0; lane < valid; ++lane, row += kObservationSize) {
      for (int k = 0; k < kObservationSize; ++k) row[k] = columns[k][lane];
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(ObserveTileKernel);

void ObserveTile(const KernelAircraft& aircraft, Tile tile, const float* errors,
                 std::size_t error_stride, const ObservationNoise& noise, float* observation) {
  const double sea_level_density = AirAt(aircraft.atmosphere, 0).density_slug_ft3;
  SKEIN_DISPATCH(ObserveTileKernel)
  (aircraft, tile, errors, error_stride, sea_level_density, noise, observation);
}

}  // namespace skein
#endif
