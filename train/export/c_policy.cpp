// SPDX-License-Identifier: Apache-2.0
#include "train/export/c_policy.h"

#include <algorithm>
#include <string_view>

#include "base/name_in.h"
#include "base/number_text.h"
#include "train/export/c_text.h"
#include "train/network/network_kernels.h"

namespace skein {
namespace data {
extern const std::string_view c_policy_template;
}  // namespace data

namespace {

static_assert(kLayerNormEpsilon == 1e-5f, "policy.h.in adds another number to the variance");

constexpr int kBlock = 8;  ///< rows that the header's products take at once
constexpr int kTestFlights = 2, kTestSteps = 10;

int Padded(int rows) { return (rows + kBlock - 1) / kBlock * kBlock; }

/// Rows in whole blocks, [rows / 8][columns][8].
std::vector<float> Blocked(const float* weight, int rows, int columns) {
  std::vector<float> blocked(static_cast<std::size_t>(Padded(rows)) *
                             static_cast<std::size_t>(columns));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int to = (row / kBlock * columns + column) * kBlock + row % kBlock;
      blocked[static_cast<std::size_t>(to)] = weight[row * columns + column];
    }
  }
  return blocked;
}

/// Writes the parameters, and the calls that make one policy step of them.
class Writer {
 public:
  explicit Writer(const ExportedPolicy& exported)
      : exported_(exported), layout_(exported.layout()), shape_(layout_.shape()) {
    const int hidden = shape_.hidden_layers;
    std::string from = "obs";
    for (int i = 0; i < hidden; ++i) from = Hidden(i, i + 1, from);
    AddNormalised(layout_.gru_input(), "gru_input", from);
    for (int i = 0; i < shape_.gru_layers; ++i) from = Gru(i);
    for (int i = 0; i < hidden; ++i) from = Hidden(hidden + 1 + i, hidden + i + 1, from);
    AddNormalised(layout_.head(), "head", from);
    Call("linear(" + Arrays("head") + ", " + std::to_string(Padded(shape_.output_size)) + ", " +
         std::to_string(layout_.layer(layout_.head()).in) + ", x, y)");
  }

  const std::string& parameters() const { return parameters_; }
  const std::string& calls() const { return calls_; }
  std::size_t bytes() const { return floats_ * sizeof(float); }

 private:
  std::string Named(const std::string& part) const { return exported_.name + "_" + part; }

  /// The weights and the bias of a linear layer as arguments.
  std::string Arrays(const std::string& layer) const {
    return Named(layer + "_weight") + ", " + Named(layer + "_bias");
  }

  void Call(const std::string& call) { calls_ += "  " + Named(call) + ";\n"; }

  void AddArray(const std::string& part, const std::vector<float>& values) {
    parameters_ += CArray(Named(part), values);
    floats_ += values.size();
  }

  void AddArray(const std::string& part, std::int64_t offset, int size) {
    AddArray(part, std::vector<float>(exported_.values(offset), exported_.values(offset + size)));
  }

  void AddLinear(const std::string& layer, std::int64_t weight, std::int64_t bias, int rows,
                 int columns) {
    AddArray(layer + "_weight", Blocked(exported_.values(weight), rows, columns));
    AddArray(layer + "_bias", Blocked(exported_.values(bias), rows, 1));
  }

  /// The layer's arrays, and its LayerNorm of `from` into x.
  void AddNormalised(int index, const std::string& name, const std::string& from) {
    const NormalisedLinear& layer = layout_.layer(index);
    AddArray(name + "_norm_weight", layer.norm_weight, layer.in);
    AddArray(name + "_norm_bias", layer.norm_bias, layer.in);
    AddLinear(name, layer.weight, layer.bias, layer.out, layer.in);
    Call("norm(" + Named(name + "_norm_weight") + ", " + Named(name + "_norm_bias") + ", " +
         std::to_string(layer.in) + ", " + from + ", x)");
  }

  std::string Hidden(int index, int number, const std::string& from) {
    const NormalisedLinear& layer = layout_.layer(index);
    const std::string name = "layer" + std::to_string(number), rows = std::to_string(layer.out);
    AddNormalised(index, name, from);
    Call("linear(" + Arrays(name) + ", " + std::to_string(Padded(layer.out)) + ", " +
         std::to_string(layer.in) + ", x, y)");
    Call("activate(" + rows + ", y)");
    return "y";
  }

  /// The state's part of GRU layer `index`, which it moves on.
  std::string Gru(int index) {
    const GruLayer& layer = layout_.gru_layers()[static_cast<std::size_t>(index)];
    const int gru = shape_.gru_size, rows = 3 * gru;
    const std::string number = index == 0 ? "" : std::to_string(index + 1);
    const std::string input = "gru" + number + "_input", hidden = "gru" + number + "_hidden";
    std::string state = "state + " + std::to_string(index * gru);
    const std::string sizes = std::to_string(Padded(rows)) + ", ";
    if (index > 0) AddLinear(input, layer.input_weight, layer.input_bias, rows, layer.in);
    AddLinear(hidden, layer.hidden_weight, layer.hidden_bias, rows, gru);
    const std::string from = index == 0 ? "x" : "state + " + std::to_string((index - 1) * gru);
    Call("linear(" + Arrays(input) + ", " + sizes + std::to_string(layer.in) + ", " + from +
         ", gates)");
    Call("linear(" + Arrays(hidden) + ", " + sizes + std::to_string(gru) + ", " + state +
         ", gates + " + std::to_string(Padded(rows)) + ")");
    Call("gru(gates, gates + " + std::to_string(Padded(rows)) + ", " + std::to_string(gru) + ", " +
         state + ")");
    return state;
  }

