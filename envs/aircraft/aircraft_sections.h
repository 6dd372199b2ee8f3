// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft_json.h"

namespace skein {

/// Sections that files of all models share. They throw Error that names the key.

/// "observation_units", metres and seconds.
ReferenceUnits ReadUnits(Section section);

/// Of a flap that is not there: that it never moves, and that its range is not empty, for it is
/// among what is observed.
void LeaveOutFlap(Aircraft* aircraft);

}  // namespace skein
