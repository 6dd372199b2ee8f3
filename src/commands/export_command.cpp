// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "base/ends_with.h"
#include "base/name_in.h"
#include "envs/aircraft/registry.h"
#include "src/agents/agent_names.h"
#include "src/commands/aircraft_option.h"
#include "src/commands/commands.h"
#include "src/config/one_of.h"
#include "src/config/usage_error.h"
#include "src/export/policy_export.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

struct ExportOptions {
  std::string policy;
  std::string format;
  std::string flight_control;
  std::string aircraft = "f16";
  std::string out;
  std::string name;
  bool check = false;
  CLI::Option* aircraft_option = nullptr;
};

constexpr char kLetters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// What C and ONNX take as a name, and TorchScript but for Python's keywords.
CLI::Validator IsIdentifier() {
  return {[](const std::string& name) {
            const bool is_one =
                name.find_first_of(kLetters) == 0 &&
                name.find_first_not_of(std::string(kLetters) + "0123456789_") == std::string::npos;
            return is_one ? ""
                          : name + " is no name: letters, digits and underscores, a letter first";
          },
          "", "identifier"};
}

/// Of the files of each form.
constexpr std::pair<ExportForm, const char*> kEndings[] = {
    {ExportForm::kOnnx, ".onnx"},
    {ExportForm::kTorchScript, ".pt"},
    {ExportForm::kSafetensors, ".safetensors"},
    {ExportForm::kC, ".h"}};

/// The form that was asked for, or the one that the name of the file tells by its ending, but for
/// .pt, which all files of PyTorch have. Throws ChoiceError if the ending is of another format.
ExportForm ChooseForm(const ExportOptions& options) {
  if (options.format.empty()) {
    for (const auto& [form, ending] : kEndings) {
      const bool tells = form != ExportForm::kTorchScript && EndsWith(options.out, ending);
      if (tells) return form;
    }
    throw UsageError(fmt::format(
        "--format is needed: onnx, torchscript, safetensors or c; -o {} does not tell it",
        options.out));
  }
  for (const auto& [form, name] : kExportForms) {
    if (options.format != name) continue;
    RequireEnding(options.out, NameIn(kEndings, form), "--format " + options.format);
    return form;
  }
  throw UsageError("unknown format " + options.format);
}

std::vector<std::string> Export(ExportOptions options) {
  // What a policy was trained on is found by its hash among the files that are kept.
  const std::string file = IsAircraftPath(options.aircraft) ? options.aircraft : "";
  if (!file.empty()) options.aircraft = AsUsage([&] { return KeepAircraftFile(file); });
  if (!options.policy.empty() && options.aircraft_option->count() > 0 &&
      !IsKeptFile(options.aircraft)) {
    throw UsageError("--aircraft is for --flight-control without a policy, which says its own");
  }
  if (IsOtherAgent(options.policy)) {
    throw UsageError(
        fmt::format("{} is no policy: policies are exported, and by --flight-control "
                    "the flight control laws",
                    options.policy));
  }
  CheckWritable({options.out}, {options.policy, file});
  if (!options.flight_control.empty()) {
    RequireEnding(options.out, ".h", "--flight-control c");
    return ExportFlightControl(options.policy, options.aircraft, options.out, options.check);
  }
  if (options.policy.empty()) throw UsageError("a policy file or the directory of a run is needed");
  const ExportForm form = ChooseForm(options);
  if (!options.name.empty() && form == ExportForm::kSafetensors) {
    throw UsageError("--name is for c, onnx and torchscript: safetensors hold no name");
  }
  return ExportPolicy({options.policy, form, options.out, options.check, file, options.name});
}

std::vector<std::string> FormNames() {
  std::vector<std::string> names;
  for (const auto& [form, name] : kExportForms) names.emplace_back(name);
  return names;
}

}  // namespace

void AddExportCommand(CLI::App* app) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app->add_subcommand(
      "export", "Write a policy, or the flight control laws, in a format that others read");
  command
      ->add_option("policy", options->policy,
                   "policy file, checkpoint, or directory of a run (its best policy)")
      ->type_name("FILE_OR_RUN");
  CLI::Option* format =
      command
          ->add_option("--format", options->format,
                       "of the policy: an ONNX model, a TorchScript module, safetensors by "
                       "PyTorch's names, or one C99 header (default: by the name of the file, "
                       ".onnx, .safetensors or .h)")
          ->check(OneOf(FormNames()));
  CLI::Option* name = command
                          ->add_option("--name", options->name,
                                       "what functions and arrays in C begin with, and what the "
                                       "model is called (default: the policy's task)")
                          ->check(IsIdentifier())
                          ->type_name("NAME");
  command
      ->add_option("--flight-control", options->flight_control,
                   "write the flight control laws that the policy flies through, as one C99 header")
      ->check(OneOf(std::vector<std::string>{"c"}))
      ->excludes(format)
      ->excludes(name);
  options->aircraft_option =
      command
          ->add_option("--aircraft", options->aircraft,
                       AircraftHelp("for a policy trained on an aircraft file, that file; with "
                                    "--flight-control and without a policy: whose laws"))
          ->check(CompletesAircraft())
          ->type_name("NAME_OR_FILE")
          ->capture_default_str();
  command->add_option("-o,--out", options->out, "write it here")->type_name("FILE")->required();
  command->add_flag(
      "--check", options->check,
      "fly it before it is written, and fail unless it does what it was made of: C by "
      "cc, ONNX and safetensors by their libraries in python3, TorchScript by "
      "LibTorch");
  command->footer(
      "The environment variables CC and SKEIN_PYTHON name another compiler and Python for "
      "--check.\n"
      "Example: skein export policies/heading.skein --format c -o heading.h --check\n"
      "         skein export runs/short --format onnx -o short.onnx\n"
      "         skein export --flight-control c -o f16_flight_control.h");
  command->callback([options] {
    for (const std::string& line : Export(*options)) fmt::print("{}\n", line);
  });
}

}  // namespace skein
