// SPDX-License-Identifier: Apache-2.0
#include "train/export/onnx_policy.h"

#include <utility>

#include "envs/aircraft/registry.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task_errors.h"
#include "train/export/onnx_model.h"
#include "train/network/network_kernels.h"

namespace skein {
namespace {

constexpr const char* kBatch = "batch";
constexpr const char* kLowestAction = "lowest_action";
constexpr const char* kHighestAction = "highest_action";
constexpr const char* kAxis0 = "axis_0";
constexpr const char* kDescription =
    "Recurrent policy: feed h_out back as h_in; zeros when an episode begins";
/// The attribute of operators along the columns of rows [batch][columns].
std::string Columns() { return OnnxModel::Attribute("axis", std::int64_t{1}); }

constexpr int kSinPitch = 6;  ///< of the observations (envs/tasks/observation.h)
constexpr double kVerticalRad = 1.5707963267948966;

/// Rows of a GRU's gates, reset, update, new, in ONNX's order: update, reset, new.
void AppendGates(const float* rows, std::int64_t gate_size, std::vector<float>* out) {
  for (const int gate : {1, 0, 2}) {
    out->insert(out->end(), rows + gate * gate_size, rows + (gate + 1) * gate_size);
  }
}

/// A network's part of a model; names of its values begin with `prefix`.
class Network {
 public:
  Network(const ExportedPolicy& exported, std::string prefix, OnnxModel* model)
      : exported_(exported),
        layout_(exported.layout()),
        shape_(layout_.shape()),
        prefix_(std::move(prefix)),
        model_(*model) {}

  /// Adds it behind the observations `x` and the states of its GRU layers. Its actions, clipped,
  /// are called `actions`; returns the states behind the step.
  std::vector<std::string> Add(std::string x, const std::vector<std::string>& states,
                               const std::string& actions) {
    const int hidden = shape_.hidden_layers;
    for (int i = 0; i < hidden; ++i) x = Hidden(i, i + 1, x);
    x = Norm(layout_.layer(layout_.gru_input()), "gru", x);
    std::vector<std::string> fresh;
    for (std::size_t i = 0; i < states.size(); ++i) {
      x = Gru(layout_.gru_layers()[i], "gru" + std::to_string(i + 1), x, states[i]);
      fresh.push_back(x);
    }
    for (int i = 0; i < hidden; ++i) x = Hidden(hidden + 1 + i, hidden + 1 + i, x);
    x = Linear(layout_.layer(layout_.head()), "head", x);
    if (exported_.policy->config.tanh_mean) x = Node("Tanh", {x}, "mean");
    model_.AddNode("Clip", {x, kLowestAction, kHighestAction}, {actions});
    return fresh;
  }

 private:
  std::string Constant(const std::string& name, const std::vector<std::int64_t>& shape,
                       std::int64_t offset) {
    model_.AddConstant(prefix_ + name, shape, exported_.values(offset));
    return prefix_ + name;
  }

  std::string Node(const std::string& op, const std::vector<std::string>& inputs,
                   const std::string& output, const std::vector<std::string>& attributes = {}) {
    model_.AddNode(op, inputs, {prefix_ + output}, attributes);
    return prefix_ + output;
  }

