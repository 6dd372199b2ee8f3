// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/export/export_form.h"
#include "train/policy/stored_policy.h"

namespace skein {

/// Where the parts of an exported hierarchy are.
struct HierarchyFiles {
  std::string high_level, low_level;
  std::string combined;  ///< both in one graph; empty if there is none
};

/// How an exported high-level policy and its low-level policy act together, as a JSON document:
/// their files, rates and numbers, and how the one's actions become the other's targets.
std::string Manifest(ExportForm form, const ExportedPolicy& high_level,
                     const StoredPolicy& low_level, const HierarchyFiles& files);

/// Whether the file `path` is there, and such a manifest.
bool IsManifest(const std::string& path);

}  // namespace skein
