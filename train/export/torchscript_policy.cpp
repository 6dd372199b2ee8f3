// SPDX-License-Identifier: Apache-2.0
#include "train/export/torchscript_policy.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "train/export/named_parameters.h"
#include "train/network/network_kernels.h"

namespace skein {
namespace {

/// Attributes of a module hold no points.
std::string Attribute(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

const char* ActivationCall(Activation activation) {
  switch (activation) {
    case Activation::kRelu:
      return "torch.relu(x)";
    case Activation::kTanh:
      return "torch.tanh(x)";
    case Activation::kElu:
      return "torch.elu(x)";
    case Activation::kSilu:
      return "x * torch.sigmoid(x)";
  }
  return "";
}

class Source {
 public:
  explicit Source(const ExportedPolicy& exported)
      : exported_(exported), layout_(exported.layout()), shape_(layout_.shape()) {}

  std::string Write() {
    text_ = "def forward(self, obs: Tensor, h: Tensor) -> Tuple[Tensor, Tensor]:\n";
    Line("x = obs");
    const int hidden = shape_.hidden_layers;
    for (int i = 0; i < hidden; ++i) Hidden(i, i + 1);
    Norm("gru", layout_.layer(layout_.gru_input()).in);
    for (int i = 0; i < shape_.gru_layers; ++i) Gru(i);
    std::string states = "h0";
    for (int i = 1; i < shape_.gru_layers; ++i) states += ", h" + std::to_string(i);
    for (int i = 0; i < hidden; ++i) Hidden(hidden + 1 + i, hidden + 1 + i);
    Linear("head", layout_.layer(layout_.head()).in);
    if (exported_.policy->config.tanh_mean) Line("x = torch.tanh(x)");
    Line("return torch.clamp(x, -1.0, 1.0), torch.cat([" + states + "], 1)");
    return text_;
  }

 private:
  void Line(const std::string& line) { text_ += "  " + line + "\n"; }

  void Norm(const std::string& layer, int size) {
    constexpr int kFloat32Digits = 7;
    const std::string of = "self." + layer + "_norm_";
    Line("x = torch.layer_norm(x, [" + std::to_string(size) + "], " + of + "weight, " + of +
         "bias, " + RoundedText(kLayerNormEpsilon, kFloat32Digits) + ")");
  }

  void Linear(const std::string& layer, int in) {
    Norm(layer, in);
    const std::string of = "self." + layer + "_linear_";
    Line("x = torch.linear(x, " + of + "weight, " + of + "bias)");
  }

  void Hidden(int index, int number) {
    Linear("layer" + std::to_string(number), layout_.layer(index).in);
    Line(std::string("x = ") + ActivationCall(shape_.activation));
  }

  void Gru(int index) {
    const std::string l = "_l" + std::to_string(index), h = "h" + std::to_string(index);
    const int gru = shape_.gru_size;
    const auto part = [gru](int i) {
      return std::to_string(i * gru) + ":" + std::to_string((i + 1) * gru);
    };
    Line("before = h[:, " + part(index) + "]");
    Line("i = torch.linear(x, self.gru_weight_ih" + l + ", self.gru_bias_ih" + l + ")");
    Line("s = torch.linear(before, self.gru_weight_hh" + l + ", self.gru_bias_hh" + l + ")");
    Line("r = torch.sigmoid(i[:, " + part(0) + "] + s[:, " + part(0) + "])");
    Line("z = torch.sigmoid(i[:, " + part(1) + "] + s[:, " + part(1) + "])");
    Line("n = torch.tanh(i[:, " + part(2) + "] + r * s[:, " + part(2) + "])");
    Line(h + " = (1.0 - z) * n + z * before");
    Line("x = " + h);
  }

  const ExportedPolicy& exported_;
  NetworkLayout layout_;
  NetworkShape shape_;
  std::string text_;
};

}  // namespace

ScriptModule TorchScriptPolicy(const ExportedPolicy& exported) {
  ScriptModule module;
  module.name = exported.name;
  for (const ParameterSlice& slice : NamedParameters(exported)) {
    module.parameters.push_back(
        {Attribute(slice.name), slice.shape, exported.values(slice.offset)});
  }
  module.source = Source(exported).Write();
  module.metadata_json = nlohmann::json(exported.metadata).dump(1);
  return module;
}

}  // namespace skein
