// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "envs/reference/linearise.h"
#include "envs/reference/plant.h"
#include "envs/state/state.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interpreter_lock.h"
#include "src/config/usage_error.h"
#include "src/fdm/fdm_plant.h"
#include "src/fdm/flight_grid.h"
#include "src/fdm/flying_qualities_report.h"
#include "src/fdm/linearised_flight.h"
#include "src/fdm/steady_flight.h"

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

RigidBodyState StateIn(const Row<const double>& numbers) {
  if (numbers.size() != kNumRigidBody) {
    throw Error("a state has " + std::to_string(kNumRigidBody) + " numbers, not " +
                std::to_string(numbers.size()));
  }
  return Eigen::Map<const RigidBodyState>(numbers.data());
}

Controls ControlsIn(const Row<const double>& numbers) {
  if (numbers.size() != kNumControls) {
    throw Error("controls are " + std::to_string(kNumControls) + " numbers, not " +
                std::to_string(numbers.size()));
  }
  return ToControls(numbers.data());
}

nb::dict TrimOf(const Plant& plant, const SteadyFlightRequest& request) {
  const SteadyFlight flight = FindSteadyFlight(plant, request);
  nb::dict point;
  point["state"] = ToNumpyVector(flight.trim.state);
  point["controls"] = ToNumpyVector(ToNumbers(flight.trim.controls));
  point["power"] = flight.trim.power;
  point["throttle"] = flight.throttle;
  point["available_thrust_lbf"] = flight.available_thrust_lbf;
  point["excess_power_fps"] = flight.excess_power_ft_s;
  for (const auto& [name, number] : flight.Numbers()) point[name] = number;
  nb::list limits;
  for (const std::string& limit : WordsOf(flight.exceeded_limits)) limits.append(limit);
  point["exceeded_limits"] = nb::tuple(limits);
  return point;
}

/// The points of a grid as JSON, altitude by altitude.
std::string TrimGridOf(const Plant& plant, const Row<const double>& altitude_ft,
                       const Row<const double>& true_airspeed_fps,
                       const SteadyFlightRequest& manoeuvre) {
  const auto numbers = [](const Row<const double>& row) {
    return std::vector<double>(row.data(), row.data() + row.size());
  };
  const FlightGrid grid{manoeuvre, numbers(altitude_ft), numbers(true_airspeed_fps)};
  const InterpreterUnlocked unlocked;
  const FlownGrid flown(plant, grid);
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const GridPoint& point : flown.points()) points.push_back(ToJson(point));
  return points.dump();
}

std::string LinearModelsOf(const Plant& plant, const SteadyFlightRequest& request,
                           bool flap_is_scheduled) {
  const InterpreterUnlocked unlocked;
  return ToJson(
             LineariseSteadyFlight(plant, request,
                                   flap_is_scheduled ? FlapMotion::kScheduled : FlapMotion::kFixed))
      .dump();
}

std::string FlyingQualitiesOf(const Plant& plant, const SteadyFlightRequest& request,
                              const std::string& airplane_class, const std::string& category) {
  const InterpreterUnlocked unlocked;
  return ToJson(AssessSteadyFlight(plant, request, LimitsNamed(airplane_class, category))).dump();
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
    const InterpreterUnlocked unlocked;
    for (std::size_t k = 0; k < steps; ++k) {
      state = plant.StepRk4(state, ToControls(controls.data() + k * kNumControls), dt);
      if (!state.allFinite()) {
        throw Error("simulate: the state is not finite after step " + std::to_string(k + 1) +
                    " of " + std::to_string(steps));
      }
      states.insert(states.end(), state.data(), state.data() + kNumRigidBody);
    }
  }
  return nb::cast(ToNumpy(std::move(states), {steps + 1, std::size_t{kNumRigidBody}}));
}

}  // namespace

void BindFlightDynamics(nb::module_& module) {
  nb::class_<SteadyFlightRequest>(module, "FlightRequest")
      .def(
          "__init__",
          [](SteadyFlightRequest* request, double altitude_ft, double true_airspeed_fps,
             double flight_path_deg, double turn_rate_deg_s, std::optional<double> pull_up_g) {
            new (request) SteadyFlightRequest{altitude_ft, true_airspeed_fps, flight_path_deg,
                                              turn_rate_deg_s, pull_up_g};
          },
          nb::arg("altitude_ft"), nb::arg("true_airspeed_fps"), nb::arg("flight_path_deg"),
          nb::arg("turn_rate_deg_s"), nb::arg("pull_up_g").none());
  nb::class_<Plant>(module, "Plant")
      .def("trim", &TrimOf, nb::arg("request"))
      .def("trim_grid", &TrimGridOf, nb::arg("altitude_ft"), nb::arg("true_airspeed_fps"),
           nb::arg("manoeuvre"))
      .def("linear_models", &LinearModelsOf, nb::arg("request"), nb::arg("flap_is_scheduled"))
      .def("flying_qualities", &FlyingQualitiesOf, nb::arg("request"), nb::arg("airplane_class"),
           nb::arg("category"))
      .def("linearise", &LineariseAt, nb::arg("state"), nb::arg("controls"))
      .def("simulate", &Simulate, nb::arg("initial_state"), nb::arg("controls"), nb::arg("dt"));
  module.def(
      "make_plant",
      [](const std::string& aircraft, const std::string& atmosphere, double gravity_ft_s2,
         bool gravity_falls_with_altitude, std::optional<double> cg, double engine_angular_momentum,
         bool drag_rise, bool thrust_growth) {
        return AsUsage([&] {
          return MakePlant(aircraft, AtmosphereNamed(atmosphere),
                           {gravity_ft_s2, gravity_falls_with_altitude},
                           {cg, engine_angular_momentum, drag_rise, thrust_growth});
        });
      },
      nb::arg("aircraft"), nb::arg("atmosphere"), nb::arg("gravity_ft_s2"),
      nb::arg("gravity_falls_with_altitude"), nb::arg("cg").none(),
      nb::arg("engine_angular_momentum"), nb::arg("drag_rise"), nb::arg("thrust_growth"));
}

}  // namespace skein
