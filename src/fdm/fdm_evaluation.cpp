// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/fdm_evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "base/aligned_vector.h"
#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/kernels/kernel_airframe.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/reference/plant.h"
#include "envs/state/attitude.h"
#include "src/fdm/fdm_plant.h"

namespace skein {
namespace {

Plant PlantWith(Aircraft aircraft, const FdmModel& model, const FdmParameters& parameters) {
  if (parameters.cg) aircraft.airframe.cg = *parameters.cg;
  aircraft.airframe.engine_angular_momentum = parameters.engine_angular_momentum;
  return {std::move(aircraft), model.atmosphere, 1, model.gravity};
}

RigidBodyState ToState(const FdmState& numbers) {
  return Eigen::Map<const RigidBodyState>(numbers.data());
}

FdmPointResult EvaluateScalar(const Plant& plant, const FdmPoint& point) {
  const PlantOutput output =
      plant.Evaluate(ToState(point.state), ToControls(point.controls.data()));
  FdmPointResult result;
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(result.coefficients.data()) = output.coefficients;
  Eigen::Map<RigidBodyState>(result.state_rate.data()) = output.state_rate;
  result.alpha_deg = output.air.alpha_rad * kDegPerRad;
  result.beta_deg = output.air.beta_rad * kDegPerRad;
  result.mach = output.air.mach;
  result.dynamic_pressure_psf = output.air.dynamic_pressure_psf;
  return result;
}

/// Columns of one tile for open-loop kernels: rigid body and controls, padding lanes included.
class OpenLoopTile {
 public:
  explicit OpenLoopTile(int count)
      : count_(count),
        stride_(TileStride(count)),
        columns_((kNumRigidBody + kNumControls) * stride_) {}

  Tile state() { return {columns_.data(), stride_, count_}; }
  ControlColumns controls() const {
    const float* first = columns_.data() + kNumRigidBody * stride_;
    return {first, first + stride_, first + 2 * stride_, first + 3 * stride_, first + 4 * stride_};
  }
  /// Fills lane `i`; the last filled aircraft also fills the padding, which kernels process too.
  void SetState(int i, const FdmState& state) { Set(0, i, state); }
  void SetControls(int i, const FdmControls& controls) { Set(kNumRigidBody, i, controls); }
  std::size_t stride() const { return stride_; }

 private:
  static constexpr int kNumControls = 5;

  template <std::size_t kCount>
  void Set(int first_column, int i, const std::array<double, kCount>& numbers) {
    const std::size_t end = i + 1 == count_ ? stride_ : static_cast<std::size_t>(i) + 1;
    for (std::size_t c = 0; c < kCount; ++c) {
      float* column = columns_.data() + (static_cast<std::size_t>(first_column) + c) * stride_;
      std::fill(column + i, column + end, static_cast<float>(numbers[c]));
    }
  }

