// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "envs/wind/dryden.h"
#include "tests/envs/test_tile.h"
#include "tests/tolerance.h"

namespace skein {

/// Aircraft that fly straight on through turbulence, without being moved by it: gusts alone.
class Gusts {
 public:
  static constexpr double kDeviation = 7.3;  ///< ft/s

  /// With a span they turn, too.
  Gusts(int count, double speed_ft_s, double altitude_ft, std::uint32_t first_aircraft = 0,
        const Turbulence& turbulence = {})
      : tile_(count, turbulence.span_ft > 0 ? kNumRotationalGustColumns : kNumWindyColumns),
        episode_(tile_.stride(), 2),
        step_(tile_.stride()),
        first_(first_aircraft),
        turbulence_(turbulence),
        speed_(static_cast<float>(speed_ft_s)) {
    tile_.Fill(kQ0, 1);
    tile_.Fill(kDown, static_cast<float>(-altitude_ft));
    tile_.Fill(kTurbulenceStdDev, static_cast<float>(kDeviation));
    for (int i = 0; i < count; ++i) StartGusts(tile_.tile(), i, keys(), turbulence_);
  }

  void Advance(double dt) {
    // Gusts meet a speed that they do not change.
    tile_.Fill(kAirU, speed_);
    tile_.Fill(kAirV, 0);
    tile_.Fill(kAirW, 0);
    AdvanceGusts(tile_.tile(), static_cast<float>(dt), keys(), turbulence_);
    for (std::int32_t& step : step_) ++step;
  }

  /// Forward, right and down of every aircraft, which are its north, east and down; and the rates
  /// of roll, pitch and yaw.
  std::vector<double> Of(int component) {
    const int column = component < 3 ? kWindNorth + component : kGustRollRate + component - 3;
    return {tile_.tile()[column], tile_.tile()[column] + tile_.count()};
  }
  TestTile& tile() { return tile_; }

 private:
  GustKeys keys() const { return {11, first_, episode_.data(), step_.data()}; }

  TestTile tile_;
  std::vector<std::int32_t> episode_, step_;
  std::uint32_t first_;
  Turbulence turbulence_;
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

/// Likewise of the rates of roll, pitch and yaw, components 3 to 5, for a wing of `span_ft`.
inline double RateSpectrum(int component, double scale_ft, double span_ft, double frequency) {
  const double length = (component == 5 ? 3 : 4) * span_ft / M_PI;
  const double smoothing = 1 / (1 + std::pow(length * frequency, 2));
  if (component == 3) return 0.8 * std::cbrt(scale_ft / length) / scale_ft * smoothing;
  return frequency * frequency * smoothing * Spectrum(component == 4 ? 2 : 1, scale_ft, frequency);
}

/// Of MeasuredSpectra, relative: a periodogram's standard error is its own size, that of the mean
/// of 1024 a 32nd of it.
inline constexpr Tolerance kPeriodogram{0.18,
                                        "five standard errors, 16 %, and 2 % that are folded back"};

/// Spectra of gusts met at 1000 ft/s, 20,000 ft high: periodograms under Hann's window, averaged
/// over the aircraft. Their standard error is 3 %; up to an eighth of the sampling theorem's limit,
/// what is folded back adds 2 %. With a span they are those of the rates, too.
class MeasuredSpectra {
 public:
  /// Gusts are met every `dt` seconds.
  explicit MeasuredSpectra(double dt = 0.1, double span_ft = 0) : spacing_(kSpeed * dt) {
    Gusts gusts(kCount, kSpeed, 20000, 0, {TurbulenceLaw::kUniform, span_ft});
    const int components = span_ft > 0 ? 6 : 3;
    for (int step = 0; step < kSteps; ++step) {
      gusts.Advance(dt);
      for (int k = 0; k < components; ++k) record_[k].push_back(gusts.Of(k));
    }
  }

  /// Of `cycles` in the whole record, rad/ft.
  double Frequency(int cycles) const { return 2 * M_PI * cycles / (kSteps * spacing_); }

  /// Density of unit variance there.
  double Density(int component, int cycles) const {
    const double frequency = Frequency(cycles);
    std::vector<double> real(kCount), imaginary(kCount);
    double window_power = 0;
    for (std::size_t step = 0; step < kSteps; ++step) {
      const double at = static_cast<double>(step);
      const double window = 0.5 - 0.5 * std::cos(2 * M_PI * (at + 0.5) / kSteps);
      const double cosine = window * std::cos(frequency * spacing_ * at);
      const double sine = window * std::sin(frequency * spacing_ * at);
      window_power += window * window;
      for (std::size_t i = 0; i < kCount; ++i) {
        real[i] += cosine * record_[component][step][i];
        imaginary[i] += sine * record_[component][step][i];
      }
    }
    const double power = MeanProduct(real, real) + MeanProduct(imaginary, imaginary);
    return power * spacing_ / (M_PI * window_power) / (Gusts::kDeviation * Gusts::kDeviation);
  }

 private:
  static constexpr int kCount = 1024, kSteps = 1024;
  static constexpr double kSpeed = 1000;

  double spacing_;  // ft
  std::vector<std::vector<double>> record_[6];
};

}  // namespace skein
