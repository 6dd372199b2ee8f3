// SPDX-License-Identifier: Apache-2.0
#include "base/shared_module.h"

#include <dlfcn.h>

namespace skein {

void* FindModuleEntry(const std::string& file, const char* entry) {
  // Never closed: a library's threads and registries last as long as the process.
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw Error(dlerror());
  void* const address = dlsym(library, entry);
  if (address == nullptr) throw Error(file + " is no module of Skein");
  return address;
}

std::string WhyNotLoaded(const Error& reason, const std::string& advice) {
  const bool is_there = dynamic_cast<const OtherBuild*>(&reason) != nullptr;
  return std::string(" (") + reason.what() + ")" + (is_there ? "" : ": " + advice);
}

}  // namespace skein
