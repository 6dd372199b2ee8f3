// SPDX-License-Identifier: Apache-2.0
#include "src/run/hyperparameters.h"

#include <toml++/toml.h>

#include <sstream>

#include "train/files/protobuf.h"

namespace skein {
namespace {

using protobuf::Double;
using protobuf::Integer;
using protobuf::LittleEndian;
using protobuf::Message;

// Field numbers of Summary, Summary.Value, SummaryMetadata (with its PluginData), TensorProto (with
// its shape), and of the HParams plugin's HParamsPluginData, SessionStartInfo and map entries.
enum SummaryField { kValue = 1 };
enum ValueField { kTag = 1, kTensor = 8, kMetadata = 9 };
enum MetadataField { kPluginData = 1 };
enum PluginDataField { kPluginName = 1, kContent = 2 };
enum TensorField { kType = 1, kShape = 2, kFloatValue = 5, kStringValue = 8 };
enum ShapeField { kDimension = 2 };
enum DimensionField { kSize = 1 };
enum HParamsField { kSessionStartInfo = 3 };
enum SessionStartField { kHParams = 1, kGroupName = 4, kStartTime = 5 };
enum MapField { kMapKey = 1, kMapValue = 2 };
/// google.protobuf.Value.
enum AnyField { kNumber = 2, kText = 3, kBool = 4 };
constexpr std::uint64_t kTypeFloat = 1, kTypeString = 7;

std::string SummaryValue(const std::string& tag, const std::string& plugin,
                         const std::string& content, const std::string& tensor) {
  const std::string data = Message(kPluginName, plugin) + Message(kContent, content);
  return Message(kValue, Message(kTag, tag) + Message(kTensor, tensor) +
                             Message(kMetadata, Message(kPluginData, data)));
}

/// Markdown of the text as it is.
std::string CodeBlock(const std::string& text) {
  std::string block;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) block += "    " + line + "\n";
  return block;
}

std::string Encode(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return Integer(kBool, flag->get() ? 1 : 0);
  if (const auto number = node.value<double>()) return Double(kNumber, *number);
  return Message(kText, node.value_or(std::string()));
}

/// An entry of the map for every key of the table, "env.wind.speed_min_fps".
void AppendEntries(const toml::table& table, const std::string& prefix, std::string* session) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (const toml::table* const inner = node.as_table()) {
      AppendEntries(*inner, key + ".", session);
    } else {
      *session += Message(kHParams, Message(kMapKey, key) + Message(kMapValue, Encode(node)));
    }
  }
}

}  // namespace

std::string EncodeHyperparameters(const std::string& toml, const std::string& name,
                                  double unix_time_s) {
  std::string session;
  AppendEntries(toml::parse(toml), "", &session);
  session += Message(kGroupName, name) + Double(kStartTime, unix_time_s);
  const std::string text =
      Integer(kType, kTypeString) + Message(kShape, "") + Message(kStringValue, CodeBlock(toml));
  // The plugin wants a tensor, and reads its metadata alone.
  const std::string zero = Integer(kType, kTypeFloat) +
                           Message(kShape, Message(kDimension, Integer(kSize, 1))) +
                           Message(kFloatValue, LittleEndian(0.0f));
  return SummaryValue("configuration", "text", "", text) +
         SummaryValue("_hparams_/session_start_info", "hparams",
                      Message(kSessionStartInfo, session), zero);
}

}  // namespace skein
