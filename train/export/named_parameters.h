// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "train/export/exported_policy.h"

namespace skein {

/// A network's parameters under the names that modules of PyTorch give them: LAYER.norm (LayerNorm)
/// and LAYER.linear of the hidden layers `layer1`, ... and of the `head`; `gru_norm`, and the
/// layers of `gru`: weight_ih_l0 [3 gru, in], weight_hh_l0 [3 gru, gru], bias_ih_l0, bias_hh_l0.
/// Then log_std [actions].
std::vector<ParameterSlice> NamedParameters(const ExportedPolicy& exported);

}  // namespace skein
