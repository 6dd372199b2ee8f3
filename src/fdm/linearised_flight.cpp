// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/linearised_flight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "base/number_text.h"
#include "envs/tuning/trial_flight.h"
#include "src/fdm/flight_grid.h"
#include "src/files/json_number.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kNameWidth = 24;
constexpr double kFastestShown = 60;  // 1/s: filters and actuators beyond it are nobody's motion

const char* NameOf(LoopAxis axis) {
  return axis == LoopAxis::kLongitudinal ? "longitudinal" : "lateral";
}

std::vector<ModelVariable> StatesOf(const LinearLoop& loop) {
  std::vector<ModelVariable> states;
  for (const int column : loop.model.columns) states.push_back(ClosedLoopVariable(column));
  return states;
}

/// The states that a mode is mostly of: those with a fifth of it and more, the largest first.
std::string MostlyOf(const LinearMode& mode, const std::vector<ModelVariable>& states) {
  constexpr double kMuch = 0.2;
  std::vector<std::size_t> order(mode.shares.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return mode.shares[a] > mode.shares[b]; });
  std::string text = states[order.front()].name;
  for (std::size_t i = 1; i < order.size() && mode.shares[order[i]] >= kMuch; ++i) {
    text += std::string(", ") + states[order[i]].name;
  }
  return text;
}

std::string Figure(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "-";
}

std::string EigenvalueText(const LinearMode& mode) {
  const double real = mode.eigenvalue.real(), imaginary = mode.eigenvalue.imag();
  return mode.is_oscillatory() ? fmt::format("{:.4f}+-{:.4f}i", real, imaginary)
                               : fmt::format("{:.4f}", real);
}

/// "half 0.58 s", below "time to".
std::string DecayText(const LinearMode& mode) {
  if (std::isfinite(mode.time_to_double_s())) {
    return fmt::format("double {:.3g} s", mode.time_to_double_s());
  }
  return std::isfinite(mode.time_to_half_s()) ? fmt::format("half {:.3g} s", mode.time_to_half_s())
                                              : "neutral";
}

std::vector<std::string> ModeRow(const std::string& name, const LinearMode& mode,
                                 const std::vector<ModelVariable>& states) {
  return {name,
          EigenvalueText(mode),
          mode.is_oscillatory() ? fmt::format("{:.4g}", mode.frequency_rad_s()) : "-",
          mode.is_oscillatory() ? fmt::format("{:.3f}", mode.damping_ratio()) : "-",
          mode.is_oscillatory() ? "-" : Figure(mode.time_constant_s()),
          DecayText(mode),
          MostlyOf(mode, states)};
}

std::vector<std::string> ModeHead() {
  return {"", "eigenvalue 1/s", "rad/s", "damping", "time constant, s", "time to", "mostly"};
}

/// Of a column: its name or a number, and a gap.
std::size_t WidthOf(const ModelVariable& column) {
  constexpr std::size_t kNumber = 10, kGap = 2;
  return kGap + std::max(std::string(column.name).size(), kNumber);
}

/// Columns at the right of as much room as they need; what is rounding beside the rest is 0.
std::string DescribeMatrix(const std::string& name, const Eigen::MatrixXd& matrix,
                           const std::vector<ModelVariable>& rows,
                           const std::vector<ModelVariable>& columns) {
  constexpr double kRounding = 1e-12;
  const double least = kRounding * matrix.cwiseAbs().maxCoeff();
  std::string text = fmt::format("{:{}}", name, kNameWidth);
  for (const ModelVariable& column : columns) {
    text += fmt::format("{:>{}}", column.name, WidthOf(column));
  }
  for (long i = 0; i < matrix.rows(); ++i) {
    text += fmt::format("\n  {:{}}", rows[static_cast<std::size_t>(i)].name, kNameWidth - 2);
    for (long k = 0; k < matrix.cols(); ++k) {
      const double value = std::abs(matrix(i, k)) > least ? matrix(i, k) : 0;
      text += fmt::format("{:>{}.4g}", value, WidthOf(columns[static_cast<std::size_t>(k)]));
    }
  }
  return text + "\n";
}

std::string DescribeLoop(const LinearLoop& loop) {
  std::vector<std::vector<std::string>> rows = {ModeHead()};
  const std::vector<ModelVariable> states = StatesOf(loop);
  std::size_t faster = 0;
  for (const LinearMode& mode : loop.modes) {
    if (mode.frequency_rad_s() > kFastestShown) {
      ++faster;
    } else {
      rows.push_back(ModeRow("", mode, states));
    }
  }
  std::string text = fmt::format("\nwith flight control, {}, {} control steps a second\n",
                                 NameOf(loop.axis), std::lround(1 / loop.model.dt));
  text += InColumns(rows);
  if (faster > 0) text += fmt::format("and {} faster than {} rad/s\n", faster, kFastestShown);
  return text;
}

Json ToJson(const std::vector<ModelVariable>& quantities) {
  Json json = Json::array();
  for (const ModelVariable& quantity : quantities) {
    json.push_back({{"name", quantity.name}, {"unit", quantity.unit}});
  }
  return json;
}

Json ToJson(const Eigen::MatrixXd& matrix) {
  Json json = Json::array();
  for (long i = 0; i < matrix.rows(); ++i) {
    const Eigen::VectorXd row = matrix.row(i);
    json.push_back(std::vector<double>(row.data(), row.data() + row.size()));
  }
  return json;
}

