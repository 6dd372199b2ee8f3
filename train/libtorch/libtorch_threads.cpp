// SPDX-License-Identifier: Apache-2.0
#include "train/libtorch/libtorch_threads.h"

#include <ATen/Parallel.h>
#include <dlfcn.h>

namespace skein {

void UseOneLibTorchThread() {
  static const bool done = [] {
    at::set_num_threads(1);
    // OpenBLAS keeps threads of its own that LibTorch does not know of.
    using SetThreads = void (*)(int);
    if (const auto set =
            reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) {
      set(1);
    }
    return true;
  }();
  static_cast<void>(done);
}

}  // namespace skein
