// SPDX-License-Identifier: Apache-2.0
#include "src/export/policy_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "src/agents/policy_file.h"
#include "src/bench/version.h"
#include "src/config/configuration.h"
#include "src/export/export_flights.h"
#include "src/export/manifest.h"
#include "src/files/output_file.h"
#include "src/run/run_directory.h"
#include "train/export/c_flight_control.h"
#include "train/export/onnx_policy.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

/// How far what is exported may lie from what it was made of, of actions in [-1, 1] and of commands
/// as fractions of the surfaces' largest.
constexpr double kMostError = 1e-5;

std::string VersionText() { return fmt::format("{} (commit {})", Build().version, Build().commit); }

/// So that what a run's policy was trained on is at hand.
void KeepAircraftOfRun(const std::string& path) {
  if (IsRunDirectory(path)) ReadRecord(path + "/config.toml");
}

/// A file to be written.
struct Output {
  std::string path, bytes;
};

void WriteAll(const std::vector<Output>& outputs) {
  for (const Output& output : outputs) WriteFile(output.path, output.bytes);
}

void RequireNear(double error, const std::string& found) {
  if (error <= kMostError) return;
  throw Error(
      fmt::format("nothing is written: the exported file does not do what it was made of: {}; "
                  "{:.0e} is allowed",
                  found, kMostError));
}

/// Flies an exported file, and says how near it came.
std::string Check(ExportForm form, const std::string& bytes, const ExportedPolicy& exported,
                  const PolicyTrace& trace) {
  const std::string flyer = FlyerOf(form);
  const double error = LargestError(trace, Fly(form, bytes, exported, trace, flyer));
  std::string found =
      fmt::format("{} policy steps of task {} in {} flights, by {}: actions within {:.1e}",
                  trace.steps(), exported.interface.env.task, kExportFlights, flyer, error);
  RequireNear(error, found);
  return found;
}

std::string WithExtension(const std::string& path, const std::string& extension) {
  return std::filesystem::path(path).replace_extension(extension).string();
}

/// One policy: what is written of it, and what of that is said.
struct Exported {
  ExportedPolicy policy;
  Output output;
  std::string checked;
};

/// Names what an earlier export of a hierarchy has left beside `outputs`: it would pass for theirs,
/// and removing it is up to whose it is.
std::vector<std::string> LeftByEarlier(const std::vector<Output>& outputs,
                                       const HierarchyFiles& files, const std::string& manifest) {
  std::vector<std::string> lines;
  for (const std::string& path : {files.low_level, files.combined, manifest}) {
    std::error_code failure;
    const bool is_there = path == manifest ? IsManifest(path) : fs::exists(path, failure);
    const bool is_written = std::any_of(outputs.begin(), outputs.end(),
                                        [&](const Output& output) { return output.path == path; });
    if (!is_there || is_written) continue;
    lines.push_back(
        fmt::format("untouched {} (of another export by its name; not of this policy)", path));
  }
  return lines;
}

Exported ExportOne(const PolicyExport& options, const RecurrentPolicy& policy,
                   const std::string& run, const std::string& who, const std::string& out,
                   const std::string& suffix = "") {
  Exported one{PrepareExport(policy, who, VersionText(), TermTaskOf(policy, who)), {out, ""}, ""};
  if (!options.name.empty()) one.policy.name = options.name + suffix;
  const PolicyTrace trace = RecordExportFlights(run, policy, one.policy.interface.env);
  one.output.bytes = Encode(options.form, one.policy, trace, kExportSteps);
  if (options.check) one.checked = Check(options.form, one.output.bytes, one.policy, trace);
  return one;
}

}  // namespace

