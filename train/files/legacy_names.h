// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/files/tensor_file.h"

namespace skein {

/// Gives metadata and tensors that version 0.1 named otherwise their present names. Keys of the
/// configuration are not among them: each field knows its own (RenameFormerKeys).
void TakeCurrentNames(TensorFile& file);

}  // namespace skein
