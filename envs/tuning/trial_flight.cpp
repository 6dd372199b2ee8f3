// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/trial_flight.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "envs/aircraft/engine.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"

namespace skein {

bool TrialFlight::Departed() const {
  for (std::size_t i = 0; i < time.size(); ++i) {
    // Written so that a state that is not a number has departed.
    if (!(std::abs(alpha[i]) <= 35 && std::abs(beta[i]) <= 20 && std::abs(p[i]) <= 500)) {
      return true;
    }
  }
  return false;
}

TrialFlight FlyTrial(const Plant& plant, const TrimPoint& trim, double seconds,
                     const Sticks& sticks, const TrialSetting& setting) {
  ClosedLoop loop(plant, trim, FlightControlMode::kFull, kTrialInterval, setting.substeps);
  loop.set_delayed(setting.delayed);
  loop.mutable_state().segment<3>(kP) += setting.push * Eigen::Vector3d(0.05, 0.05, 0.02);
  TrialFlight flight;
  PilotCommands pilot;
  pilot.throttle = ThrottleForPower(plant.aircraft().throttle_gearing, trim.power);
  const int steps = static_cast<int>(std::lround(seconds / kTrialInterval));
  for (int i = 0; i < steps; ++i) {
    sticks(i * kTrialInterval, &pilot);
    loop.Step(pilot);
    const AirData air = loop.air();
    flight.time.push_back((i + 1) * kTrialInterval);
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

Sticks HandsOff() {
  return [](double, PilotCommands*) {};
}

Sticks Held(double pitch, double roll, double yaw) {
  return [=](double, PilotCommands* pilot) {
    pilot->pitch = pitch;
    pilot->roll = roll;
    pilot->yaw = yaw;
  };
}

std::vector<Sticks> FullSticks() {
  const auto reversed = [](double PilotCommands::*stick) -> Sticks {
    return [stick](double time, PilotCommands* pilot) {
      pilot->*stick = std::fmod(time, 2) < 1 ? 1.0 : -1.0;
    };
  };
  return {Held(1, 0, 0),
          Held(-1, 0, 0),
          Held(0, 1, 0),
          Held(1, 1, 0),
          Held(0, 0, 1),
          reversed(&PilotCommands::pitch),
          reversed(&PilotCommands::roll),
          reversed(&PilotCommands::yaw)};
}

double Ringing(const TrialFlight& flight, const std::vector<double>& values, double start) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (flight.time[i] >= start) rows.push_back(i);
  }
  Eigen::MatrixXd basis(rows.size(), 3);
  Eigen::VectorXd y(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double t = flight.time[rows[k]] - start;
    basis.row(static_cast<long>(k)) << 1, t, t * t;
    y[static_cast<long>(k)] = values[rows[k]];
  }
  const Eigen::VectorXd fit = basis.colPivHouseholderQr().solve(y);
  return std::sqrt((y - basis * fit).squaredNorm() / static_cast<double>(rows.size()));
}

double Peak(const std::vector<double>& values) {
  double peak = 0;
  for (const double value : values) {
    // std::max passes over what is not a number.
    if (std::isnan(value)) return std::numeric_limits<double>::infinity();
    peak = std::max(peak, std::abs(value));
  }
  return peak;
}

}  // namespace skein
