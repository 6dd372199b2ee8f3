// SPDX-License-Identifier: Apache-2.0
#include "train/libtorch/libtorch_script.h"

#include <c10/core/InferenceMode.h>
#include <torch/csrc/jit/api/module.h>
#include <torch/csrc/jit/serialization/import.h>
#include <torch/types.h>

#include <sstream>

#include "train/libtorch/libtorch_threads.h"

namespace skein {

std::string SaveLibTorchScript(const ScriptModule& module) {
  torch::jit::Module script(module.name);
  for (const ScriptParameter& parameter : module.parameters) {
    const torch::Tensor values =
        torch::from_blob(const_cast<float*>(parameter.values), parameter.shape, torch::kFloat32);
    script.register_parameter(parameter.name, values.clone(), false);
  }
  script.define(module.source);
  std::ostringstream file;
  script.save(file, {{"metadata.json", module.metadata_json}});
  return file.str();
}

std::vector<float> FlyLibTorchScript(const std::string& bytes, const ScriptFlights& flights) {
  UseOneLibTorchThread();
  const c10::InferenceMode no_autograd;
  std::istringstream file(bytes);
  torch::jit::Module script = torch::jit::load(file);
  torch::Tensor state;
  std::vector<float> actions;
  for (std::size_t step = 0; step < flights.begins.size(); ++step) {
    if (flights.begins[step] > 0) state = torch::zeros({1, flights.state_size});
    const std::size_t row = step * static_cast<std::size_t>(flights.observation_size);
    const torch::Tensor observation =
        torch::from_blob(const_cast<float*>(flights.observations.data() + row),
                         {1, flights.observation_size}, torch::kFloat32);
    const auto outputs = script.forward({observation, state}).toTuple();
    const torch::Tensor action = outputs->elements()[0].toTensor().contiguous();
    state = outputs->elements()[1].toTensor();
    actions.insert(actions.end(), action.data_ptr<float>(),
                   action.data_ptr<float>() + action.numel());
  }
  return actions;
}

}  // namespace skein