  const ExportedPolicy& exported_;
  NetworkLayout layout_;
  NetworkShape shape_;
  std::string parameters_, calls_;
  std::size_t floats_ = 0;
};

const char* ActivationOf(Activation activation) {
  switch (activation) {
    case Activation::kRelu:
      return "y[i] < 0.0f ? 0.0f : y[i]";  // what is no number shows in the actions
    case Activation::kTanh:
      return "tanhf(y[i])";
    case Activation::kElu:
      return "y[i] > 0.0f ? y[i] : expf(y[i]) - 1.0f";
    case Activation::kSilu:
      return "y[i] / (1.0f + expf(-y[i]))";
  }
  return "";
}

/// A network without hidden layers has no use for the function, which is then a warning.
std::string ActivationFunction(const ExportedPolicy& exported) {
  const NetworkShape& shape = exported.policy->shape;
  if (shape.hidden_layers == 0) return "";
  return "\nstatic void " + exported.name +
         "_activate(int size, float *y) {\n"
         "  int i;\n"
         "  for (i = 0; i < size; ++i) y[i] = " +
         ActivationOf(shape.activation) + ";\n}\n";
}

std::string NumberLines(const std::string& array, const std::vector<PolicyNumber>& numbers) {
  std::string lines;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const PolicyNumber& number = numbers[i];
    lines += "\n  " + array + "[" + std::to_string(i) + "]  " + number.name + " = ";
    lines += number.scale == 1 ? "" : RoundedText(number.scale, 7) + " ";
    lines += array + "[" + std::to_string(i) + "]";
    if (number.offset != 0) lines += " + " + RoundedText(number.offset, 7);
  }
  return lines;
}

/// What goes in and comes out, for people.
std::string InterfaceText(const ExportedPolicy& exported) {
  const PolicyInterface& interface = exported.interface;
  return "Task " + interface.env.task + ", aircraft " + interface.env.aircraft +
         ", flight control " + NameIn(kFlightControlNames, interface.env.flight_control) +
         "; an action is held for " + RoundedText(interface.policy_step_s(), 7) + " s.\n" +
         "Quantities behind the numbers, units at the ends of their names:" +
         NumberLines("obs", interface.observations) + NumberLines("actions", interface.actions);
}

/// The beginning of each of the first flights.
std::string Recording(const ExportedPolicy& exported, const PolicyTrace& trace, int flights,
                      int steps, int steps_per_flight) {
  std::vector<float> begins, observations, actions;
  const auto append = [=](const auto& rows, int size, int flight, std::vector<float>* out) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(flight) * steps_per_flight * size;
    out->insert(out->end(), begin, begin + static_cast<std::ptrdiff_t>(steps) * size);
  };
  for (int flight = 0; flight < flights; ++flight) {
    append(trace.begins, 1, flight, &begins);
    append(trace.observations, trace.observation_size, flight, &observations);
    append(trace.actions, trace.action_size, flight, &actions);
  }
  return CArray(exported.name + "_test_begins", begins) +
         CArray(exported.name + "_test_observations", observations) +
         CArray(exported.name + "_test_actions", actions);
}

}  // namespace

std::string CPolicy(const ExportedPolicy& exported, const PolicyTrace& recorded,
                    int steps_per_flight) {
  const NetworkShape& shape = exported.policy->shape;
  const int flights = std::min(kTestFlights, recorded.steps() / steps_per_flight);
  const int steps = std::min(kTestSteps, steps_per_flight);
  const int width = std::max({shape.observation_size, shape.hidden_size, shape.gru_size});
  const int padded_width = Padded(std::max(shape.hidden_size, shape.output_size));
  const int gates = 2 * Padded(3 * shape.gru_size);
  const Writer writer(exported);
  return FillIn(data::c_policy_template,
                {{"name", exported.name},
                 {"NAME", UpperCase(exported.name)},
                 {"version", exported.metadata.at("version")},
                 {"interface", CommentLines(InterfaceText(exported))},
                 {"observation_size", std::to_string(shape.observation_size)},
                 {"state_size", std::to_string(shape.state_size())},
                 {"action_size", std::to_string(shape.output_size)},
                 {"policy_step_s", CNumber(static_cast<float>(exported.interface.policy_step_s()))},
                 {"stack", std::to_string(sizeof(float) *
                                          static_cast<std::size_t>(width + padded_width + gates))},
                 {"bytes", std::to_string(writer.bytes())},
                 {"parameters", writer.parameters()},
                 {"activation", ActivationFunction(exported)},
                 {"width", std::to_string(width)},
                 {"padded_width", std::to_string(padded_width)},
                 {"padded_gates", std::to_string(gates)},
                 {"calls", writer.calls()},
                 {"mean", exported.policy->config.tanh_mean ? "tanhf(y[i])" : "y[i]"},
                 {"test_steps", std::to_string(flights * steps)},
                 {"recording", Recording(exported, recorded, flights, steps, steps_per_flight)}});
}

}  // namespace skein