std::vector<std::string> ExportPolicy(const PolicyExport& options) {
  KeepAircraftOfRun(options.policy);
  const std::string path = PolicyFileOf(options.policy);
  const RecurrentPolicy policy = RecurrentPolicy::Load(path);
  const auto low_level = std::dynamic_pointer_cast<const RecurrentPolicy>(policy.low_level());
  const std::string extension = std::filesystem::path(options.out).extension().string();
  const std::string low_level_out = WithExtension(options.out, ".low_level" + extension);
  const std::string combined_out = WithExtension(options.out, ".combined" + extension);
  const std::string manifest_out = WithExtension(options.out, ".json");
  std::vector<std::string> paths = {options.out};
  if (low_level != nullptr) paths.insert(paths.end(), {low_level_out, combined_out});
  if (policy.low_level() != nullptr) paths.push_back(manifest_out);
  std::vector<std::string> read = FilesOfPolicy(options.policy);
  read.push_back(options.aircraft_file);
  CheckWritable(paths, read);

  std::vector<Exported> parts = {ExportOne(options, policy, options.policy, path, options.out)};
  if (low_level != nullptr) {
    // A run of the high-level policy says nothing of flights of the Control task.
    parts.push_back(ExportOne(options, *low_level, path, path + "'s low-level policy",
                              low_level_out, "_low_level"));
  }
  std::vector<Output> outputs;
  std::vector<std::string> lines;
  const bool is_one_graph = options.form == ExportForm::kOnnx && parts.size() == 2 &&
                            FitInOneGraph(parts[0].policy, parts[1].policy);
  if (is_one_graph) {
    outputs.push_back({combined_out, OnnxHierarchy(parts[0].policy, parts[1].policy)});
    lines.push_back(fmt::format("wrote     {} (both in one graph{})", combined_out,
                                options.check ? "; --check flies each of them, not this" : ""));
  }
  for (const Exported& part : parts) {
    outputs.push_back(part.output);
    lines.push_back(
        fmt::format("wrote     {} (task {})", part.output.path, part.policy.interface.env.task));
    if (options.check) lines.push_back("checked   " + part.checked);
  }
  if (policy.low_level() != nullptr) {
    const HierarchyFiles files{options.out, low_level_out, is_one_graph ? combined_out : ""};
    outputs.push_back(
        {manifest_out, Manifest(options.form, parts.front().policy, *policy.low_level(), files)});
    lines.push_back(fmt::format("wrote     {} (how they act together)", manifest_out));
    if (low_level == nullptr) {
      lines.push_back(
          "left out  the autopilot that flies below it: no form has its laws "
          "(docs/reference/autopilot.md)");
    }
  }
  WriteAll(outputs);
  const std::vector<std::string> left =
      LeftByEarlier(outputs, {options.out, low_level_out, combined_out}, manifest_out);
  lines.insert(lines.end(), left.begin(), left.end());
  return lines;
}

std::vector<std::string> ExportFlightControl(const std::string& policy, const std::string& aircraft,
                                             const std::string& out, bool check) {
  CheckWritable({out}, FilesOfPolicy(policy));
  KeepAircraftOfRun(policy);
  EnvConfig env;
  env.aircraft = aircraft;
  if (!policy.empty()) {
    const std::string path = PolicyFileOf(policy);
    const RecurrentPolicy loaded = RecurrentPolicy::Load(path);
    env = PrepareExport(loaded, path, VersionText(), TermTaskOf(loaded, path)).interface.env;
  }
  env = ExportEnvironment(policy, env);
  const FlightControlTrace trace = RecordFlightControl(env, kExportFlights, kFlightControlSteps, 1);
  const std::string header = CFlightControl(env, trace, VersionText());
  std::vector<std::string> lines = {fmt::format("wrote     {} (flight control of {}, every {} s)",
                                                out, env.aircraft, env.control_interval_s)};
  if (check) {
    const std::string compiler = FlyerOf(ExportForm::kC);
    const double error =
        LargestError(trace, LoadAircraft(env.aircraft).actuators,
                     FlyFlightControl(header, FlightControlName(env), trace.inputs, compiler));
    const std::string found =
        fmt::format("{} control steps in {} flights, by {}: commands within {:.1e} of their range",
                    trace.steps(), kExportFlights, compiler, error);
    RequireNear(error, found);
    lines.push_back("checked   " + found);
  }
  WriteFile(out, header);
  return lines;
}

}  // namespace skein
