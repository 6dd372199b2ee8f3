// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/linear_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace skein {
namespace {

using Complex = std::complex<double>;

constexpr int kNumOfModes = kAltitude;       // the states before the altitude
constexpr int kNumLongitudinal = kSideslip;  // those of the plane of symmetry

/// Column of the eigenvalue nearest to `value`.
long Nearest(const Eigen::VectorXcd& values, Complex value) {
  long nearest = 0;
  (values.array() - value).abs().minCoeff(&nearest);
  return nearest;
}

std::vector<double> Shares(const Eigen::VectorXcd& left, const Eigen::VectorXcd& right) {
  const Eigen::VectorXd products = left.cwiseAbs().cwiseProduct(right.cwiseAbs());
  const double sum = products.sum();
  std::vector<double> shares;
  for (const double product : products) shares.push_back(sum > 0 ? product / sum : 0);
  return shares;
}

bool IsLongitudinal(const LinearMode& mode) {
  return std::accumulate(mode.shares.begin(), mode.shares.begin() + kNumLongitudinal, 0.0) > 0.5;
}

/// Names of modes that stand from the fastest to the slowest.
std::vector<std::string> LongitudinalNames(const std::vector<FlightMode>& modes) {
  const auto is_oscillatory = [](const FlightMode& mode) { return mode.is_oscillatory(); };
  const auto pairs = std::count_if(modes.begin(), modes.end(), is_oscillatory);
  const auto first_pair = std::find_if(modes.begin(), modes.end(), is_oscillatory);
  std::vector<std::string> names;
  for (auto mode = modes.begin(); mode != modes.end(); ++mode) {
    const bool is_first = mode == modes.begin(), is_last = mode + 1 == modes.end();
    if (mode->is_oscillatory()) {
      const bool is_between = pairs == 1 && !is_first && !is_last;
      names.emplace_back(is_between ? "third oscillatory" : is_first ? "short period" : "phugoid");
    } else {
      const bool is_fast =
          pairs > 0 ? mode < first_pair : 2 * (mode - modes.begin()) < modes.end() - modes.begin();
      names.emplace_back(is_fast ? "short period, real" : "phugoid, real");
    }
  }
  return names;
}

/// Of the only real lateral mode.
const char* RollOrSpiral(const FlightMode& mode) {
  return mode.shares[kRollRate] > mode.shares[kBankAngle] ? "roll" : "spiral";
}

std::vector<std::string> LateralNames(const std::vector<FlightMode>& modes) {
  std::vector<std::size_t> real;  // from the fastest to the slowest
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (!modes[i].is_oscillatory()) real.push_back(i);
  }
  std::vector<std::string> names;
  bool has_dutch_roll = false;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (modes[i].is_oscillatory()) {
      names.emplace_back(has_dutch_roll ? "roll-spiral" : "Dutch roll");
      has_dutch_roll = true;
    } else if (real.size() == 1) {
      names.emplace_back(RollOrSpiral(modes[i]));
    } else if (i == real.back()) {
      names.emplace_back("spiral");
    } else {
      names.emplace_back(i == real.front() ? "roll" : "Dutch roll, real");
    }
  }
  return names;
}

ModeFamily FamilyOf(const std::string& name) {
  const auto begins = [&name](const char* start) { return name.rfind(start, 0) == 0; };
  if (begins("short period")) return ModeFamily::kShortPeriod;
  if (begins("phugoid") || name == "third oscillatory") return ModeFamily::kPhugoid;
  if (begins("Dutch roll")) return ModeFamily::kDutchRoll;
  return name == "roll" ? ModeFamily::kRoll : ModeFamily::kSpiral;
}

}  // namespace

double DampingRatio(std::complex<double> mode) {
  return mode == 0.0 ? 0 : -mode.real() / std::abs(mode);
}

double TimeToDouble(std::complex<double> mode) {
  constexpr double kNeutral = 1e-4;
  return mode.real() > kNeutral ? std::log(2.0) / mode.real()
                                : std::numeric_limits<double>::infinity();
}

bool IsSlower(const LinearMode& a, const LinearMode& b) {
  return a.frequency_rad_s() < b.frequency_rad_s();
}

std::vector<LinearMode> FindLinearModes(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> right(A), left(A.transpose());
  const Eigen::VectorXcd& values = right.eigenvalues();
  const Eigen::VectorXcd& left_values = left.eigenvalues();
  const Eigen::MatrixXcd right_vectors = right.eigenvectors(), left_vectors = left.eigenvectors();
  std::vector<LinearMode> modes;
  for (long i = 0; i < values.size(); ++i) {
    if (values[i].imag() < 0) continue;
    modes.push_back({values[i], Shares(left_vectors.col(Nearest(left_values, values[i])),
                                       right_vectors.col(i))});
  }
  std::sort(modes.begin(), modes.end(), IsSlower);
  return modes;
}

std::vector<FlightMode> FindFlightModes(const LinearFlight& model) {
  std::vector<FlightMode> longitudinal, lateral;
  const std::vector<LinearMode> modes =
      FindLinearModes(model.A.topLeftCorner(kNumOfModes, kNumOfModes));
  for (auto mode = modes.rbegin(); mode != modes.rend(); ++mode) {
    (IsLongitudinal(*mode) ? longitudinal : lateral).push_back({*mode, ""});
  }
  std::stable_partition(lateral.begin(), lateral.end(),
                        [](const FlightMode& mode) { return mode.is_oscillatory(); });
  const std::vector<std::string> longitudinal_names = LongitudinalNames(longitudinal);
  const std::vector<std::string> lateral_names = LateralNames(lateral);
  for (std::size_t i = 0; i < longitudinal.size(); ++i)
    longitudinal[i].name = longitudinal_names[i];
  for (std::size_t i = 0; i < lateral.size(); ++i) lateral[i].name = lateral_names[i];
  longitudinal.insert(longitudinal.end(), lateral.begin(), lateral.end());
  for (FlightMode& mode : longitudinal) mode.family = FamilyOf(mode.name);
  return longitudinal;
}

}  // namespace skein
