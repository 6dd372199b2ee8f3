// SPDX-License-Identifier: Apache-2.0
#include "train/network/backend_module.h"

#include "base/error.h"
#include "base/shared_module.h"

namespace skein {

const BackendModule& LoadBackendModule(const std::string& file) {
  try {
    return LoadModule<BackendModuleEntry>(file, kBackendModuleEntry, SKEIN_BUILD_ID);
  } catch (const Error& error) {
    throw Error("LibTorch's networks are not available" +
                WhyNotLoaded(error,
                             "install LibTorch (with Debian's package of Skein: what apt suggests "
                             "for it; to build: libtorch-dev, SKEIN_BUILD_LIBTORCH=ON), or choose "
                             "learner.backend = \"fused\" and network.activation = \"relu\""));
  }
}

std::string LibTorchVersion() {
  try {
    return LoadBackendModule().LibraryVersion();
  } catch (const Error&) {
    return "";
  }
}

std::string LibTorchBlas() {
  return LibTorchVersion().empty() ? "" : LoadBackendModule().BlasKernels();
}

}  // namespace skein
