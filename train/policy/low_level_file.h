#pragma once

#include <memory>
#include <string>

#include "envs/policy.h"
#include "train/files/tensor_file.h"

namespace skein {

/// Writes the controller that a planner was trained over into the planner's file: its metadata with
/// "controller." and its tensors with "controller/" before their names. Throws Error if it is none
/// that a file can hold.
void StoreController(const Pilot& controller, TensorFile& file);

/// The controller in a file that StoreController wrote to; null if there is none. Throws Error,
/// naming `path`, on one that is damaged.
std::shared_ptr<const Pilot> LoadController(const TensorFile& file, const std::string& path);

/// Whether two controllers would be written alike. Either may be null.
bool IsSameController(const Pilot* a, const Pilot* b);

}  // namespace skein
