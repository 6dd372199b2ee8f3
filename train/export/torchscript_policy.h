// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/export/exported_policy.h"
#include "train/network/script_module.h"

namespace skein {

/// The policy as a TorchScript module: forward(obs, h) -> (actions, h) of float32 rows [batch,
/// observations], [batch, state], [batch, actions]; actions are clipped to [-1, 1], and a row of
/// zeros in h is the beginning of an episode. LibTorch's module makes a file of it
/// (BackendModule::SaveScript).
ScriptModule TorchScriptPolicy(const ExportedPolicy& exported);

}  // namespace skein
