// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <torch/version.h>

#include <cstring>

#include "train/libtorch/libtorch_network.h"
#include "train/libtorch/libtorch_script.h"
#include "train/network/backend_module.h"

namespace skein {
namespace {

class LibTorchModule final : public BackendModule {
 public:
  std::string LibraryVersion() const override { return TORCH_VERSION; }
  std::string BlasKernels() const override {
    using CoreName = const char* (*)();
    const auto name = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
    return name == nullptr ? "" : name();
  }
  std::unique_ptr<RecurrentNetwork> MakeNetwork(const NetworkLayout& layout) const override {
    return std::make_unique<LibTorchNetwork>(layout);
  }
  std::string SaveScript(const ScriptModule& module) const override {
    return SaveLibTorchScript(module);
  }
  std::vector<float> FlyScript(const std::string& bytes,
                               const ScriptFlights& flights) const override {
    return FlyLibTorchScript(bytes, flights);
  }
};

}  // namespace
}  // namespace skein

extern "C" const skein::BackendModule* skein_backend_module(const char* build) {
  static const skein::LibTorchModule module;
  return std::strcmp(build, SKEIN_BUILD_ID) == 0 ? &module : nullptr;
}
