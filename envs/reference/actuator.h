// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft.h"

namespace skein {

/// Share of the way to a held command that a first-order lag goes in `dt` seconds: 1 -
/// exp(-bandwidth dt).
double ReachedShare(double bandwidth_per_s, double dt);

/// Position of a surface after `dt` seconds with the command held: the exact response of the
/// first-order lag to the limited command, then limited to what the rate limit allows in `dt` and
/// to the position limits. Degrees.
double StepActuator(const Actuator& actuator, double position_deg, double command_deg, double dt);

}  // namespace skein
