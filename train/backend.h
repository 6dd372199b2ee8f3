#pragma once

#include <string>

#include "train/network.h"

namespace skein {

/// What computes a network, and why, if it is not what was asked for.
struct BackendChoice {
  Backend backend = Backend::kFused;
  std::string fallback_reason;  ///< what the fused kernels cannot do; empty if nothing
};

/// What of `shape` the fused kernels cannot compute, as key and value; empty if they can.
std::string FusedLimitation(const NetworkShape& shape);

/// The backend that was asked for, or LibTorch where the fused kernels cannot compute the shape.
BackendChoice ChooseBackend(Backend asked, const NetworkShape& shape);

/// One line for people: "networks by the fused kernels", or by LibTorch, with the reason.
std::string Describe(const BackendChoice& choice);

}  // namespace skein
