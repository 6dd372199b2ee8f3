// SPDX-License-Identifier: Apache-2.0
#include "src/export/export_form.h"

#include <cstdlib>
#include <cstring>
#include <string_view>

#include "base/error.h"
#include "base/name_in.h"
#include "src/files/output_file.h"
#include "src/files/scratch_folder.h"
#include "src/files/shell_text.h"
#include "train/export/c_policy.h"
#include "train/export/c_text.h"
#include "train/export/onnx_policy.h"
#include "train/export/safetensors_policy.h"
#include "train/export/torchscript_policy.h"
#include "train/network/backend_module.h"

namespace skein {
namespace data {
extern const std::string_view fly_policy_c, fly_flight_control_c, fly_policy_py;
}  // namespace data

namespace {

constexpr const char* kStrictC = " -std=c99 -O2 -Wall -Wextra -Wpedantic -Werror ";
constexpr const char* kCannotFly = "nothing is written: the exported file cannot be flown";

std::string FromEnvironment(const char* variable, const char* usual) {
  const char* const named = std::getenv(variable);
  return named == nullptr || *named == '\0' ? usual : named;
}

std::string BytesOf(const std::vector<float>& numbers) {
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::vector<float> NumbersOf(const std::string& bytes) {
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(float));
  return numbers;
}

/// Rows of [1 where an episode begins, observations].
std::vector<float> RowsOf(const PolicyTrace& trace) {
  std::vector<float> rows;
  for (int step = 0; step < trace.steps(); ++step) {
    rows.push_back(trace.begins[static_cast<std::size_t>(step)]);
    const auto begin =
        trace.observations.begin() + static_cast<std::ptrdiff_t>(step) * trace.observation_size;
    rows.insert(rows.end(), begin, begin + trace.observation_size);
  }
  return rows;
}

/// What `program`, a line of the shell, answers to rows.
std::vector<float> Answers(const std::string& program, const std::vector<float>& rows,
                           const ScratchFolder& folder) {
  WriteFile(folder / "rows", BytesOf(rows));
  RunShell(program + " <" + SingleQuoted(folder / "rows") + " >" + SingleQuoted(folder / "answers"),
           folder, kCannotFly);
  return NumbersOf(ReadFile(folder / "answers"));
}

/// By a program that `compiler` makes of `header` and of `main`, which includes it by `include`.
std::vector<float> FlyC(const std::string& header, const std::string& include,
                        std::string_view main, const std::string& name,
                        const std::vector<float>& rows, const std::string& compiler) {
  const ScratchFolder folder;
  WriteFile(folder / include, header);
  WriteFile(folder / "fly.c", FillIn(main, {{"name", name}, {"NAME", UpperCase(name)}}));
  const std::string program = SingleQuoted(folder / "fly");
  RunShell(compiler + kStrictC + SingleQuoted(folder / "fly.c") + " -o " + program + " -lm", folder,
           "nothing is written: " + compiler + " cannot compile the exported header");
  return Answers(program, rows, folder);
}

std::vector<float> FlyInPython(const std::string& bytes, const std::string& form,
                               const std::vector<float>& rows, const std::string& python) {
  const ScratchFolder folder;
  WriteFile(folder / "policy", bytes);
  WriteFile(folder / "fly.py", std::string(data::fly_policy_py));
  return Answers(python + " " + SingleQuoted(folder / "fly.py") + " " + form + " " +
                     SingleQuoted(folder / "policy"),
                 rows, folder);
}

}  // namespace

std::string Encode(ExportForm form, const ExportedPolicy& exported, const PolicyTrace& trace,
                   int steps_per_flight) {
  switch (form) {
    case ExportForm::kOnnx:
      return OnnxPolicy(exported);
    case ExportForm::kTorchScript:
      return LoadBackendModule().SaveScript(TorchScriptPolicy(exported));
    case ExportForm::kSafetensors:
      return SafetensorsPolicy(exported);
    case ExportForm::kC:
      return CPolicy(exported, trace, steps_per_flight);
  }
  throw Error("an export format without a name");
}

std::string FlyerOf(ExportForm form) {
  if (form == ExportForm::kTorchScript) return "LibTorch";
  return form == ExportForm::kC ? FromEnvironment("CC", "cc")
                                : FromEnvironment("SKEIN_PYTHON", "python3");
}

std::vector<float> Fly(ExportForm form, const std::string& bytes, const ExportedPolicy& exported,
                       const PolicyTrace& trace, const std::string& flyer) {
  if (form == ExportForm::kC) {
    return FlyC(bytes, "policy.h", data::fly_policy_c, exported.name, RowsOf(trace), flyer);
  }
  if (form == ExportForm::kTorchScript && flyer == FlyerOf(form)) {
    return LoadBackendModule().FlyScript(
        bytes, {trace.observation_size, exported.policy->shape.state_size(), trace.observations,
                trace.begins});
  }
  return FlyInPython(bytes, NameIn(kExportForms, form), RowsOf(trace), flyer);
}

std::vector<float> FlyFlightControl(const std::string& header, const std::string& name,
                                    const std::vector<float>& inputs, const std::string& compiler) {
  return FlyC(header, "flight_control.h", data::fly_flight_control_c, name, inputs, compiler);
}

}  // namespace skein
