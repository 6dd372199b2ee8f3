// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/kernels/kernel_aircraft.h"

namespace skein {

/// Rearranges `tables` into the patch lines, functions of alpha and elevator effect of `kernel`,
/// and sets its three axes. Throws Error if a table does not fit its axes, the flap's alpha nodes
/// or the coarse elevator nodes are not nodes of the full axes, sideslip goes beyond 45 degrees or
/// alpha has more cells than a CellTable.
void FillAerodynamics(const AerodynamicTables& tables, KernelAircraft* kernel);

}  // namespace skein
