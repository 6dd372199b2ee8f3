// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/export/exported_policy.h"
#include "train/export/policy_trace.h"

namespace skein {

/// The policy as one C99 header (train/export/policy.h.in): NAME_reset, NAME_step, and
/// NAME_self_test, which flies the first policy steps of the first flights of `recorded`, each of
/// `steps_per_flight` policy steps.
std::string CPolicy(const ExportedPolicy& exported, const PolicyTrace& recorded,
                    int steps_per_flight);

}  // namespace skein
