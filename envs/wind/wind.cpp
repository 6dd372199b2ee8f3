// SPDX-License-Identifier: Apache-2.0
#include "envs/wind/wind.h"

#include <Eigen/Core>
#include <cmath>

#include "base/range.h"
#include "envs/aircraft/aircraft.h"
#include "envs/state/attitude.h"
#include "simd/random.h"

namespace skein {

void Wind::Begin(Tile tile, int index, const GustKeys& keys) const {
  simd::RandomKey key;
  key.seed = keys.seed;
  key.a = keys.first_aircraft + static_cast<std::uint32_t>(index);
  key.b = static_cast<std::uint32_t>(keys.episode[index]);
  key.purpose = simd::RandomPurpose::kWind;
  simd::RandomStream random(key);
  const auto draw = [&](const Range& range) {
    return BentInto(range, random.Uniform(), draw_power_);
  };
  const double speed = draw(drawn_.speed_fps);
  const double from = random.Uniform(drawn_.from_deg.min, drawn_.from_deg.max) / kDegPerRad;
  const double turbulence = draw(drawn_.turbulence_fps);
  const Eigen::Vector3d wind(-speed * std::cos(from), -speed * std::sin(from), 0);

  const auto set = [&](int column, double value) {
    tile[column][index] = static_cast<float>(value);
  };
  for (int k = 0; k < 2; ++k) set(kSteadyWindNorth + k, wind[k]);
  set(kTurbulenceStdDev, turbulence);
  StartGusts(tile, index, keys, law());

  const auto get = [&](int column) { return static_cast<double>(tile[column][index]); };
  const Eigen::Matrix3d body_from_ned = BodyFromNed({get(kQ0), get(kQx), get(kQy), get(kQz)});
  if (!config_.step_at_reset) {
    const Eigen::Vector3d carried = body_from_ned * wind;
    for (int k = 0; k < 3; ++k) set(kU + k, get(kU + k) + carried[k]);
  }
  const Eigen::Vector3d blown =
      body_from_ned * Eigen::Vector3d(get(kWindNorth), get(kWindEast), get(kWindDown));
  for (int k = 0; k < 3; ++k) set(kAirU + k, get(kU + k) - blown[k]);
}

}  // namespace skein
