// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/linear_flight.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "envs/aircraft/engine.h"
#include "envs/reference/flight_control.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"

namespace skein {
namespace {

constexpr std::array<ModelVariable, kNumFlightVariables> kStates = {{{"true_airspeed_fps", "ft/s"},
                                                                     {"alpha_rad", "rad"},
                                                                     {"pitch_rad", "rad"},
                                                                     {"q_rad_s", "rad/s"},
                                                                     {"beta_rad", "rad"},
                                                                     {"bank_rad", "rad"},
                                                                     {"p_rad_s", "rad/s"},
                                                                     {"r_rad_s", "rad/s"},
                                                                     {"altitude_ft", "ft"}}};
/// The flap is the last: an input only if it is fixed.
enum Input { kPowerInput, kElevatorInput, kAileronInput, kRudderInput, kFlapInput, kNumInputs };
constexpr std::array<ModelVariable, kNumInputs> kInputs = {{{"power", "%"},
                                                            {"elevator_deg", "deg"},
                                                            {"aileron_deg", "deg"},
                                                            {"rudder_deg", "deg"},
                                                            {"leading_edge_flap_deg", "deg"}}};
constexpr std::array<ModelVariable, 6> kOutputs = {{{"load_factor_g", "g"},
                                                    {"lateral_load_factor_g", "g"},
                                                    {"alpha_deg", "deg"},
                                                    {"beta_deg", "deg"},
                                                    {"flight_path_deg", "deg"},
                                                    {"mach", "1"}}};

/// Differences that keep to one cell of the tables, unless the flight is at a node.
double StepOf(int variable) {
  constexpr double kSpeedStepFtS = 1e-2, kAngleStep = 1e-4, kAltitudeStepFt = 1;
  constexpr double kPowerStep = 1e-2, kSurfaceStepDeg = 1e-3;
  if (variable == kTrueAirspeed) return kSpeedStepFtS;
  if (variable == kAltitude) return kAltitudeStepFt;
  if (variable < kNumFlightVariables) return kAngleStep;
  return variable == kNumFlightVariables + kPowerInput ? kPowerStep : kSurfaceStepDeg;
}

/// Rates of the states and outputs, of states and inputs in one vector.
class FlightEquations {
 public:
  FlightEquations(const Plant& plant, const TrimPoint& trim, FlapMotion flap)
      : plant_(plant), flap_(flap) {
    const AirData air = plant.AirAround(trim.state, Eigen::Vector3d::Zero());
    const Controls& controls = trim.controls;
    start_.resize(kNumFlightVariables + NumInputs());
    start_.head<kNumFlightVariables>() << air.true_airspeed_ft_s, air.alpha_rad, trim.pitch_rad,
        trim.state[kQ], air.beta_rad, trim.bank_rad, trim.state[kP], trim.state[kR],
        -trim.state[kDown];
    Eigen::Matrix<double, kNumInputs, 1> inputs;
    inputs << trim.power, controls.elevator_deg, controls.aileron_deg, controls.rudder_deg,
        controls.leading_edge_flap_deg;
    start_.tail(NumInputs()) = inputs.head(NumInputs());
    extra_thrust_lbf_ = controls.thrust_lbf - EngineThrust(start_);
  }

  int NumInputs() const { return flap_ == FlapMotion::kFixed ? kNumInputs : kNumInputs - 1; }
  const Eigen::VectorXd& start() const { return start_; }

  Eigen::VectorXd operator()(const Eigen::VectorXd& x) const {
    const RigidBodyState state = StateOf(x);
    const PlantOutput output = plant_.Evaluate(state, ControlsOf(x, state));
    Eigen::VectorXd result(kNumFlightVariables + static_cast<int>(kOutputs.size()));
    result.head<kNumFlightVariables>() = RatesOf(x, state, output.state_rate);
    result.tail<kOutputs.size()>() << output.nz, output.ny, x[kAngleOfAttack] * kDegPerRad,
        x[kSideslip] * kDegPerRad,
        std::asin(-output.state_rate[kDown] / x[kTrueAirspeed]) * kDegPerRad, output.air.mach;
    return result;
  }

 private:
  double EngineThrust(const Eigen::VectorXd& x) const {
    const double mach =
        x[kTrueAirspeed] / AirAt(plant_.atmosphere(), x[kAltitude]).sound_speed_ft_s;
    return Thrust(plant_.aircraft().engine, x[kNumFlightVariables + kPowerInput], x[kAltitude],
                  mach);
  }

