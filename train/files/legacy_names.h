// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/files/tensor_file.h"

namespace skein {

/// Gives metadata and tensors that have another name since version 0.1 the name of today. Keys of
/// the configuration are not among them: each field knows its own (RenameFormerKeys).
void TakeCurrentNames(TensorFile& file);

}  // namespace skein
