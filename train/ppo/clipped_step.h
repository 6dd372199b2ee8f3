// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/ppo/adam.h"

namespace skein {

/// No training that goes well comes near: unscaled values of +-200 give norms of thousands.
inline constexpr double kExplodedGradientNorm = 1e8;

/// Takes a step by the optimiser's gradient, scaled down to `max_norm` if it is longer, and returns
/// its norm. The gradient stays as it is; all else does, too, if the norm is above
/// kExplodedGradientNorm or not a number.
double ClippedStep(double max_norm, double learning_rate, AdamOptimiser& optimiser);

}  // namespace skein
