// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/export/export_form.h"
#include "train/policy/stored_policy.h"

namespace skein {

/// How an exported high-level policy and its low-level policy act together, as a JSON document:
/// their files, rates and numbers, and how the one's actions become the other's targets.
std::string Manifest(ExportForm form, const ExportedPolicy& high_level, const std::string& file,
                     const StoredPolicy& low_level, const std::string& low_level_file);

}  // namespace skein
