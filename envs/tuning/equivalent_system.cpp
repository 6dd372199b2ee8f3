// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/equivalent_system.h"

#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "envs/aircraft/aircraft.h"
#include "envs/tuning/pattern_search.h"

namespace skein {
namespace {

using Complex = std::complex<double>;

constexpr double kLowest = 0.1, kHighest = 10;  // rad/s
constexpr int kFrequencies = 25;
constexpr double kLastFactor = 1.0005;       // of the search
constexpr double kPhaseWeight = 0.02;        // dB^2/deg^2
constexpr double kStandardFrequencies = 20;  // over which the standard sums

/// A response at the frequencies of the fit.
class Response {
 public:
  explicit Response(const SampledSystem& system)
      : frequencies_(LogFrequencies(kLowest, kHighest, kFrequencies)) {
    for (const double frequency : frequencies_) values_.push_back(system.ResponseAt(frequency));
  }

  /// Of a transfer function with the gain that suits it best.
  double Mismatch(const std::function<Complex(Complex)>& transfer) const {
    std::vector<Complex> ratios;
    double mean_db = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      ratios.push_back(values_[i] / transfer({0, frequencies_[i]}));
      mean_db += Decibel(ratios.back()) / kFrequencies;
    }
    double sum = 0;
    for (const Complex& ratio : ratios) {
      const double gain_db = Decibel(ratio) - mean_db, phase_deg = std::arg(ratio) * kDegPerRad;
      sum += gain_db * gain_db + kPhaseWeight * phase_deg * phase_deg;
    }
    return kStandardFrequencies * sum / kFrequencies;
  }

 private:
  static double Decibel(Complex ratio) { return 20 * std::log10(std::abs(ratio)); }

  std::vector<double> frequencies_;
  std::vector<Complex> values_;
};

}  // namespace

EquivalentShortPeriod FitShortPeriod(const SampledSystem& pitch_rate_by_stick, double inverse_T) {
  const Response response(pitch_rate_by_stick);
  const auto mismatch = [&](const std::vector<double>& x) {
    return response.Mismatch([&](Complex s) {
      return (s + inverse_T) * std::exp(-x[2] * s) / (s * s + 2 * x[1] * x[0] * s + x[0] * x[0]);
    });
  };
  const std::vector<double> x = SearchPattern(mismatch, {3, 0.7, 0.05}, kLastFactor);
  return {x[0], x[1], x[2], mismatch(x)};
}

EquivalentRoll FitRoll(const SampledSystem& roll_rate_by_stick) {
  const Response response(roll_rate_by_stick);
  const auto mismatch = [&](const std::vector<double>& x) {
    return response.Mismatch([&](Complex s) { return std::exp(-x[1] * s) / (x[0] * s + 1.0); });
  };
  const std::vector<double> x = SearchPattern(mismatch, {0.5, 0.05}, kLastFactor);
  return {x[0], x[1], mismatch(x)};
}

}  // namespace skein
