// SPDX-License-Identifier: Apache-2.0
#include "train/policy/low_level_file.h"

#include <utility>

#include "base/error.h"
#include "train/files/tensor_access.h"
#include "train/policy/autopilot_policy.h"
#include "train/policy/policy_parameters.h"
#include "train/policy/recurrent_policy.h"

namespace skein {
namespace {

constexpr const char* kMetadataPrefix = "controller.";
constexpr const char* kTensorPrefix = "controller/";
constexpr const char* kAutopilotKey = "autopilot";
constexpr const char* kIntervalKey = "control_interval_s";

TensorFile FileOf(const Policy& low_level) {
  TensorFile file;
  if (const auto* const autopilot = dynamic_cast<const AutopilotPolicy*>(&low_level)) {
    file.metadata[kAutopilotKey] = autopilot->variant();
    file.metadata[kIntervalKey] = ExactText(autopilot->control_interval_s());
    return file;
  }
  const auto* const policy = dynamic_cast<const RecurrentPolicy*>(&low_level);
  if (policy == nullptr) {
    throw Error(
        "a high-level policy's low-level policy must be a policy or an autopilot, to be written");
  }
  if (policy->low_level() != nullptr) {
    throw Error("a high-level policy's low-level policy must fly itself, not plan for another");
  }
  StorePolicy(*policy->parameters(), file);
  return file;
}

std::shared_ptr<const Policy> AutopilotIn(const TensorFile& part, const std::string& path) {
  const auto interval = part.metadata.find(kIntervalKey);
  // Of the environment that it flew in: whether another fits is for CheckMadeFor to say.
  EnvConfig env;
  env.control_interval_s =
      interval == part.metadata.end()
          ? 0
          : ToNumber(interval->second, path + ", its low-level policy", kIntervalKey);
  if (!(env.control_interval_s > 0)) {
    throw Error(path +
                ", its low-level policy: it does not say at which interval the autopilot flies");
  }
  return std::make_shared<const AutopilotPolicy>(part.metadata.at(kAutopilotKey), env);
}

bool IsSame(const NamedTensor& a, const NamedTensor& b) {
  return a.type == b.type && a.shape == b.shape && a.bytes == b.bytes;
}

}  // namespace

void StoreLowLevelPolicy(const Policy& low_level, TensorFile& file) {
  const TensorFile part = FileOf(low_level);
  InsertWithPrefix(part.metadata, kMetadataPrefix, file.metadata);
  InsertWithPrefix(part.tensors, kTensorPrefix, file.tensors);
}

std::shared_ptr<const Policy> LoadLowLevelPolicy(const TensorFile& file, const std::string& path) {
  TensorFile part;
  part.metadata = ExtractPrefix(file.metadata, kMetadataPrefix);
  if (part.metadata.empty()) return nullptr;
  if (part.metadata.count(kAutopilotKey) > 0) return AutopilotIn(part, path);
  part.tensors = ExtractPrefix(file.tensors, kTensorPrefix);
  return std::make_shared<const RecurrentPolicy>(LoadPolicy(part, path + ", its low-level policy"));
}

bool IsSameLowLevelPolicy(const Policy* a, const Policy* b) {
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
