// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "train/network/recurrent_network.h"
#include "train/network/script_module.h"

namespace skein {

/// A backend in a shared object of its own, so that nothing else links the library that it computes
/// with: LibTorch (train/libtorch/). A module gives out interfaces, and needs no function of the
/// program that loads it; both must come from one build.
class BackendModule {
 public:
  virtual ~BackendModule() = default;
  /// Of the library, as "1.13.0".
  virtual std::string LibraryVersion() const = 0;
  /// The processor that the library's products are made for, by OpenBLAS's names for them, as
  /// "SkylakeX"; empty if another library multiplies.
  virtual std::string BlasKernels() const = 0;
  virtual std::unique_ptr<RecurrentNetwork> MakeNetwork(const NetworkLayout& layout) const = 0;
  /// The bytes of a TorchScript file, as torch.jit.load reads them.
  virtual std::string SaveScript(const ScriptModule& module) const = 0;
  /// Loads what SaveScript wrote, and nothing else, and flies it: actions, row by row.
  virtual std::vector<float> FlyScript(const std::string& bytes,
                                       const ScriptFlights& flights) const = 0;
};

/// The function that a module exports under kBackendModuleEntry. `build` is the caller's
/// SKEIN_BUILD_ID; null if the module's own is another.
using BackendModuleEntry = const BackendModule*(const char* build);
inline constexpr const char* kBackendModuleEntry = "skein_backend_module";

/// LibTorch's module. The dynamic loader finds it by the program's run path: beside the program or
/// in the library folder's skein/.
inline constexpr const char* kLibTorchModule = "libskein_libtorch.so";

/// Loads the module `file` when it is first asked for, and for good. Throws Error that says how to
/// get it if it is not there, or not of this build.
const BackendModule& LoadBackendModule(const std::string& file = kLibTorchModule);

/// Loads LibTorch's module to ask it; empty if it is not there.
std::string LibTorchVersion();

/// The kernels that OpenBLAS takes on a processor that it does not know: those of one without AVX.
inline constexpr const char* kBlasOfUnknownProcessors = "Prescott";
/// BackendModule::BlasKernels of LibTorch's module; empty if that is not there.
std::string LibTorchBlas();

}  // namespace skein
