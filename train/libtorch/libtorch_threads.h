// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// Makes LibTorch and the BLAS below it compute on the calling thread alone; WorkerPool brings the
/// parallelism. Idempotent.
void UseOneLibTorchThread();

}  // namespace skein
