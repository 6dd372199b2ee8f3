// SPDX-License-Identifier: Apache-2.0
#include "train/measures/body_angles.h"

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "train/measures/body_angles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "envs/tasks/flight-inl.h"
#include "simd/math-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

void MeasureAnglesKernel(const Tile& tile, float* roll, float* sideslip) {
  const FloatTag d;
  for (int first = 0; first < tile.count; first += kLanes) {
    const DownInBody down = Down(tile, first);
    hn::StoreU(Atan2(d, down.y, down.z), d, roll + first);
    const VelocityVectors velocity = Velocity(tile, first);
    hn::StoreU(Atan2(d, velocity.air.v, velocity.forward), d, sideslip + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(MeasureAnglesKernel);

void MeasureAngles(const Tile& tile, BodyAngles* angles) {
  const std::size_t padded = TileStride(tile.count);
  angles->roll.resize(padded);
  angles->sideslip.resize(padded);
  SKEIN_DISPATCH(MeasureAnglesKernel)(tile, angles->roll.data(), angles->sideslip.data());
}

}  // namespace skein
#endif  // HWY_ONCE
