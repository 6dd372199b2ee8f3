// SPDX-License-Identifier: Apache-2.0
#include "train/export/safetensors_policy.h"

#include "train/export/named_parameters.h"
#include "train/files/tensor_access.h"

namespace skein {

std::string SafetensorsPolicy(const ExportedPolicy& exported) {
  TensorFile file;
  for (const ParameterSlice& slice : NamedParameters(exported)) {
    std::int64_t count = 1;
    for (const std::int64_t extent : slice.shape) count *= extent;
    StoreTensor(file, slice.name, slice.shape, exported.values(slice.offset),
                static_cast<std::size_t>(count));
  }
  file.metadata = exported.metadata;
  const NetworkShape& shape = exported.policy->shape;
  file.metadata["hidden_layers"] = std::to_string(shape.hidden_layers);
  file.metadata["hidden_size"] = std::to_string(shape.hidden_size);
  file.metadata["gru_layers"] = std::to_string(shape.gru_layers);
  file.metadata["gru_size"] = std::to_string(shape.gru_size);
  file.metadata["activation"] = Name(shape.activation);
  file.metadata["tanh_mean"] = exported.policy->config.tanh_mean ? "true" : "false";
  return file.Bytes();
}

}  // namespace skein
