// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "train/network/script_module.h"

namespace skein {

/// The bytes of a TorchScript file, as torch.jit.load reads them.
std::string SaveLibTorchScript(const ScriptModule& module);

/// Of a file that SaveLibTorchScript wrote: the actions of one flight after the other, row by row
/// (ScriptFlights).
std::vector<float> FlyLibTorchScript(const std::string& bytes, const ScriptFlights& flights);

}  // namespace skein
