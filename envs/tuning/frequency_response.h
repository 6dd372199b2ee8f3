// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace skein {

/// A single-input, single-output system in steps of `dt` seconds: x' = A x + b u, y = c x.
struct SampledSystem {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  Eigen::RowVectorXd c;
  double dt = 0;

  /// Output over input at `frequency_rad_s`, up to pi / dt.
  std::complex<double> ResponseAt(double frequency_rad_s) const;
};

/// `count` frequencies from `low` to `high`, rad/s, at equal ratios.
std::vector<double> LogFrequencies(double low, double high, int count);

}  // namespace skein
