// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

constexpr double kNormalPoint = 1.959963984540054;  // 97.5 % of the normal distribution
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kTail = 0.025;  // on either side of an interval

/// The chance of at most `events` of a Poisson distribution with this mean.
double PoissonAtMost(int events, double mean) {
  double sum = 0;
  for (int k = 0; k <= events; ++k) {
    sum += std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
  }
  return sum;
}

/// The mean of which at most `events` are as likely as `probability`: less likely the larger.
double PoissonMean(int events, double probability) {
  double low = 0, high = events + 20 + 10 * std::sqrt(events + 1.0);
  constexpr int kHalvings = 60;  // to the last digit of float64
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (PoissonAtMost(events, middle) > probability ? low : high) = middle;
  }
  return low;
}

}  // namespace

double StudentPoint(int degrees) {
  // Closed forms where the expansion is not close enough.
  if (degrees == 1) return 12.706204736432095;
  if (degrees == 2) return 4.302652729696142;
  // Abramowitz and Stegun (1964), 26.7.5.
  const double z = kNormalPoint, z2 = z * z, n = degrees;
  const double g1 = z * (z2 + 1) / 4;
  const double g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
  const double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  const double g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
  return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

Estimate EstimateMean(const std::vector<double>& values) {
  Estimate estimate{0, kNaN, kNaN, 0};
  for (const double value : values) {
    if (std::isnan(value)) continue;
    estimate.value += value;
    ++estimate.count;
  }
  const int n = estimate.count;
  if (n == 0) return {kNaN, kNaN, kNaN, 0};
  estimate.value /= n;
  if (n == 1) return estimate;
  double squares = 0;
  for (const double value : values) {
    if (!std::isnan(value)) squares += (value - estimate.value) * (value - estimate.value);
  }
  const double half = StudentPoint(n - 1) * std::sqrt(squares / (n - 1) / n);
  estimate.low = estimate.value - half;
  estimate.high = estimate.value + half;
  return estimate;
}

Estimate EstimateShare(int successes, int trials) {
  if (trials == 0) return {kNaN, kNaN, kNaN, 0};
  const double n = trials, share = successes / n, z2 = kNormalPoint * kNormalPoint;
  const double middle = (share + z2 / (2 * n)) / (1 + z2 / n);
  const double half =
      kNormalPoint * std::sqrt(share * (1 - share) / n + z2 / (4 * n * n)) / (1 + z2 / n);
  // Where all or none succeeded rounding must not leave the share itself outside.
  return {share, std::clamp(middle - half, 0.0, share), std::clamp(middle + half, share, 1.0),
          trials};
}

Estimate EstimateRate(int events, double exposure) {
  if (!(exposure > 0)) return {kNaN, kNaN, kNaN, 0};
  const double low = events == 0 ? 0 : PoissonMean(events - 1, 1 - kTail);
  return {events / exposure, low / exposure, PoissonMean(events, kTail) / exposure, events};
}

PairedShares CompareShares(int only_first, int only_second, int trials) {
  PairedShares paired;
  if (trials == 0) {
    paired.difference = {kNaN, kNaN, kNaN, 0};
    return paired;
  }
  // Half an observation more in each of the four cells of the table.
  const double first = only_first + 0.5, second = only_second + 0.5, n = trials + 2.0;
  const double middle = (second - first) / n;
  const double half =
      kNormalPoint * std::sqrt(first + second - (second - first) * (second - first) / n) / n;
  const double difference = static_cast<double>(only_second - only_first) / trials;
  paired.difference = {difference, std::max(-1.0, middle - half), std::min(1.0, middle + half),
                       trials};
  // Twice the tail of a binomial with probability 1/2.
  const int discordant = only_first + only_second, fewer = std::min(only_first, only_second);
  double tail = 0;
  for (int k = 0; k <= fewer; ++k) {
    tail += std::exp(std::lgamma(discordant + 1.0) - std::lgamma(k + 1.0) -
                     std::lgamma(discordant - k + 1.0) - discordant * std::log(2.0));
  }
  paired.p_value = std::min(1.0, 2 * tail);
  return paired;
}

}  // namespace skein
