// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "src/bench/machine.h"
#include "src/commands/commands.h"
#include "src/commands/fdm_commands.h"
#include "src/commands/flight_condition.h"
#include "src/config/one_of.h"
#include "src/fdm/fdm_evaluation.h"
#include "src/fdm/fdm_file.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

const std::map<std::string, FdmPrecision> kPrecisions = {{"float64", FdmPrecision::kFloat64},
                                                         {"float32", FdmPrecision::kFloat32}};
struct FileOptions {
  std::string in, out;
  ModelOptions model;
  std::string precision = "float64";

  FdmModel Model() const {
    return {model.aircraft, AtmosphereNamed(model.atmosphere), model.gravity,
            kPrecisions.at(precision)};
  }
};

template <std::size_t kCount>
void CheckFinite(const std::array<double, kCount>& numbers, const std::string& where) {
  if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) {
    throw Error(where + ": the equations of motion give a value that is not finite");
  }
}

void WritePoints(const FileOptions& options, const char* name, const std::vector<FdmPoint>& points,
                 Json* document) {
  if (!document->contains(name)) return;
  const auto results = EvaluatePoints(points, options.Model());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const FdmPointResult& result = results[i];
    const std::string where = fmt::format("{}: {}[{}]", options.in, name, i);
    CheckFinite(result.state_rate, where);
    CheckFinite(result.coefficients, where);
    CheckFinite(std::array<double, 4>{result.alpha_deg, result.beta_deg, result.mach,
                                      result.dynamic_pressure_psf},
                where);
    Json& point = (*document)[name][i];
    point["alpha_deg"] = result.alpha_deg;
    point["beta_deg"] = result.beta_deg;
    point["mach"] = result.mach;
    point["qbar_psf"] = result.dynamic_pressure_psf;
    point["coeffs"] = result.coefficients;
    point["xdot"] = result.state_rate;
  }
}

void WriteTrajectories(const FileOptions& options, const FdmFile& file, Json* document) {
  // The control interval, and a step small enough to show the integration error of the first.
  constexpr double kControlInterval = 0.02, kFineStep = 0.001;
  for (std::size_t i = 0; i < file.trajectories.size(); ++i) {
    const std::string where = fmt::format("{}: trajectories[{}]", options.in, i);
    const auto fly = [&](double dt) {
      try {
        return FlyTrajectory(file.trajectories[i], dt, options.Model());
      } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", where, error.what()));
      }
    };
    const auto states = fly(kControlInterval), fine = fly(kFineStep);
    FdmState difference{};
    for (std::size_t k = 0; k < states.size(); ++k) {
      CheckFinite(states[k], fmt::format("{} at row {}", where, k));
      CheckFinite(fine[k], fmt::format("{} at row {}", where, k));
      for (std::size_t c = 0; c < difference.size(); ++c) {
        difference[c] = std::max(difference[c], std::abs(states[k][c] - fine[k][c]));
      }
    }
    Json& trajectory = (*document)["trajectories"][i];
    trajectory["states_dt0_02"] = states;
    trajectory["states_dt0_001"] = fine;
    trajectory["max_abs_difference_between_the_two"] = difference;
  }
}

void WriteDocument(const FileOptions& options, Json document) {
  document["precision"] = options.precision;
  document["program"] = ProgramJson();
  WriteJson(options.out, document);
}

void CheckOutput(const FileOptions& options) {
  std::vector<std::string> read = options.model.FilesRead();
  read.push_back(options.in);
  CheckWritable({options.out}, read);
  RequireEnding(options.out, ".json", "results are written as JSON");
}

void Evaluate(const FileOptions& options) {
  CheckOutput(options);
  FdmFile file = ReadFdmFile(options.in);
  Json document = std::move(file.document);
  WritePoints(options, "points", file.points, &document);
  WritePoints(options, "edge_points", file.edge_points, &document);
  WriteTrajectories(options, file, &document);
  WriteDocument(options, std::move(document));
  fmt::print("evaluated {} points and {} edge points, flew {} trajectories in {}: {}\n",
             file.points.size(), file.edge_points.size(), file.trajectories.size(),
             options.precision, options.out);
}

void Simulate(const FileOptions& options) {
  CheckOutput(options);
  FdmFile file = ReadFdmFile(options.in);
  if (!file.document.contains("trajectories")) {
    throw Error(options.in + ": trajectories is missing; `skein fdm simulate` flies nothing else");
  }
  Json document = std::move(file.document);
  // Not evaluated by this command, so they would only be the input's own figures.
  document.erase("points");
  document.erase("edge_points");
  WriteTrajectories(options, file, &document);
  WriteDocument(options, std::move(document));
  fmt::print("flew {} trajectories in {}: {}\n", file.trajectories.size(), options.precision,
             options.out);
}

void AddFileCommand(CLI::App* fdm, const std::string& name, const std::string& description,
                    const std::string& footer, void (*run)(const FileOptions&)) {
  auto options = std::make_shared<FileOptions>();
  CLI::App* command = fdm->add_subcommand(name, description);
  command->add_option("--in", options->in, "JSON file to read (schema: docs/reference/commands.md)")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->out, "JSON file to write, same structure")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--precision", options->precision,
                   "float64: the scalar plant; float32: the SIMD kernel (SKEIN_SIMD chooses its "
                   "instruction set)")
      ->check(OneOf(kPrecisions))
      ->capture_default_str();
  AddModel(command, &options->model);
  command->footer(footer);
  command->callback([options, run] { run(*options); });
}

}  // namespace

void AddFdmCommand(CLI::App* app) {
  CLI::App* fdm = app->add_subcommand("fdm", "Ask the flight dynamics model directly");
  fdm->require_subcommand(1);
  AddTrimCommand(fdm);
  AddLineariseCommand(fdm);
  AddSweepCommand(fdm);
  AddFlyCommand(fdm);
  AddFileCommand(
      fdm, "eval", "Evaluate the equations of motion at the points of a file",
      "Writes coeffs, xdot and air data of every entry of points and edge_points, and flies the\n"
      "trajectories if there are any. Results found in the input are ignored.\n"
      "Example: skein fdm eval --in tests/data/golden.json --out result.json",
      Evaluate);
  AddFileCommand(
      fdm, "simulate", "Fly the trajectories of a file, open loop",
      "Classic RK4 with steps of 0.02 s and 0.001 s; controls are trim_controls plus the pulses\n"
      "active at the start of a step. States are written at the times of each trajectory's t.\n"
      "Example: skein fdm simulate --in tests/data/golden.json --out flown.json",
      Simulate);
}

}  // namespace skein
