// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/files/tensor_file.h"

namespace skein {

/// Gives metadata and tensors that have another name since version 0.1 the name of today.
void TakeCurrentNames(TensorFile& file);

}  // namespace skein
