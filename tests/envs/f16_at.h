// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/f16.h"
#include "envs/reference/plant.h"

namespace skein {

/// The F-16 with its centre of gravity at `cg` chords, in the air of its published models.
inline Plant F16At(double cg) {
  Aircraft aircraft = F16();
  aircraft.airframe.cg = cg;
  return Plant(aircraft, AtmosphereModel::kStevensLewis);
}

}  // namespace skein
