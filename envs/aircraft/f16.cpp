// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/f16.h"

#include "envs/aircraft/registry.h"

namespace skein {

Aircraft F16() { return LoadAircraft("f16"); }

}  // namespace skein
