// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "envs/policy.h"
#include "train/files/tensor_file.h"

namespace skein {

/// Writes the low-level policy that a high-level policy was trained over into the high-level
/// policy's file: its metadata with "controller." and its tensors with "controller/" before their
/// names. Throws Error if it is none that a file can hold.
void StoreLowLevelPolicy(const Policy& low_level, TensorFile& file);

/// The low-level policy in a file that StoreController wrote to; null if there is none. Throws
/// Error, naming `path`, on one that is damaged.
std::shared_ptr<const Policy> LoadLowLevelPolicy(const TensorFile& file, const std::string& path);

/// Whether two low-level policies would be written alike. Either may be null.
bool IsSameLowLevelPolicy(const Policy* a, const Policy* b);

}  // namespace skein
