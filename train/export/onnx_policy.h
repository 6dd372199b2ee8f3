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

/// Whether a high-level policy acts at least as often as its low-level policy, on what is observed
/// at the moment: every policy step of the one is then one of the other.
bool FitInOneGraph(const ExportedPolicy& high_level, const ExportedPolicy& low_level);

/// Both as one such model, for policies that FitInOneGraph: the high-level policy's observations to
/// the low-level policy's actions, the state of the one before that of the other.
std::string OnnxHierarchy(const ExportedPolicy& high_level, const ExportedPolicy& low_level);

}  // namespace skein
