// SPDX-License-Identifier: Apache-2.0
#include "train/policy/low_level_file.h"

#include "base/error.h"
#include "train/files/legacy_names.h"
#include "train/files/tensor_access.h"
#include "train/policy/autopilot_policy.h"
#include "train/policy/policy_parameters.h"
#include "train/policy/recurrent_policy.h"

namespace skein {
namespace {

constexpr const char* kMetadataPrefix = "low_level.";
constexpr const char* kTensorPrefix = "low_level/";

TensorFile FileOf(const StoredPolicy& policy) {
  TensorFile file;
  policy.Store(file);
  return file;
}

bool IsSame(const NamedTensor& a, const NamedTensor& b) {
  return a.type == b.type && a.shape == b.shape && a.bytes == b.bytes;
}

}  // namespace

void StoreLowLevelPolicy(const StoredPolicy& low_level, TensorFile& file) {
  const TensorFile part = FileOf(low_level);
  if (!ExtractPrefix(part.metadata, kMetadataPrefix).empty()) {
    throw Error("a low-level policy must fly itself, not command a low-level policy of its own");
  }
  InsertWithPrefix(part.metadata, kMetadataPrefix, file.metadata);
  InsertWithPrefix(part.tensors, kTensorPrefix, file.tensors);
}

std::shared_ptr<const StoredPolicy> LoadLowLevelPolicy(TensorFile file, const std::string& path) {
  TakeCurrentNames(file);
  TensorFile part;
  part.metadata = ExtractPrefix(file.metadata, kMetadataPrefix);
  if (part.metadata.empty()) return nullptr;
  part.tensors = ExtractPrefix(file.tensors, kTensorPrefix);
  const std::string name = path + ", its low-level policy";
  if (auto autopilot = AutopilotPolicy::Load(part, name)) return autopilot;
  return std::make_shared<const RecurrentPolicy>(LoadPolicy(std::move(part), name));
}

bool IsSamePolicy(const StoredPolicy* a, const StoredPolicy* b) {
  if (a == nullptr || b == nullptr) return a == b;
  const TensorFile one = FileOf(*a), other = FileOf(*b);
  if (one.metadata != other.metadata || one.tensors.size() != other.tensors.size()) return false;
  for (const auto& [name, tensor] : one.tensors) {
    const auto found = other.tensors.find(name);
    if (found == other.tensors.end() || !IsSame(tensor, found->second)) return false;
  }
  return true;
}

}  // namespace skein
