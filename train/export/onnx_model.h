// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace skein {

/// Writes one ONNX model (the messages of onnx.proto, IR version 8, opset 17) piece by piece.
/// Tensors are float32 or int64; values are named by what makes them.
class OnnxModel {
 public:
  /// An extent of a shape: a number, or a name for one that is free.
  using Extent = std::string;

  void AddInput(const std::string& name, const std::vector<Extent>& shape);
  void AddOutput(const std::string& name, const std::vector<Extent>& shape);
  /// Constants of the model; `count` is that of the shape. Row-major.
  void AddConstant(const std::string& name, const std::vector<std::int64_t>& shape,
                   const float* values);
  void AddConstant(const std::string& name, const std::vector<std::int64_t>& values);

  /// An attribute of a node: name and encoded message.
  static std::string Attribute(const std::string& name, std::int64_t value);
  static std::string Attribute(const std::string& name, float value);

  /// One operator. An empty input is one left out.
  void AddNode(const std::string& op, const std::vector<std::string>& inputs,
               const std::vector<std::string>& outputs,
               const std::vector<std::string>& attributes = {});

  /// The file. `name` is the graph's.
  std::string Bytes(const std::string& name, const std::string& producer_version,
                    const std::string& description,
                    const std::map<std::string, std::string>& metadata) const;

 private:
  std::string nodes_, constants_, inputs_, outputs_;
};

}  // namespace skein
