// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/loop_margins.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "envs/aircraft/aircraft.h"

namespace skein {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::size_t IndexOf(const std::vector<int>& columns, int column) {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) -
                                  columns.begin());
}

double Decibel(double gain) { return 20 * std::log10(gain); }

/// Between the two neighbours of a crossing, the share of the way at which `value` is zero.
double ZeroBetween(double before, double after) { return before / (before - after); }

/// Gain one is crossed between two frequencies.
void NotePhase(double share, double low, double high, std::complex<double> before,
               std::complex<double> after, LoopMargins* margins) {
  const double frequency = low * std::pow(high / low, share);
  const std::complex<double> value = before + share * (after - before);
  // The angle from -1 to the value, from -180 to 180 deg.
  const double phase_deg = std::arg(-value) * kDegPerRad;
  if (std::abs(phase_deg) < std::abs(margins->phase_deg)) {
    margins->phase_deg = std::abs(phase_deg);
    margins->crossover_rad_s = frequency;
  }
  // A delay turns clockwise: from above the negative axis by the whole way round, less the rest.
  const double lag = phase_deg >= 0 ? phase_deg / kDegPerRad : phase_deg / kDegPerRad + 2 * kPi;
  margins->delay_s = std::min(margins->delay_s, lag / frequency);
}

/// The negative real axis is crossed between two frequencies.
void NoteGain(double share, double low, double high, std::complex<double> before,
              std::complex<double> after, LoopMargins* margins) {
  const double real = before.real() + share * (after.real() - before.real());
  if (real >= 0) return;
  const double decibel = -Decibel(-real);
  if (decibel >= 0 && decibel < margins->gain_up_db) {
    margins->gain_up_db = decibel;
    margins->gain_up_rad_s = low * std::pow(high / low, share);
  }
  if (decibel < 0) margins->gain_down_db = std::min(margins->gain_down_db, -decibel);
}

}  // namespace

SampledSystem BreakLoop(const Plant& plant, const TrimPoint& trim, LoopBreak where, double dt) {
  const bool is_pitch = where == LoopBreak::kElevator;
  // With commands held back by a step they are entries of the loop's memory, each a place where it
  // can be broken.
  const ClosedLoopModel model = LineariseClosedLoop(
      plant, trim, is_pitch ? LoopAxis::kLongitudinal : LoopAxis::kLateral, dt, true);
  const int broken = kCommandMemory + static_cast<int>(where);
  const int other = is_pitch                       ? kCommandMemory + 3
                    : where == LoopBreak::kAileron ? kCommandMemory + 2
                                                   : kCommandMemory + 1;
  const auto b = static_cast<long>(IndexOf(model.columns, broken));
  const auto o = static_cast<long>(IndexOf(model.columns, other));
  std::vector<long> rest;
  for (long i = 0; i < model.A.rows(); ++i) {
    if (i != b && i != o) rest.push_back(i);
  }
  const auto size = static_cast<long>(rest.size());
  SampledSystem loop{Eigen::MatrixXd(size, size), Eigen::VectorXd(size), Eigen::RowVectorXd(size),
                     dt};
  for (long i = 0; i < size; ++i) {
    const long row = rest[static_cast<std::size_t>(i)];
    loop.b[i] = model.A(row, b);
    loop.c[i] = -model.A(b, row);
    // The other command acts in the same step again.
    for (long k = 0; k < size; ++k) {
      const long column = rest[static_cast<std::size_t>(k)];
      loop.A(i, k) = model.A(row, column) + model.A(row, o) * model.A(o, column);
    }
  }
  return loop;
}

LoopMargins FindLoopMargins(const SampledSystem& loop) {
  constexpr double kLowest = 0.02;  // rad/s: below it is the pilot's, and nothing is crossed
  constexpr int kCount = 1500;
  const std::vector<double> frequencies = LogFrequencies(kLowest, kPi / loop.dt, kCount);
  LoopMargins margins;
  std::complex<double> before = loop.ResponseAt(frequencies.front());
  for (std::size_t i = 1; i < frequencies.size(); ++i) {
    const std::complex<double> after = loop.ResponseAt(frequencies[i]);
    const double low = frequencies[i - 1], high = frequencies[i];
    const double gain_before = std::abs(before) - 1, gain_after = std::abs(after) - 1;
    if (gain_before * gain_after < 0) {
      NotePhase(ZeroBetween(gain_before, gain_after), low, high, before, after, &margins);
    }
    if (before.imag() * after.imag() < 0) {
      NoteGain(ZeroBetween(before.imag(), after.imag()), low, high, before, after, &margins);
    }
    before = after;
  }
  // At half the sampling frequency the response is real.
  NoteGain(1, frequencies.back(), frequencies.back(), before, before, &margins);
  return margins;
}

}  // namespace skein
