// SPDX-License-Identifier: Apache-2.0
#include "train/export/onnx_model.h"

#include <cctype>
#include <cstring>

#include "train/files/protobuf.h"

namespace skein {
namespace {

using protobuf::Integer;
using protobuf::Message;

// Enumerators and fields of onnx.proto (https://onnx.ai/onnx/repo-docs/IR.html).
constexpr int kFloatTensor = 1, kInt64Tensor = 7;      // TensorProto.DataType
constexpr int kFloatAttribute = 1, kIntAttribute = 2;  // AttributeProto.AttributeType
constexpr int kIrVersion = 8, kOpset = 17;             // what ONNX 1.12 reads

/// ValueInfoProto of a float32 tensor.
std::string ValueInfo(const std::string& name, const std::vector<OnnxModel::Extent>& shape) {
  std::string dimensions;
  for (const OnnxModel::Extent& extent : shape) {
    const bool is_number = std::isdigit(static_cast<unsigned char>(extent.front())) != 0;
    dimensions += Message(1, is_number ? Integer(1, std::stoull(extent)) : Message(2, extent));
  }
  const std::string tensor_type = Integer(1, kFloatTensor) + Message(2, dimensions);
  return Message(1, name) + Message(2, Message(1, tensor_type));
}

/// TensorProto.
std::string Tensor(const std::string& name, const std::vector<std::int64_t>& shape, int type,
                   const std::string& bytes) {
  std::string tensor;
  for (const std::int64_t extent : shape) tensor += Integer(1, static_cast<std::uint64_t>(extent));
  return tensor + Integer(2, static_cast<std::uint64_t>(type)) + Message(8, name) +
         Message(9, bytes);
}

/// The numbers' own bytes: Skein runs on little-endian machines alone.
template <typename Value>
std::string BytesOf(const Value* values, std::size_t count) {
  std::string bytes(count * sizeof(Value), '\0');
  if (count > 0) std::memcpy(bytes.data(), values, bytes.size());
  return bytes;
}

}  // namespace

void OnnxModel::AddInput(const std::string& name, const std::vector<Extent>& shape) {
  inputs_ += Message(11, ValueInfo(name, shape));
}

void OnnxModel::AddOutput(const std::string& name, const std::vector<Extent>& shape) {
  outputs_ += Message(12, ValueInfo(name, shape));
}

void OnnxModel::AddConstant(const std::string& name, const std::vector<std::int64_t>& shape,
                            const float* values) {
  std::size_t count = 1;
  for (const std::int64_t extent : shape) count *= static_cast<std::size_t>(extent);
  constants_ += Message(5, Tensor(name, shape, kFloatTensor, BytesOf(values, count)));
}

void OnnxModel::AddConstant(const std::string& name, const std::vector<std::int64_t>& values) {
  const std::vector<std::int64_t> shape = {static_cast<std::int64_t>(values.size())};
  constants_ +=
      Message(5, Tensor(name, shape, kInt64Tensor, BytesOf(values.data(), values.size())));
}

std::string OnnxModel::Attribute(const std::string& name, std::int64_t value) {
  return Message(1, name) + Integer(3, static_cast<std::uint64_t>(value)) +
         Integer(20, kIntAttribute);
}

std::string OnnxModel::Attribute(const std::string& name, float value) {
  return Message(1, name) + protobuf::Float(2, value) + Integer(20, kFloatAttribute);
}

void OnnxModel::AddNode(const std::string& op, const std::vector<std::string>& inputs,
                        const std::vector<std::string>& outputs,
                        const std::vector<std::string>& attributes) {
  std::string node;
  for (const std::string& input : inputs) node += Message(1, input);
  for (const std::string& output : outputs) node += Message(2, output);
  node += Message(3, op + " " + outputs.back()) + Message(4, op);
  for (const std::string& attribute : attributes) node += Message(5, attribute);
  nodes_ += Message(1, node);
}

std::string OnnxModel::Bytes(const std::string& name, const std::string& producer_version,
                             const std::string& description,
                             const std::map<std::string, std::string>& metadata) const {
  std::string model = Integer(1, kIrVersion) + Message(2, "skein") + Message(3, producer_version) +
                      Message(6, description);
  model += Message(7, nodes_ + Message(2, name) + constants_ + inputs_ + outputs_);
  model += Message(8, Integer(2, kOpset));
  for (const auto& [key, value] : metadata) {
    model += Message(14, Message(1, key) + Message(2, value));
  }
  return model;
}

}  // namespace skein
