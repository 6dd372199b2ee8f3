// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/registry.h"

namespace skein::validation {

/// The F-16 of Stevens and Lewis, examples/aircraft/stevens_lewis_f16.json, with its engine.
inline Aircraft BookF16() {
  Aircraft f16 = LoadAircraft(SKEIN_TEST_DATA "/../../examples/aircraft/stevens_lewis_f16.json");
  f16.airframe.engine_angular_momentum = 160;
  return f16;
}

}  // namespace skein::validation
