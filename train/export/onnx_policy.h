// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/export/exported_policy.h"

namespace skein {

/// The policy as an ONNX model (opset 17): inputs `obs` [batch, observations] and `h_in` [batch,
/// state], outputs `actions` [batch, actions], clipped to [-1, 1], and `h_out` [batch, state]. The
/// GRU is ONNX's own: gates in the order update, reset, new, reset after the product
/// (linear_before_reset). A row of zeros in `h_in` is the beginning of an episode.
std::string OnnxPolicy(const ExportedPolicy& exported);

}  // namespace skein
