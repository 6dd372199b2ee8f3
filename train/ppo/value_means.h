// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/ppo/rollout.h"
#include "train/ppo/shards.h"

namespace skein {

class Ranks;

/// What is summed over the samples of a rollout: value targets, and what the critic missed of them.
enum ValueSum { kTarget, kTargetSquared, kError, kErrorSquared, kNumValueSums };

/// Their means over the samples of all ranks. To be called by all of them together.
Sums<kNumValueSums> ValueMeans(const Rollout& rollout, Ranks& ranks);

/// The share of the targets' variance that the critic's values explain: 1 of a critic that is right
/// up to a constant, 0 of one that says the same of every sample, less of one that is worse. NaN of
/// targets that are all equal.
double ExplainedVariance(const Sums<kNumValueSums>& means);

}  // namespace skein
