// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/frequency_response.h"

#include <Eigen/LU>
#include <cmath>

namespace skein {

std::complex<double> SampledSystem::ResponseAt(double frequency_rad_s) const {
  const std::complex<double> z = std::polar(1.0, frequency_rad_s * dt);
  const Eigen::MatrixXcd resolvent =
      z * Eigen::MatrixXcd::Identity(A.rows(), A.rows()) - A.cast<std::complex<double>>();
  const Eigen::VectorXcd state = resolvent.partialPivLu().solve(b.cast<std::complex<double>>());
  return c.cast<std::complex<double>>().transpose().cwiseProduct(state).sum();
}

std::vector<double> LogFrequencies(double low, double high, int count) {
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i) {
    frequencies.push_back(low * std::pow(high / low, static_cast<double>(i) / (count - 1)));
  }
  return frequencies;
}

}  // namespace skein