  int count_;
  std::size_t stride_;
  AlignedVector<float> columns_;
};

void EvaluateWithKernel(const KernelAircraft& kernel, const std::vector<FdmPoint>& points,
                        const std::vector<std::size_t>& which,
                        std::vector<FdmPointResult>* results) {
  const int count = static_cast<int>(which.size());
  OpenLoopTile tile(count);
  for (int i = 0; i < count; ++i) {
    tile.SetState(i, points[which[static_cast<std::size_t>(i)]].state);
    tile.SetControls(i, points[which[static_cast<std::size_t>(i)]].controls);
  }
  std::vector<float> rates(kNumRigidBody * tile.stride()), coefficients(6 * tile.stride());
  EvaluateTile(kernel, tile.state(), tile.controls(), rates.data(), coefficients.data());
  for (std::size_t i = 0; i < which.size(); ++i) {
    FdmPointResult& result = (*results)[which[i]];
    for (std::size_t c = 0; c < 13; ++c) result.state_rate[c] = rates[c * tile.stride() + i];
    for (std::size_t c = 0; c < 6; ++c) {
      result.coefficients[c] = coefficients[c * tile.stride() + i];
    }
  }
}

std::vector<long> StepsOf(const FdmTrajectory& trajectory, double dt) {
  // Times are decimal fractions in a file: equal to a multiple of dt only up to rounding.
  constexpr double kTimeTolerance = 1e-9;
  constexpr double kMaxSteps = 1e9;
  std::vector<long> steps;
  for (const double t : trajectory.t) {
    const double step = std::round(t / dt);
    if (std::abs(step * dt - t) > kTimeTolerance * std::max(1.0, t)) {
      throw Error(fmt::format("time {} s is not a multiple of the step of {} s", t, dt));
    }
    if (step > kMaxSteps) {
      throw Error(fmt::format("time {} s is more than {} steps of {} s", t, kMaxSteps, dt));
    }
    steps.push_back(static_cast<long>(step));
  }
  return steps;
}

FdmControls ControlsAt(const FdmTrajectory& trajectory, double t) {
  FdmControls controls = trajectory.trim_controls;
  for (const FdmPulse& pulse : trajectory.pulses) {
    if (pulse.t_start <= t && t < pulse.t_end) {
      controls[static_cast<std::size_t>(pulse.control_index)] += pulse.delta;
    }
  }
  return controls;
}

}  // namespace

std::vector<FdmPointResult> EvaluatePoints(const std::vector<FdmPoint>& points,
                                           const FdmModel& model) {
  std::vector<FdmPointResult> results(points.size());
  const Aircraft aircraft = LoadAircraft(model.aircraft);
  std::shared_ptr<const KernelAircraft> kernel;
  if (model.precision == FdmPrecision::kFloat32) {
    kernel = MakeKernelAircraft(aircraft, model.atmosphere, model.gravity);
  }
  std::map<FdmParameters, std::vector<std::size_t>> groups;  // which share one plant
  for (std::size_t i = 0; i < points.size(); ++i) groups[points[i].parameters].push_back(i);
  for (const auto& [parameters, which] : groups) {
    const Plant plant = PlantWith(aircraft, model, parameters);
    for (const std::size_t i : which) results[i] = EvaluateScalar(plant, points[i]);
    if (kernel != nullptr) {
      kernel = WithAirframe(std::move(kernel), plant.aircraft().airframe, model.gravity);
      EvaluateWithKernel(*kernel, points, which, &results);
    }
  }
  return results;
}

std::vector<FdmState> FlyTrajectory(const FdmTrajectory& trajectory, double dt,
                                    const FdmModel& model) {
  const std::vector<long> steps = StepsOf(trajectory, dt);
  const Plant plant = PlantWith(LoadAircraft(model.aircraft), model, trajectory.parameters);
  std::shared_ptr<const KernelAircraft> kernel;
  OpenLoopTile tile(1);
  if (model.precision == FdmPrecision::kFloat32) {
    kernel = MakeKernelAircraft(plant.aircraft(), model.atmosphere, model.gravity);
    tile.SetState(0, trajectory.initial_state);
  }
  std::vector<FdmState> states;
  FdmState state = trajectory.initial_state;
  long step = 0;
  for (const long record : steps) {
    for (; step < record; ++step) {
      const FdmControls controls = ControlsAt(trajectory, static_cast<double>(step) * dt);
      if (kernel) {
        tile.SetControls(0, controls);
        StepTileOpenLoop(*kernel, tile.state(), tile.controls(), static_cast<float>(dt), 1);
      } else {
        Eigen::Map<RigidBodyState>(state.data()) =
            plant.StepRk4(ToState(state), ToControls(controls.data()), dt);
      }
    }
    if (kernel) {
      for (int c = 0; c < kNumRigidBody; ++c) {
        state[static_cast<std::size_t>(c)] = tile.state()[c][0];
      }
    }
    states.push_back(state);
  }
  return states;
}

}  // namespace skein
