// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/closed_loop_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "envs/aircraft/engine.h"
#include "envs/state/state.h"

namespace skein {
namespace {

/// Differences small against every kink but that a limiter may have at the trim itself.
double StepOf(int column) {
  if (column < kP) return 1e-2;
  if (column < kNorth) return 1e-4;
  if (column < kElevatorMemory) return 1e-5;
  if (column < kFlightControlMemory) return 1e-3;
  return column == kNormalAccelerationMemory || column == kSideAccelerationMemory ? 1e-5 : 1e-4;
}

std::vector<int> ColumnsOf(LoopAxis axis) {
  const auto control = [](Column column) { return kFlightControlMemory + column - kAlphaFilter; };
  if (axis == LoopAxis::kLongitudinal) {
    std::vector<int> columns = {kU, kW, kQ, kQ0, kQy, kElevatorMemory, kElevatorMemory + 3};
    for (const Column column :
         {kAlphaFilter, kPitchRateFilter, kPitchRateWashout, kLoadFactorFilter,
          kLoadFactorCommandFilter, kPitchLeadFilter, kPitchIntegrator, kFlapFilter}) {
      columns.push_back(control(column));
    }
    columns.insert(columns.end(), {kNormalAccelerationMemory, kCommandMemory, kCommandMemory + 3});
    return columns;
  }
  std::vector<int> columns = {kV, kP, kR, kQx, kQz, kElevatorMemory + 1, kElevatorMemory + 2};
  for (const Column column :
       {kRollRateFilter, kRollCommandFilter, kRollIntegrator, kYawRateFilter, kYawWashout,
        kYawLeadFilter, kPedalFilter, kLateralAccelerationFilter}) {
    columns.push_back(control(column));
  }
  columns.insert(columns.end(), {kSideAccelerationMemory, kCommandMemory + 1, kCommandMemory + 2});
  return columns;
}

Eigen::VectorXd Entries(const Eigen::VectorXd& memory, const std::vector<int>& columns) {
  Eigen::VectorXd entries(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    entries[static_cast<long>(i)] = memory[columns[i]];
  return entries;
}

/// Whether an eigenvalue of a step is neither a delay's nor neutral.
bool IsMotion(std::complex<double> eigenvalue, double dt) {
  constexpr double kDelay = 1e-6, kNeutral = 1e-5;
  return std::abs(eigenvalue) >= kDelay && std::abs(eigenvalue - 1.0) >= kNeutral * dt;
}

/// The loop's step map from its memory at the trim.
class StepMap {
 public:
  StepMap(const Plant& plant, const TrimPoint& trim, double dt, bool delayed)
      : loop_(plant, trim, FlightControlMode::kFull, dt), start_(loop_.memory()) {
    loop_.set_delayed(delayed);
    pilot_.throttle = ThrottleForPower(plant.aircraft().throttle_gearing, trim.power);
  }

  Eigen::VectorXd From(int column, double difference) {
    Eigen::VectorXd memory = start_;
    memory[column] += difference;
    return Step(memory, pilot_);
  }
  Eigen::VectorXd With(double PilotCommands::*stick, double position) {
    PilotCommands pilot = pilot_;
    pilot.*stick = position;
    return Step(start_, pilot);
  }

 private:
  Eigen::VectorXd Step(const Eigen::VectorXd& memory, const PilotCommands& pilot) {
    loop_.set_memory(memory);
    loop_.Step(pilot);
    return loop_.memory();
  }

  ClosedLoop loop_;
  Eigen::VectorXd start_;
  PilotCommands pilot_;
};

}  // namespace

ClosedLoopModel LineariseClosedLoop(const Plant& plant, const TrimPoint& trim, LoopAxis axis,
                                    double dt, bool delayed) {
  constexpr double kStickStep = 1e-4;
  ClosedLoopModel model;
  model.dt = dt;
  model.columns = ColumnsOf(axis);
  StepMap map(plant, trim, dt, delayed);
  const auto size = static_cast<long>(model.columns.size());
  model.A.resize(size, size);
  for (long i = 0; i < size; ++i) {
    const int column = model.columns[static_cast<std::size_t>(i)];
    const double step = StepOf(column);
    model.A.col(i) =
        Entries(map.From(column, step) - map.From(column, -step), model.columns) / (2 * step);
  }
  const std::vector<double PilotCommands::*> sticks =
      axis == LoopAxis::kLongitudinal
          ? std::vector<double PilotCommands::*>{&PilotCommands::pitch}
          : std::vector<double PilotCommands::*>{&PilotCommands::roll, &PilotCommands::yaw};
  model.B.resize(size, static_cast<long>(sticks.size()));
  for (std::size_t k = 0; k < sticks.size(); ++k) {
    const Eigen::VectorXd change = map.With(sticks[k], kStickStep) - map.With(sticks[k], 0);
    model.B.col(static_cast<long>(k)) = Entries(change, model.columns) / kStickStep;
  }
  return model;
}

std::vector<double> ClosedLoopModel::StepResponse(int input, int column, double seconds) const {
  long row = 0;
  while (columns[static_cast<std::size_t>(row)] != column) ++row;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.rows());
  std::vector<double> response;
  for (int i = 0; i < std::lround(seconds / dt); ++i) {
    x = A * x + B.col(input);
    response.push_back(x[row]);
  }
  return response;
}

std::vector<std::complex<double>> ClosedLoopModel::Modes() const {
  const Eigen::VectorXcd eigenvalues = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
  std::vector<std::complex<double>> modes;
  for (const std::complex<double>& value : eigenvalues) {
    if (IsMotion(value, dt)) modes.push_back(std::log(value) / dt);
  }
  return modes;
}

std::vector<LinearMode> ClosedLoopModel::ModesWithShares() const {
  std::vector<LinearMode> modes;
  for (LinearMode mode : FindLinearModes(A)) {
    if (!IsMotion(mode.eigenvalue, dt)) continue;
    mode.eigenvalue = std::log(mode.eigenvalue) / dt;
    modes.push_back(std::move(mode));
  }
  std::sort(modes.begin(), modes.end(), IsSlower);
  return modes;
}

}  // namespace skein
