// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "envs/wind/dryden.h"
#include "tests/envs/test_tile.h"

namespace skein {

/// Aircraft that fly straight on through turbulence, without being moved by it: gusts alone.
class Gusts {
 public:
  static constexpr double kDeviation = 7.3;  ///< ft/s

  Gusts(int count, double speed_ft_s, double altitude_ft, std::uint32_t first_aircraft = 0,
        TurbulenceLaw law = TurbulenceLaw::kUniform)
      : tile_(count, kNumWindyColumns),
        episode_(tile_.stride(), 2),
        step_(tile_.stride()),
        first_(first_aircraft),
        law_(law),
        speed_(static_cast<float>(speed_ft_s)) {
    tile_.Fill(kQ0, 1);
    tile_.Fill(kDown, static_cast<float>(-altitude_ft));
    tile_.Fill(kTurbulenceStdDev, static_cast<float>(kDeviation));
    for (int i = 0; i < count; ++i) StartGusts(tile_.tile(), i, keys(), law_);
  }

  void Advance(double dt) {
    // Gusts meet a speed that they do not change.
    tile_.Fill(kAirU, speed_);
    tile_.Fill(kAirV, 0);
    tile_.Fill(kAirW, 0);
    AdvanceGusts(tile_.tile(), static_cast<float>(dt), keys(), law_);
    for (std::int32_t& step : step_) ++step;
  }

  /// North, east and down are forward, right and down of every aircraft.
  std::vector<double> Of(int component) {
    return {tile_.tile()[kWindNorth + component],
            tile_.tile()[kWindNorth + component] + tile_.count()};
  }
  TestTile& tile() { return tile_; }

 private:
  GustKeys keys() const { return {11, first_, episode_.data(), step_.data()}; }

  TestTile tile_;
  std::vector<std::int32_t> episode_, step_;
  std::uint32_t first_;
  TurbulenceLaw law_;
  float speed_;
};

inline double MeanProduct(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / static_cast<double>(a.size());
}

/// One-sided densities of unit variance over spatial frequency, rad/ft (envs/wind/dryden.h).
inline double Spectrum(int component, double scale_ft, double frequency) {
  const double square = std::pow(scale_ft * frequency, 2);
  return component == 0 ? 2 * scale_ft / M_PI / (1 + square)
                        : scale_ft / M_PI * (1 + 3 * square) / std::pow(1 + square, 2);
}

/// Spectra of gusts met at 1000 ft/s, 20,000 ft high and ten times a second: periodograms under
/// Hann's window, averaged over the aircraft. Their standard error is 3 %; up to an eighth of the
/// sampling theorem's limit, what is folded back adds 2 %.
class MeasuredSpectra {
 public:
  MeasuredSpectra() {
    Gusts gusts(kCount, kSpeed, 20000);
    for (int step = 0; step < kSteps; ++step) {
      gusts.Advance(kDt);
      for (int k = 0; k < 3; ++k) record_[k].push_back(gusts.Of(k));
    }
  }

  /// Of `cycles` in the whole record, rad/ft.
  static double Frequency(int cycles) { return 2 * M_PI * cycles / (kSteps * kSpacing); }

  /// Density of unit variance there.
  double Density(int component, int cycles) const {
    const double frequency = Frequency(cycles);
    std::vector<double> real(kCount), imaginary(kCount);
    double window_power = 0;
    for (std::size_t step = 0; step < kSteps; ++step) {
      const double at = static_cast<double>(step);
      const double window = 0.5 - 0.5 * std::cos(2 * M_PI * (at + 0.5) / kSteps);
      const double cosine = window * std::cos(frequency * kSpacing * at);
      const double sine = window * std::sin(frequency * kSpacing * at);
      window_power += window * window;
      for (std::size_t i = 0; i < kCount; ++i) {
        real[i] += cosine * record_[component][step][i];
        imaginary[i] += sine * record_[component][step][i];
      }
    }
    const double power = MeanProduct(real, real) + MeanProduct(imaginary, imaginary);
    return power * kSpacing / (M_PI * window_power) / (Gusts::kDeviation * Gusts::kDeviation);
  }

 private:
  static constexpr int kCount = 1024, kSteps = 1024;
  static constexpr double kSpeed = 1000, kDt = 0.1, kSpacing = kSpeed * kDt;

  std::vector<std::vector<double>> record_[3];
};

}  // namespace skein
