// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// A parameter of a ScriptModule, row-major. `values` lives with who makes it.
struct ScriptParameter {
  std::string name;
  std::vector<std::int64_t> shape;
  const float* values = nullptr;
};

/// What a TorchScript module is made of.
struct ScriptModule {
  std::string name;
  std::vector<ScriptParameter> parameters;
  std::string source;         ///< TorchScript of `forward`, which reads self.NAME
  std::string metadata_json;  ///< goes along as the extra file "metadata.json"
};

/// Flights of a policy, one after the other.
struct ScriptFlights {
  int observation_size = 0, state_size = 0;
  std::vector<float> observations;  ///< row-major [steps][observation_size]
  std::vector<float> begins;        ///< [steps], 1 where an episode begins: the state is zeroed
};

}  // namespace skein
