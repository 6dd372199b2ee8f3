// SPDX-License-Identifier: Apache-2.0
#include "envs/tuning/closed_loop_outputs.h"

#include <array>

#include "envs/state/attitude.h"
#include "envs/state/state.h"

namespace skein {
namespace {

// In the order of the memory.
constexpr std::array<ModelVariable, kClosedLoopMemory> kMemory = {
    {{"u_fps", "ft/s"},
     {"v_fps", "ft/s"},
     {"w_fps", "ft/s"},
     {"p_rad_s", "rad/s"},
     {"q_rad_s", "rad/s"},
     {"r_rad_s", "rad/s"},
     {"north_ft", "ft"},
     {"east_ft", "ft"},
     {"down_ft", "ft"},
     {"q0", "1"},
     {"qx", "1"},
     {"qy", "1"},
     {"qz", "1"},
     {"elevator_deg", "deg"},
     {"aileron_deg", "deg"},
     {"rudder_deg", "deg"},
     {"leading_edge_flap_deg", "deg"},
     {"alpha_filter", "deg"},
     {"pitch_rate_filter", "deg/s"},
     {"pitch_rate_washout", "deg/s"},
     {"load_factor_filter", "g"},
     {"load_factor_command_filter", "g"},
     {"pitch_lead_filter", "g"},
     {"pitch_integrator", "deg"},
     {"roll_rate_filter", "deg/s"},
     {"roll_command_filter", "deg/s"},
     {"roll_integrator", "deg"},
     {"yaw_rate_filter", "deg/s"},
     {"yaw_washout", "deg/s"},
     {"yaw_lead_filter", "deg/s"},
     {"pedal_filter", "deg"},
     {"lateral_acceleration_filter", "g"},
     {"flap_filter", "deg"},
     {"trim_aileron", "deg"},
     {"trim_rudder", "deg"},
     {"power", "%"},
     {"load_factor_g", "g"},
     {"lateral_load_factor_g", "g"},
     {"elevator_command_deg", "deg"},
     {"aileron_command_deg", "deg"},
     {"rudder_command_deg", "deg"},
     {"flap_command_deg", "deg"}}};
static_assert(kPowerMemory == 35, "the names stand in the order of the memory");

constexpr std::array<ModelVariable, 5> kPitchOutputs = {{{"true_airspeed_fps", "ft/s"},
                                                         {"alpha_deg", "deg"},
                                                         {"pitch_deg", "deg"},
                                                         {"q_deg_s", "deg/s"},
                                                         {"load_factor_g", "g"}}};
constexpr std::array<ModelVariable, 5> kLateralOutputs = {{{"beta_deg", "deg"},
                                                           {"bank_deg", "deg"},
                                                           {"p_deg_s", "deg/s"},
                                                           {"r_deg_s", "deg/s"},
                                                           {"lateral_load_factor_g", "g"}}};

Eigen::VectorXd Measure(const Plant& plant, LoopAxis axis, const Eigen::VectorXd& memory) {
  const RigidBodyState state = memory.head<kNumRigidBody>();
  const AirData air = plant.AirAround(state, Eigen::Vector3d::Zero());
  const EulerAngles attitude = EulerFromQuaternion(state.segment<4>(kQ0));
  Eigen::VectorXd outputs(5);
  if (axis == LoopAxis::kLongitudinal) {
    outputs << air.true_airspeed_ft_s, air.alpha_rad * kDegPerRad, attitude.pitch * kDegPerRad,
        state[kQ] * kDegPerRad, memory[kNormalAccelerationMemory];
  } else {
    outputs << air.beta_rad * kDegPerRad, attitude.roll * kDegPerRad, state[kP] * kDegPerRad,
        state[kR] * kDegPerRad, memory[kSideAccelerationMemory];
  }
  return outputs;
}

}  // namespace

ModelVariable ClosedLoopVariable(int column) { return kMemory[static_cast<std::size_t>(column)]; }

std::vector<ModelVariable> ClosedLoopInputs(LoopAxis axis) {
  if (axis == LoopAxis::kLongitudinal) return {{"pitch_stick", "1"}};
  return {{"roll_stick", "1"}, {"yaw_pedals", "1"}};
}

ClosedLoopOutputs LineariseOutputs(const Plant& plant, const TrimPoint& trim, LoopAxis axis,
                                   const ClosedLoopModel& model) {
  constexpr double kStep = 1e-4;
  const Eigen::VectorXd start =
      ClosedLoop(plant, trim, FlightControlMode::kFull, model.dt).memory();
  ClosedLoopOutputs result;
  const auto& outputs = axis == LoopAxis::kLongitudinal ? kPitchOutputs : kLateralOutputs;
  result.outputs.assign(outputs.begin(), outputs.end());
  result.C.resize(static_cast<long>(result.outputs.size()), model.A.rows());
  for (std::size_t i = 0; i < model.columns.size(); ++i) {
    Eigen::VectorXd ahead = start, behind = start;
    ahead[model.columns[i]] += kStep;
    behind[model.columns[i]] -= kStep;
    result.C.col(static_cast<long>(i)) =
        (Measure(plant, axis, ahead) - Measure(plant, axis, behind)) / (2 * kStep);
  }
  return result;
}

}  // namespace skein
