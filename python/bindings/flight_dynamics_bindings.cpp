// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/string.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/reference/linearise.h"
#include "envs/reference/plant.h"
#include "envs/reference/trim.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"
#include "python/bindings/bindings.h"
#include "src/config/usage_error.h"
#include "src/fdm/trim_limits.h"

namespace nb = nanobind;

namespace skein {
namespace {

constexpr std::size_t kNumControls = 5;

template <typename Numbers>
nb::object ToNumpyVector(const Numbers& numbers) {
  return nb::cast(ToNumpy(std::vector<double>(numbers.data(), numbers.data() + numbers.size()),
                          {static_cast<std::size_t>(numbers.size())}));
}

template <typename Matrix>
nb::object ToNumpyMatrix(const Matrix& matrix) {
  std::vector<double> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) rows.push_back(matrix(i, k));
  }
  return nb::cast(ToNumpy(std::move(rows), {static_cast<std::size_t>(matrix.rows()),
                                            static_cast<std::size_t>(matrix.cols())}));
}

AtmosphereModel AtmosphereNamed(const std::string& name) {
  for (const auto& [model, known] : kAtmosphereNames) {
    if (name == known) return model;
  }
  throw UsageError("atmosphere \"" + name + "\": stevens_lewis and standard_1976 are known");
}

RigidBodyState StateIn(const Row<const double>& numbers) {
  if (numbers.size() != kNumRigidBody) {
    throw Error("a state has " + std::to_string(kNumRigidBody) + " numbers, not " +
                std::to_string(numbers.size()));
  }
  return Eigen::Map<const RigidBodyState>(numbers.data());
}

Controls ControlsAt(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]};
}

Controls ControlsIn(const Row<const double>& numbers) {
  if (numbers.size() != kNumControls) {
    throw Error("controls are " + std::to_string(kNumControls) + " numbers, not " +
                std::to_string(numbers.size()));
  }
  return ControlsAt(numbers.data());
}

Plant MakePlant(const std::string& aircraft_name, const std::string& atmosphere, double cg,
                double engine_angular_momentum) {
  return AsUsage([&] {
    Aircraft aircraft = LoadAircraft(aircraft_name);
    aircraft.airframe.cg = cg;
    aircraft.airframe.engine_angular_momentum = engine_angular_momentum;
    return Plant(std::move(aircraft), AtmosphereNamed(atmosphere));
  });
}

nb::dict TrimOf(const Plant& plant, double altitude_ft, double true_airspeed_fps,
                double flight_path_deg, double turn_rate_deg_s) {
  TrimRequest request;
  request.altitude_ft = altitude_ft;
  request.true_airspeed_ft_s = true_airspeed_fps;
  request.flight_path_angle_rad = flight_path_deg / kDegPerRad;
  request.turn_rate_rad_s = turn_rate_deg_s / kDegPerRad;
  const TrimPoint trim = TrimOrExplain(plant, request);
  nb::list limits;
  for (const std::string& limit : ExceededLimits(plant, request, trim)) limits.append(limit);
  const Controls& controls = trim.controls;
  nb::dict point;
  point["state"] = ToNumpyVector(trim.state);
  point["controls"] = ToNumpyVector(std::vector<double>{controls.thrust_lbf, controls.elevator_deg,
                                                        controls.aileron_deg, controls.rudder_deg,
                                                        controls.leading_edge_flap_deg});
  point["power"] = trim.power;
  point["alpha_deg"] = trim.alpha_rad * kDegPerRad;
  point["bank_deg"] = trim.bank_rad * kDegPerRad;
  point["pitch_deg"] = trim.pitch_rad * kDegPerRad;
  point["residual"] = trim.residual;
  point["exceeded_limits"] = nb::tuple(limits);
  return point;
}

nb::tuple LineariseAt(const Plant& plant, const Row<const double>& state,
                      const Row<const double>& controls) {
  const LinearModel model = Linearise(plant, StateIn(state), ControlsIn(controls));
  return nb::make_tuple(ToNumpyMatrix(model.A), ToNumpyMatrix(model.B));
}

/// The initial state and that after every step, of which row k of `controls` is held during the
/// k-th.
nb::object Simulate(const Plant& plant, const Row<const double>& initial_state,
                    const Rows<const double>& controls, double dt) {
  if (controls.shape(1) != kNumControls) {
    throw Error("controls have " + std::to_string(kNumControls) + " columns, not " +
                std::to_string(controls.shape(1)));
  }
  if (!(dt > 0)) throw Error("the time step must be above 0");
  const std::size_t steps = controls.shape(0);
  RigidBodyState state = StateIn(initial_state);
  std::vector<double> states(state.data(), state.data() + kNumRigidBody);
  {
    const nb::gil_scoped_release released;
    for (std::size_t k = 0; k < steps; ++k) {
      state = plant.StepRk4(state, ControlsAt(controls.data() + k * kNumControls), dt);
      states.insert(states.end(), state.data(), state.data() + kNumRigidBody);
    }
  }
  return nb::cast(ToNumpy(std::move(states), {steps + 1, std::size_t{kNumRigidBody}}));
}

}  // namespace

void BindFlightDynamics(nb::module_& module) {
  nb::class_<Plant>(module, "Plant")
      .def("trim", &TrimOf, nb::arg("altitude_ft"), nb::arg("true_airspeed_fps"),
           nb::arg("flight_path_deg"), nb::arg("turn_rate_deg_s"))
      .def("linearise", &LineariseAt, nb::arg("state"), nb::arg("controls"))
      .def("simulate", &Simulate, nb::arg("initial_state"), nb::arg("controls"), nb::arg("dt"));
  module.def("make_plant", &MakePlant, nb::arg("aircraft"), nb::arg("atmosphere"), nb::arg("cg"),
             nb::arg("engine_angular_momentum"));
}

}  // namespace skein
