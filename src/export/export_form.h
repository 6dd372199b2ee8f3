// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>

#include "train/export/exported_policy.h"
#include "train/export/policy_trace.h"

namespace skein {

/// What a policy is exported as.
enum class ExportForm { kOnnx, kTorchScript, kSafetensors, kC };
inline constexpr std::array<std::pair<ExportForm, const char*>, 4> kExportForms{
    {{ExportForm::kOnnx, "onnx"},
     {ExportForm::kTorchScript, "torchscript"},
     {ExportForm::kSafetensors, "safetensors"},
     {ExportForm::kC, "c"}}};

/// The exported file. `trace` begins with flights of `steps_per_flight` policy steps: a C header
/// holds the first of them as its own test. Throws Error without LibTorch's module where it is
/// needed.
std::string Encode(ExportForm form, const ExportedPolicy& exported, const PolicyTrace& trace,
                   int steps_per_flight);

/// What flies an exported file: of C a compiler, of ONNX and safetensors their libraries in Python,
/// of TorchScript LibTorch. CC and SKEIN_PYTHON name others than cc and python3.
std::string FlyerOf(ExportForm form);

/// The actions of an exported file for the observations of `trace`, flown by `flyer`. Throws Error
/// if it is not there, or complains: of C, a warning of the compiler or a failure of the header's
/// own test; of ONNX, a failure of its checker, shape inference included.
std::vector<float> Fly(ExportForm form, const std::string& bytes, const ExportedPolicy& exported,
                       const PolicyTrace& trace, const std::string& flyer);

/// The same of exported flight control laws in C, called `name`, for rows of `inputs`
/// (FlightControlTrace).
std::vector<float> FlyFlightControl(const std::string& header, const std::string& name,
                                    const std::vector<float>& inputs, const std::string& compiler);

}  // namespace skein
