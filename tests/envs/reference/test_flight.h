// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "envs/aircraft/engine.h"
#include "envs/reference/closed_loop.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"

namespace skein {

/// The control interval of the flights, s.
inline constexpr double kDt = 0.02;

/// What happened in a flight, one entry per control step; degrees, deg/s, g.
struct Flight {
  std::vector<double> time, alpha, beta, p, q, r, nz, bank;

  bool Departed() const {
    for (std::size_t i = 0; i < time.size(); ++i) {
      // Written so that a state that is not a number has departed.
      if (!(std::abs(alpha[i]) <= 35 && std::abs(beta[i]) <= 20 && std::abs(p[i]) <= 500)) {
        return true;
      }
    }
    return false;
  }
};

using Sticks = std::function<void(double time, PilotCommands* pilot)>;

struct Setting {
  double push = 0;  ///< first, in multiples of (0.05, 0.05, 0.02) rad/s about the body axes
  bool delayed = false;
  int substeps = 1;
};

inline Flight Fly(const Plant& plant, const TrimPoint& trim, double seconds, const Sticks& sticks,
                  const Setting& setting = {}) {
  ClosedLoop loop(plant, trim, FlightControlMode::kFull, kDt, setting.substeps);
  loop.set_delayed(setting.delayed);
  loop.mutable_state().segment<3>(kP) += setting.push * Eigen::Vector3d(0.05, 0.05, 0.02);
  Flight flight;
  PilotCommands pilot;
  pilot.throttle = ThrottleForPower(plant.aircraft().throttle_gearing, trim.power);
  const int steps = static_cast<int>(std::lround(seconds / kDt));
  for (int i = 0; i < steps; ++i) {
    sticks(i * kDt, &pilot);
    loop.Step(pilot);
    const AirData air = loop.air();
    flight.time.push_back((i + 1) * kDt);
    flight.alpha.push_back(air.alpha_rad * kDegPerRad);
    flight.beta.push_back(air.beta_rad * kDegPerRad);
    flight.p.push_back(loop.state()[kP] * kDegPerRad);
    flight.q.push_back(loop.state()[kQ] * kDegPerRad);
    flight.r.push_back(loop.state()[kR] * kDegPerRad);
    flight.nz.push_back(loop.nz());
    flight.bank.push_back(EulerFromQuaternion(loop.state().segment<4>(kQ0)).roll * kDegPerRad);
  }
  return flight;
}

inline const Sticks kHandsOff = [](double, PilotCommands*) {};

inline Sticks Held(double pitch, double roll, double yaw) {
  return [=](double, PilotCommands* pilot) {
    pilot->pitch = pitch;
    pilot->roll = roll;
    pilot->yaw = yaw;
  };
}

/// Standard deviation about a parabola of what `values` do from `start` on: ringing that has not
/// died.
inline double Ringing(const Flight& flight, const std::vector<double>& values, double start) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (flight.time[i] >= start) rows.push_back(i);
  }
  Eigen::MatrixXd basis(rows.size(), 3);
  Eigen::VectorXd y(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double t = flight.time[rows[k]] - start;
    basis.row(k) << 1, t, t * t;
    y[k] = values[rows[k]];
  }
  const Eigen::VectorXd fit = basis.colPivHouseholderQr().solve(y);
  return std::sqrt((y - basis * fit).squaredNorm() / static_cast<double>(rows.size()));
}

inline double Peak(const std::vector<double>& values) {
  double peak = 0;
  for (double value : values) peak = std::max(peak, std::abs(value));
  return peak;
}

}  // namespace skein
