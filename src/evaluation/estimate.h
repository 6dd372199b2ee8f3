// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace skein {

/// A figure of a population by a sample of it, with the interval that covers the true one in 95 %
/// of samples. NaN where the sample says nothing.
struct Estimate {
  double value = 0;
  double low = 0, high = 0;
  int count = 0;  ///< of what the figure is made
};

/// The mean, by Student's t: exact for normal values, and nearly so for the mean of many that a few
/// exceptions do not decide. Values that are all alike leave no width; those that are NaN are left
/// out; fewer than two leave no interval.
Estimate EstimateMean(const std::vector<double>& values);

/// A share, successes / trials, by Wilson's score interval (JASA 22, 1927): it holds for shares
/// near 0 and 1, too.
Estimate EstimateShare(int successes, int trials);

/// How often a rare event happens, `events` / `exposure` (as in hours), by the exact interval of a
/// Poisson distribution (Garwood, Biometrika 28, 1936); `count` is `events`. NaN without exposure.
Estimate EstimateRate(int events, double exposure);

/// How the shares of two agents that made the same trials differ.
struct PairedShares {
  /// Second minus first, by the interval of Agresti and Min (Statistics in Medicine 24, 2005).
  Estimate difference;
  /// Of a difference as large if the two are equally good: McNemar's test, exact (two-sided
  /// binomial).
  double p_value = 1;
};

/// Of `trials`, `only_first` were a success of the first agent alone, `only_second` of the second.
PairedShares CompareShares(int only_first, int only_second, int trials);

/// The 97.5 % point of Student's t with `degrees` degrees of freedom, at least 1: relative error
/// below 0.2 %.
double StudentPoint(int degrees);

}  // namespace skein