  static RigidBodyState StateOf(const Eigen::VectorXd& x) {
    RigidBodyState state = RigidBodyState::Zero();
    const double across = x[kTrueAirspeed] * std::cos(x[kSideslip]);
    state[kU] = across * std::cos(x[kAngleOfAttack]);
    state[kV] = x[kTrueAirspeed] * std::sin(x[kSideslip]);
    state[kW] = across * std::sin(x[kAngleOfAttack]);
    state.segment<3>(kP) << x[kRollRate], x[kPitchRate], x[kYawRate];
    state[kDown] = -x[kAltitude];
    state.segment<4>(kQ0) = QuaternionFromEuler({x[kBankAngle], x[kPitchAngle], 0});
    return state;
  }

  Controls ControlsOf(const Eigen::VectorXd& x, const RigidBodyState& state) const {
    const auto input = [&x](Input which) { return x[kNumFlightVariables + which]; };
    Controls controls{EngineThrust(x) + extra_thrust_lbf_, input(kElevatorInput),
                      input(kAileronInput), input(kRudderInput), 0};
    if (flap_ == FlapMotion::kFixed) {
      controls.leading_edge_flap_deg = input(kFlapInput);
    } else {
      const AirData air = plant_.AirAround(state, Eigen::Vector3d::Zero());
      controls.leading_edge_flap_deg =
          SteadyLeadingEdgeFlap(plant_.aircraft(), air.alpha_rad * kDegPerRad,
                                air.dynamic_pressure_psf, air.static_pressure_psf);
    }
    return controls;
  }

  static Eigen::VectorXd RatesOf(const Eigen::VectorXd& x, const RigidBodyState& state,
                                 const RigidBodyState& rate) {
    const Eigen::Vector3d velocity = state.segment<3>(kU), acceleration = rate.segment<3>(kU);
    const double speed = x[kTrueAirspeed], speed_rate = velocity.dot(acceleration) / speed;
    const double symmetric = std::hypot(velocity.x(), velocity.z());  // in the plane of symmetry
    const double sine = std::sin(x[kBankAngle]), cosine = std::cos(x[kBankAngle]);
    Eigen::VectorXd rates(static_cast<int>(kNumFlightVariables));
    rates << speed_rate,
        (velocity.x() * acceleration.z() - velocity.z() * acceleration.x()) /
            (symmetric * symmetric),
        x[kPitchRate] * cosine - x[kYawRate] * sine, rate[kQ],
        (acceleration.y() * speed - velocity.y() * speed_rate) / (speed * symmetric),
        x[kRollRate] + std::tan(x[kPitchAngle]) * (x[kPitchRate] * sine + x[kYawRate] * cosine),
        rate[kP], rate[kR], -rate[kDown];
    return rates;
  }

  const Plant& plant_;
  FlapMotion flap_;
  Eigen::VectorXd start_;
  double extra_thrust_lbf_ = 0;
};

}  // namespace

LinearFlight LineariseFlight(const Plant& plant, const TrimPoint& trim, FlapMotion flap) {
  const FlightEquations equations(plant, trim, flap);
  const auto outputs = static_cast<long>(kOutputs.size());
  const long inputs = equations.NumInputs();
  Eigen::MatrixXd jacobian(kNumFlightVariables + outputs, kNumFlightVariables + inputs);
  for (int i = 0; i < jacobian.cols(); ++i) {
    const double step = StepOf(i);
    Eigen::VectorXd ahead = equations.start(), behind = equations.start();
    ahead[i] += step;
    behind[i] -= step;
    jacobian.col(i) = (equations(ahead) - equations(behind)) / (2 * step);
  }
  LinearFlight model;
  model.states.assign(kStates.begin(), kStates.end());
  model.inputs.assign(kInputs.begin(), kInputs.begin() + inputs);
  model.outputs.assign(kOutputs.begin(), kOutputs.end());
  model.A = jacobian.topLeftCorner(kNumFlightVariables, kNumFlightVariables);
  model.B = jacobian.topRightCorner(kNumFlightVariables, inputs);
  model.C = jacobian.bottomLeftCorner(outputs, kNumFlightVariables);
  model.D = jacobian.bottomRightCorner(outputs, inputs);
  return model;
}

}  // namespace skein
