// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/policy/recurrent_policy.h"

namespace skein {

/// The policy as one that does not say for which aircraft it was made, nor does its low-level
/// policy: so that it may fly any. What it observes is then of the other aircraft's scale.
RecurrentPolicy ForAnyAircraft(const RecurrentPolicy& policy);

}  // namespace skein
