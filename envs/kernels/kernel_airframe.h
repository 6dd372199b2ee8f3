// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "envs/aircraft/aircraft.h"
#include "envs/kernels/plant_kernel.h"

namespace skein {

/// The aircraft with another airframe: mass, inertia, centre of gravity, lengths, spinning mass.
/// Its tables are taken over if nobody else holds them, which saves nearly all of
/// MakeKernelAircraft; else they are copied.
std::shared_ptr<const KernelAircraft> WithAirframe(std::shared_ptr<const KernelAircraft> aircraft,
                                                   const Airframe& airframe,
                                                   const Gravity& gravity = {});

}  // namespace skein
