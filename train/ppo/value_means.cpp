// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/value_means.h"

#include <cmath>
#include <limits>

#include "train/ranks/collectives.h"

namespace skein {

Sums<kNumValueSums> ValueMeans(const Rollout& rollout, Ranks& ranks) {
  Sums<kNumValueSums> means =
      SumSamples<kNumValueSums>(rollout, [&](std::int64_t row, Sums<kNumValueSums>& sums) {
        const double target = rollout.target[row], error = target - rollout.value[row];
        sums[kTarget] += target;
        sums[kTargetSquared] += target * target;
        sums[kError] += error;
        sums[kErrorSquared] += error * error;
      });
  SumOverRanks(ranks, means.size(), means.data());
  for (double& mean : means) mean /= static_cast<double>(rollout.all_samples());
  return means;
}

double ExplainedVariance(const Sums<kNumValueSums>& means) {
  const double target_variance = means[kTargetSquared] - std::pow(means[kTarget], 2);
  const double error_variance = means[kErrorSquared] - std::pow(means[kError], 2);
  return target_variance > 0 ? 1 - error_variance / target_variance
                             : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace skein
