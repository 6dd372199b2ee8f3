// SPDX-License-Identifier: Apache-2.0
// The readers of containers of tensors, policies and checkpoints, as fuzz targets.
#pragma once

#include <string>
#include <vector>

namespace skein {

/// The header's length is what its end says, and the checksum that of the file.
std::string RepairedContainer(std::string file);

std::vector<std::string> PolicySeeds();
void ReadPolicy(const std::string& file);

std::vector<std::string> CheckpointSeeds();
/// A checkpoint that is refused leaves the training as it was; from one that is taken the training
/// goes on, whatever its numbers are, and another one undoes it. Throws std::logic_error where that
/// is not so.
void ReadCheckpoint(const std::string& file);

}  // namespace skein
