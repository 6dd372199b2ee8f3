// SPDX-License-Identifier: Apache-2.0
#include "train/network/backend_module.h"

#include <dlfcn.h>

#include "base/error.h"

namespace skein {
namespace {

[[noreturn]] void Refuse(const std::string& reason) {
  throw Error("LibTorch's networks are not available (" + reason +
              "): install LibTorch (Debian: libtorch-dev) and build Skein with "
              "SKEIN_BUILD_LIBTORCH=ON, or choose learner.backend = \"fused\" and "
              "network.activation = \"relu\"");
}

}  // namespace

const BackendModule& LoadBackendModule(const std::string& file) {
  // Never closed: LibTorch's threads and registries last as long as the process.
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) Refuse(dlerror());
  const auto entry = reinterpret_cast<BackendModuleEntry*>(dlsym(library, kBackendModuleEntry));
  if (entry == nullptr) Refuse(file + " is no module of Skein");
  const BackendModule* const module = entry(SKEIN_BUILD_ID);
  if (module == nullptr) Refuse(file + " is of another build than " SKEIN_BUILD_ID);
  return *module;
}

std::string LibTorchVersion() {
  try {
    return LoadBackendModule().LibraryVersion();
  } catch (const Error&) {
    return "";
  }
}

}  // namespace skein
