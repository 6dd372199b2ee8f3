// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft.h"

namespace skein {

/// The F-16 of NASA TP-1538 with the University of Minnesota's mass properties (cg 0.30 chord, no
/// engine angular momentum), the Stevens and Lewis engine and Skein's flight control gains, as
/// data/f16/aircraft.json has them. Drag does not rise and thrust does not grow with the Mach
/// number unless asked to (drag_rises, engine.grows).
Aircraft F16();

}  // namespace skein