  std::string Norm(const NormalisedLinear& layer, const std::string& name, const std::string& x) {
    return Node("LayerNormalization",
                {x, Constant(name + ".norm.weight", {layer.in}, layer.norm_weight),
                 Constant(name + ".norm.bias", {layer.in}, layer.norm_bias)},
                name + ".norm",
                {OnnxModel::Attribute("axis", std::int64_t{-1}),
                 OnnxModel::Attribute("epsilon", kLayerNormEpsilon)});
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

  /// The state behind one step of the layer, [batch, gru_size].
  std::string Gru(const GruLayer& layer, const std::string& name, const std::string& x,
                  const std::string& state) {
    const std::int64_t gru = shape_.gru_size;
    std::vector<float> input, hidden, bias;
    AppendGates(exported_.values(layer.input_weight), gru * layer.in, &input);
    AppendGates(exported_.values(layer.hidden_weight), gru * gru, &hidden);
    AppendGates(exported_.values(layer.input_bias), gru, &bias);
    AppendGates(exported_.values(layer.hidden_bias), gru, &bias);
    const std::string at = prefix_ + name;
    model_.AddConstant(at + ".W", {1, 3 * gru, layer.in}, input.data());
    model_.AddConstant(at + ".R", {1, 3 * gru, gru}, hidden.data());
    model_.AddConstant(at + ".B", {1, 6 * gru}, bias.data());
    // One step of a sequence; the state of one direction.
    const std::string step = Node("Unsqueeze", {x, kAxis0}, name + ".step");
    const std::string before = Node("Unsqueeze", {state, kAxis0}, name + ".before");
    model_.AddNode("GRU", {step, at + ".W", at + ".R", at + ".B", "", before}, {"", at + ".after"},
                   {OnnxModel::Attribute("hidden_size", gru),
                    OnnxModel::Attribute("linear_before_reset", std::int64_t{1})});
    return Node("Squeeze", {at + ".after", kAxis0}, name + ".state");
  }

  const ExportedPolicy& exported_;
  NetworkLayout layout_;
  NetworkShape shape_;
  std::string prefix_;
  OnnxModel& model_;
};

/// Inputs, outputs and constants of every model; `policies` are what acts in it, one after the
/// other.
void Begin(const std::vector<const ExportedPolicy*>& policies, OnnxModel* model) {
  int states = 0;
  for (const ExportedPolicy* policy : policies) states += policy->policy->shape.state_size();
  const std::string state = std::to_string(states);
  model->AddInput("obs",
                  {kBatch, std::to_string(policies.front()->policy->shape.observation_size)});
  model->AddInput("h_in", {kBatch, state});
  model->AddOutput("actions", {kBatch, std::to_string(policies.back()->policy->shape.output_size)});
  model->AddOutput("h_out", {kBatch, state});
  const float low = -1, high = 1;
  model->AddConstant(kLowestAction, {}, &low);
  model->AddConstant(kHighestAction, {}, &high);
  model->AddConstant(kAxis0, {0});
}

/// The parts of h_in, one for each GRU layer of each policy.
std::vector<std::vector<std::string>> SplitStates(
    const std::vector<const ExportedPolicy*>& policies, OnnxModel* model) {
  std::vector<std::vector<std::string>> states;
  std::vector<std::string> all;
  std::vector<std::int64_t> sizes;
  for (const ExportedPolicy* policy : policies) {
    std::vector<std::string>& own = states.emplace_back();
    for (int i = 0; i < policy->policy->shape.gru_layers; ++i) {
      own.push_back("h_in." + std::to_string(all.size() + 1));
      all.push_back(own.back());
      sizes.push_back(policy->policy->shape.gru_size);
    }
  }
  model->AddConstant("state_sizes", sizes);
  model->AddNode("Split", {"h_in", "state_sizes"}, all, {Columns()});
  return states;
}

/// What a low-level policy observes right after its high-level policy has acted: the changes asked
/// for are then its errors, of a pitch that stays within the vertical.
void AddLowLevelObservation(const HighLevelConfig& changes, double speed_unit, OnnxModel* model) {
  const auto constant = [model](const char* name, double value) {
    const auto number = static_cast<float>(value);
    model->AddConstant(name, {}, &number);
  };
  constant("vertical_down", -kVerticalRad);
  constant("vertical_up", kVerticalRad);
  constant("pitch_unit", changes.pitch_change_rad);
  constant("yaw_unit", changes.yaw_change_rad);
  constant("speed_unit", changes.speed_change_fps / speed_unit);
  model->AddConstant("one_each", {1, 1, 1});
  model->AddConstant("parts", {kSinPitch, 1, kObservationSize - kSinPitch - 1});
  model->AddConstant("after_errors", {kNumTaskErrors});
  model->AddConstant("observations", {kObservationSize});
  model->AddConstant("axis_1", {1});
  model->AddNode("Split", {"high.actions", "one_each"},
                 {"pitch.action", "yaw.action", "speed.action"}, {Columns()});
  model->AddNode("Split", {"obs", "parts"}, {"before.pitch", "sin_pitch", "behind.pitch"},
                 {Columns()});
  model->AddNode("Clip", {"sin_pitch", kLowestAction, kHighestAction}, {"sin_pitch.clipped"});
  model->AddNode("Asin", {"sin_pitch.clipped"}, {"pitch"});
  model->AddNode("Mul", {"pitch.action", "pitch_unit"}, {"pitch.change"});
  model->AddNode("Add", {"pitch", "pitch.change"}, {"pitch.asked"});
  model->AddNode("Clip", {"pitch.asked", "vertical_down", "vertical_up"}, {"pitch.target"});
  model->AddNode("Sub", {"pitch.target", "pitch"}, {"pitch.error"});
  model->AddNode("Mul", {"yaw.action", "yaw_unit"}, {"yaw.error"});
  model->AddNode("Mul", {"speed.action", "speed_unit"}, {"speed.error"});
  model->AddNode("Slice", {"obs", "after_errors", "observations", "axis_1"}, {"sensed"});
  model->AddNode("Concat", {"pitch.error", "yaw.error", "speed.error", "sensed"}, {"low.obs"},
                 {Columns()});
}

}  // namespace

std::string OnnxPolicy(const ExportedPolicy& exported) {
  OnnxModel model;
  Begin({&exported}, &model);
  const auto states = SplitStates({&exported}, &model);
  const auto fresh = Network(exported, "", &model).Add("obs", states[0], "actions");
  model.AddNode("Concat", fresh, {"h_out"}, {Columns()});
  return model.Bytes(exported.name, exported.metadata.at("version"), kDescription,
                     exported.metadata);
}

bool FitInOneGraph(const ExportedPolicy& high_level, const ExportedPolicy& low_level) {
  return high_level.interface.action_repeat <= low_level.interface.action_repeat &&
         !high_level.interface.env.high_level.averages_observations;
}

std::string OnnxHierarchy(const ExportedPolicy& high_level, const ExportedPolicy& low_level) {
  OnnxModel model;
  const std::vector<const ExportedPolicy*> policies = {&high_level, &low_level};
  Begin(policies, &model);
  const auto states = SplitStates(policies, &model);
  auto fresh = Network(high_level, "high.", &model).Add("obs", states[0], "high.actions");
  const EnvConfig& env = high_level.interface.env;
  AddLowLevelObservation(env.high_level, LoadAircraft(env.aircraft).units.speed_ft_s, &model);
  const auto below = Network(low_level, "low.", &model).Add("low.obs", states[1], "actions");
  fresh.insert(fresh.end(), below.begin(), below.end());
  model.AddNode("Concat", fresh, {"h_out"}, {Columns()});
  std::map<std::string, std::string> metadata = high_level.metadata;
  for (const char* key : {"action_names", "action_scales", "action_offsets"}) {
    metadata[key] = low_level.metadata.at(key);
  }
  return model.Bytes(high_level.name, metadata.at("version"), kDescription, metadata);
}

}  // namespace skein
