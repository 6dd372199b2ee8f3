// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/linearise.h"

#include "envs/state/state.h"

namespace skein {
namespace {

constexpr double kVelocityStepFtS = 1e-2;
constexpr double kRateStepRadS = 1e-4;
constexpr double kPositionStepFt = 1;
constexpr double kQuaternionStep = 1e-5;
constexpr double kThrustStepLbf = 1;
constexpr double kSurfaceStepDeg = 1e-3;

double StepOf(int state_column) {
  if (state_column < kP) return kVelocityStepFtS;
  if (state_column < kNorth) return kRateStepRadS;
  return state_column < kQ0 ? kPositionStepFt : kQuaternionStep;
}

}  // namespace

LinearModel Linearise(const Plant& plant, const RigidBodyState& state, const Controls& controls) {
  LinearModel model;
  for (int i = 0; i < kNumRigidBody; ++i) {
    const double step = StepOf(i);
    RigidBodyState ahead = state, behind = state;
    ahead[i] += step;
    behind[i] -= step;
    model.A.col(i) =
        (plant.Evaluate(ahead, controls).state_rate - plant.Evaluate(behind, controls).state_rate) /
        (2 * step);
  }
  constexpr double Controls::*kInputs[] = {&Controls::thrust_lbf, &Controls::elevator_deg,
                                           &Controls::aileron_deg, &Controls::rudder_deg,
                                           &Controls::leading_edge_flap_deg};
  for (int i = 0; i < 5; ++i) {
    const double step = i == 0 ? kThrustStepLbf : kSurfaceStepDeg;
    Controls ahead = controls, behind = controls;
    ahead.*kInputs[i] += step;
    behind.*kInputs[i] -= step;
    model.B.col(i) =
        (plant.Evaluate(state, ahead).state_rate - plant.Evaluate(state, behind).state_rate) /
        (2 * step);
  }
  return model;
}

}  // namespace skein
