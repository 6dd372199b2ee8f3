// SPDX-License-Identifier: Apache-2.0
#include "train/export/onnx_policy.h"

#include "train/export/onnx_model.h"

namespace skein {
namespace {

constexpr float kNormEpsilon = 1e-5f;
constexpr const char* kBatch = "batch";

/// Rows of a GRU's gates, reset, update, new, in ONNX's order: update, reset, new.
void AppendGates(const float* rows, std::int64_t gate_size, std::vector<float>* out) {
  for (const int gate : {1, 0, 2}) {
    out->insert(out->end(), rows + gate * gate_size, rows + (gate + 1) * gate_size);
  }
}

class Builder {
 public:
  explicit Builder(const ExportedPolicy& exported)
      : exported_(exported), layout_(exported.layout()), shape_(layout_.shape()) {}

  std::string Build() {
    const std::string states = std::to_string(shape_.state_size());
    model_.AddInput("obs", {kBatch, std::to_string(shape_.observation_size)});
    model_.AddInput("h_in", {kBatch, states});
    model_.AddOutput("actions", {kBatch, std::to_string(shape_.output_size)});
    model_.AddOutput("h_out", {kBatch, states});
    model_.AddConstant("axis_0", {0});
    const int hidden = shape_.hidden_layers;
    std::string x = "obs";
    for (int i = 0; i < hidden; ++i) x = Hidden(i, i + 1, x);
    x = Norm(layout_.layer(layout_.gru_input()), "gru", x);
    x = GruLayers(x);
    for (int i = 0; i < hidden; ++i) x = Hidden(hidden + 1 + i, hidden + 1 + i, x);
    Actions(Linear(layout_.layer(layout_.head()), "head", x));
    return model_.Bytes(exported_.name, exported_.metadata.at("version"),
                        "Recurrent policy: feed h_out back as h_in; zeros when an episode begins",
                        exported_.metadata);
  }

 private:
  std::string Constant(const std::string& name, const std::vector<std::int64_t>& shape,
                       std::int64_t offset) {
    model_.AddConstant(name, shape, exported_.values(offset));
    return name;
  }

  std::string Node(const std::string& op, const std::vector<std::string>& inputs,
                   const std::string& output, const std::vector<std::string>& attributes = {}) {
    model_.AddNode(op, inputs, {output}, attributes);
    return output;
  }

  std::string Norm(const NormalisedLinear& layer, const std::string& name, const std::string& x) {
    return Node("LayerNormalization",
                {x, Constant(name + ".norm.weight", {layer.in}, layer.norm_weight),
                 Constant(name + ".norm.bias", {layer.in}, layer.norm_bias)},
                name + ".norm",
                {OnnxModel::Attribute("axis", std::int64_t{-1}),
                 OnnxModel::Attribute("epsilon", kNormEpsilon)});
  }

  std::string Linear(const NormalisedLinear& layer, const std::string& name, const std::string& x) {
    return Node(
        "Gemm",
        {Norm(layer, name, x), Constant(name + ".weight", {layer.out, layer.in}, layer.weight),
         Constant(name + ".bias", {layer.out}, layer.bias)},
        name + ".linear", {OnnxModel::Attribute("transB", std::int64_t{1})});
  }

  std::string Activated(const std::string& name, const std::string& x) {
    switch (shape_.activation) {
      case Activation::kRelu:
        return Node("Relu", {x}, name);
      case Activation::kTanh:
        return Node("Tanh", {x}, name);
      case Activation::kElu:
        return Node("Elu", {x}, name);
      case Activation::kSilu:
        return Node("Mul", {x, Node("Sigmoid", {x}, name + ".sigmoid")}, name);
    }
    return x;
  }

  std::string Hidden(int index, int number, const std::string& x) {
    const std::string name = "layer" + std::to_string(number);
    return Activated(name, Linear(layout_.layer(index), name, x));
  }

  /// The parts of h_in, one for each GRU layer.
  std::vector<std::string> States() {
    if (shape_.gru_layers == 1) return {"h_in"};
    std::vector<std::string> parts;
    for (int i = 1; i <= shape_.gru_layers; ++i) parts.push_back("h_in" + std::to_string(i));
    model_.AddConstant("state_sizes", std::vector<std::int64_t>(parts.size(), shape_.gru_size));
    model_.AddNode("Split", {"h_in", "state_sizes"}, parts,
                   {OnnxModel::Attribute("axis", std::int64_t{1})});
    return parts;
  }

  std::string GruLayers(std::string x) {
    const std::vector<std::string> states = States();
    std::vector<std::string> fresh;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const std::string name = states.size() == 1 ? "h_out" : "h_out" + std::to_string(i + 1);
      x = Gru(layout_.gru_layers()[i], "gru" + std::to_string(i + 1), x, states[i], name);
      fresh.push_back(x);
    }
    if (fresh.size() > 1) {
      Node("Concat", fresh, "h_out", {OnnxModel::Attribute("axis", std::int64_t{1})});
    }
    return x;
  }

  /// The state behind one step of the layer, `output`, [batch, gru_size].
  std::string Gru(const GruLayer& layer, const std::string& name, const std::string& x,
                  const std::string& state, const std::string& output) {
    const std::int64_t gru = shape_.gru_size;
    std::vector<float> input, hidden, bias;
    AppendGates(exported_.values(layer.input_weight), gru * layer.in, &input);
    AppendGates(exported_.values(layer.hidden_weight), gru * gru, &hidden);
    AppendGates(exported_.values(layer.input_bias), gru, &bias);
    AppendGates(exported_.values(layer.hidden_bias), gru, &bias);
    model_.AddConstant(name + ".W", {1, 3 * gru, layer.in}, input.data());
    model_.AddConstant(name + ".R", {1, 3 * gru, gru}, hidden.data());
    model_.AddConstant(name + ".B", {1, 6 * gru}, bias.data());
    // One step of a sequence; the state of one direction.
    const std::string step = Node("Unsqueeze", {x, "axis_0"}, name + ".step");
    const std::string before = Node("Unsqueeze", {state, "axis_0"}, name + ".before");
    model_.AddNode("GRU", {step, name + ".W", name + ".R", name + ".B", "", before},
                   {"", name + ".after"},
                   {OnnxModel::Attribute("hidden_size", gru),
                    OnnxModel::Attribute("linear_before_reset", std::int64_t{1})});
    return Node("Squeeze", {name + ".after", "axis_0"}, output);
  }

  void Actions(const std::string& head) {
    const float low = -1, high = 1;
    model_.AddConstant("lowest_action", {}, &low);
    model_.AddConstant("highest_action", {}, &high);
    const bool is_tanh = exported_.policy->config.tanh_mean;
    const std::string mean = is_tanh ? Node("Tanh", {head}, "mean") : head;
    Node("Clip", {mean, "lowest_action", "highest_action"}, "actions");
  }

  const ExportedPolicy& exported_;
  NetworkLayout layout_;
  NetworkShape shape_;
  OnnxModel model_;
};

}  // namespace

std::string OnnxPolicy(const ExportedPolicy& exported) { return Builder(exported).Build(); }

}  // namespace skein
