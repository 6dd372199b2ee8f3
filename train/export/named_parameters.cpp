// SPDX-License-Identifier: Apache-2.0
#include "train/export/named_parameters.h"

namespace skein {
namespace {

struct LayerName {
  std::string layer, part;  ///< "layer1", "norm.weight"
};

LayerName Split(const std::string& name) {
  const std::size_t point = name.find('.');
  if (point == std::string::npos) return {name, ""};
  return {name.substr(0, point), name.substr(point + 1)};
}

/// Of "gru_input", "gru2_hidden" and the like the number of the layer, from 0, as text.
std::string GruNumber(const std::string& layer) {
  const std::string digits = layer.substr(3, layer.find('_') - 3);
  return digits.empty() ? "0" : std::to_string(std::stoi(digits) - 1);
}

std::string TorchName(const std::string& name) {
  const LayerName parts = Split(name);
  const bool is_norm = parts.part.rfind("norm.", 0) == 0;
  if (parts.part.empty()) return name;
  if (parts.layer.rfind("gru", 0) == 0) {
    if (is_norm) return "gru_" + parts.part;
    const bool is_input = parts.layer.find("_input") != std::string::npos;
    return "gru." + parts.part + (is_input ? "_ih_l" : "_hh_l") + GruNumber(parts.layer);
  }
  return parts.layer + (is_norm ? "." : ".linear.") + parts.part;
}

}  // namespace

std::vector<ParameterSlice> NamedParameters(const ExportedPolicy& exported) {
  std::vector<ParameterSlice> named = exported.layout().slices();
  for (ParameterSlice& slice : named) slice.name = TorchName(slice.name);
  return named;
}

}  // namespace skein
