// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "train/files/tensor_file.h"
#include "train/policy/stored_policy.h"

namespace skein {

/// Writes the low-level policy that a high-level policy was trained over into the high-level
/// policy's file: its metadata with "low_level." and its tensors with "low_level/" before their
/// names. Throws Error if it is itself a high-level policy.
void StoreLowLevelPolicy(const StoredPolicy& low_level, TensorFile& file);

/// The low-level policy in a file that StoreLowLevelPolicy wrote to; null if there is none. Throws
/// Error, naming `path`, on one that is damaged.
std::shared_ptr<const StoredPolicy> LoadLowLevelPolicy(TensorFile file, const std::string& path);

/// Whether two policies would be stored alike. Either may be null.
bool IsSamePolicy(const StoredPolicy* a, const StoredPolicy* b);

}  // namespace skein
