// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/export/exported_policy.h"

namespace skein {

/// The policy's parameters (NamedParameters) as a safetensors file, what they are the parameters of
/// in its metadata: sizes, activation, and what goes in and out.
std::string SafetensorsPolicy(const ExportedPolicy& exported);

}  // namespace skein
