// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "envs/reference/linear_flight.h"

namespace skein {

/// Damping ratio of a mode: 1 for one that only decays, -1 for one that only grows.
double DampingRatio(std::complex<double> mode);

/// Time to double of a mode, s; infinity if it does not grow.
double TimeToDouble(std::complex<double> mode);

/// A motion that a linear system can have by itself.
struct LinearMode {
  std::complex<double> eigenvalue;  ///< 1/s; of a pair the one with the positive imaginary part
  /// How much of it each state is: participation factors |left| |right|, their sum 1 (I. J.
  /// Perez-Arriaga, G. C. Verghese, F. C. Schweppe, IEEE Trans. PAS-101, 1982).
  std::vector<double> shares;

  double frequency_rad_s() const { return std::abs(eigenvalue); }       ///< undamped
  bool is_oscillatory() const { return eigenvalue.imag() > 0; }         ///< one of a conjugate pair
  double damping_ratio() const { return DampingRatio(eigenvalue); }     ///< as of DampingRatio
  double time_constant_s() const { return -1 / eigenvalue.real(); }     ///< below 0: it grows
  double time_to_half_s() const { return TimeToDouble(-eigenvalue); }   ///< or infinity
  double time_to_double_s() const { return TimeToDouble(eigenvalue); }  ///< or infinity
};

/// Whether `a` has the lower undamped frequency.
bool IsSlower(const LinearMode& a, const LinearMode& b);

/// The modes of x' = A x, the slowest first.
std::vector<LinearMode> FindLinearModes(const Eigen::MatrixXd& A);

/// The five motions of a conventional airframe.
enum class ModeFamily { kShortPeriod, kPhugoid, kRoll, kDutchRoll, kSpiral };

/// A mode of the bare airframe, with its name.
struct FlightMode : LinearMode {
  std::string name;
  ModeFamily family = ModeFamily::kShortPeriod;  ///< what it is, or is nearest to
};

/// The modes of speed, alpha, pitch, q, beta, bank, p and r, altitude and power held: those that
/// are mostly of the first four from the fastest to the slowest, then the others, of which the
/// oscillatory ones come first. They are
///   short period, phugoid, Dutch roll, roll, spiral
/// by speed and by whether they are oscillatory: of the longitudinal pairs the faster is the short
/// period, of the real lateral ones the fastest is roll and the slowest spiral. Names of what is
/// rarer: "short period, real" and "phugoid, real" where a pair has become two real modes (an
/// unstable airframe), "third oscillatory" (a phugoid by its family) for a pair between two real
/// ones, "roll-spiral" (a spiral) for a second lateral pair, "Dutch roll, real". A single real
/// lateral one is roll where it is more of roll rate than of bank, else spiral. Names are of flight
/// with level wings: in a turn all modes couple, and each has the name of what it is nearest to.
std::vector<FlightMode> FindFlightModes(const LinearFlight& model);

}  // namespace skein