Json ToJson(const LinearMode& mode, const std::vector<ModelVariable>& states) {
  Json json = {{"eigenvalue_per_s", {mode.eigenvalue.real(), mode.eigenvalue.imag()}},
               {"swings", mode.is_oscillatory()},
               {"frequency_rad_s", mode.frequency_rad_s()},
               {"damping_ratio", mode.damping_ratio()},
               {"time_constant_s", NumberOrNull(mode.time_constant_s())},
               {"time_to_half_s", NumberOrNull(mode.time_to_half_s())},
               {"time_to_double_s", NumberOrNull(mode.time_to_double_s())}};
  for (std::size_t i = 0; i < mode.shares.size(); ++i)
    json["shares"][states[i].name] = mode.shares[i];
  return json;
}

Json ToJson(const LinearLoop& loop) {
  const std::vector<ModelVariable> inputs = ClosedLoopInputs(loop.axis), states = StatesOf(loop);
  const Eigen::MatrixXd D = Eigen::MatrixXd::Zero(loop.outputs.C.rows(), loop.model.B.cols());
  Json json = {{"dt_s", loop.model.dt},       {"states", ToJson(states)},
               {"inputs", ToJson(inputs)},    {"outputs", ToJson(loop.outputs.outputs)},
               {"A", ToJson(loop.model.A)},   {"B", ToJson(loop.model.B)},
               {"C", ToJson(loop.outputs.C)}, {"D", ToJson(D)},
               {"modes", Json::array()}};
  for (const LinearMode& mode : loop.modes) json["modes"].push_back(ToJson(mode, states));
  return json;
}

}  // namespace

LinearisedFlight LineariseSteadyFlight(const Plant& plant, const SteadyFlightRequest& request,
                                       FlapMotion flap) {
  LinearisedFlight linearised{request, FindSteadyFlight(plant, request), {}, {}, {}};
  const TrimPoint& trim = linearised.flight.trim;
  linearised.bare = LineariseFlight(plant, trim, flap);
  linearised.modes = FindFlightModes(linearised.bare);
  if (!request.IsStraight()) return linearised;
  for (const LoopAxis axis : {LoopAxis::kLongitudinal, LoopAxis::kLateral}) {
    LinearLoop loop;
    loop.axis = axis;
    loop.model = LineariseClosedLoop(plant, trim, axis, kTrialInterval, false);
    loop.outputs = LineariseOutputs(plant, trim, axis, loop.model);
    loop.modes = loop.model.ModesWithShares();
    linearised.loops.push_back(std::move(loop));
  }
  return linearised;
}

std::string Describe(const LinearisedFlight& linearised) {
  const LinearFlight& bare = linearised.bare;
  std::string text = "bare airframe: x' = A x + B u, y = C x + D u\n";
  text += DescribeMatrix("A", bare.A, bare.states, bare.states);
  text += DescribeMatrix("B", bare.B, bare.states, bare.inputs);
  text += DescribeMatrix("C", bare.C, bare.outputs, bare.states);
  text += DescribeMatrix("D", bare.D, bare.outputs, bare.inputs);
  std::vector<std::vector<std::string>> rows = {ModeHead()};
  for (const FlightMode& mode : linearised.modes) {
    rows.push_back(ModeRow(mode.name, mode, bare.states));
  }
  text += "\nbare airframe, altitude and power held\n" + InColumns(rows);
  for (const LinearLoop& loop : linearised.loops) text += DescribeLoop(loop);
  if (linearised.loops.empty()) {
    text +=
        "\nmodels with flight control are of flight with level wings, without a pull-up: there are "
        "none\n";
  }
  return text;
}

std::string DescribeModes(const std::vector<LinearisedFlight>& flights) {
  std::vector<std::vector<std::string>> rows = {{"altitude, ft", "speed, ft/s", "modes, 1/s"}};
  for (const LinearisedFlight& linearised : flights) {
    std::string modes;
    for (const FlightMode& mode : linearised.modes) {
      modes += fmt::format("{}{} {}", modes.empty() ? "" : "; ", mode.name, EigenvalueText(mode));
    }
    rows.push_back({ShortestText(linearised.request.altitude_ft),
                    fmt::format("{:.6g}", linearised.request.true_airspeed_ft_s), modes});
  }
  return InColumns(rows);
}

Json ToJson(const LinearisedFlight& linearised) {
  const LinearFlight& bare = linearised.bare;
  Json json = {{"altitude_ft", linearised.request.altitude_ft},
               {"speed_fps", linearised.request.true_airspeed_ft_s},
               {"trim", ToJson(linearised.flight)}};
  Json& airframe = json["bare_airframe"];
  airframe = {{"states", ToJson(bare.states)},
              {"inputs", ToJson(bare.inputs)},
              {"outputs", ToJson(bare.outputs)},
              {"A", ToJson(bare.A)},
              {"B", ToJson(bare.B)},
              {"C", ToJson(bare.C)},
              {"D", ToJson(bare.D)},
              {"modes", Json::array()}};
  const std::vector<ModelVariable> states(bare.states.begin(), bare.states.begin() + kAltitude);
  for (const FlightMode& mode : linearised.modes) {
    Json entry = {{"name", mode.name}};
    entry.update(ToJson(mode, states));
    airframe["modes"].push_back(entry);
  }
  for (const LinearLoop& loop : linearised.loops) {
    json["with_flight_control"][NameOf(loop.axis)] = ToJson(loop);
  }
  return json;
}

}  // namespace skein
