// SPDX-License-Identifier: Apache-2.0
#include "src/run/recorded_run.h"

#include <fmt/format.h>

#include <memory>

#include "base/error.h"
#include "envs/task_registry.h"
#include "src/config/configuration.h"
#include "train/files/tensor_file.h"
#include "train/policy/low_level_file.h"

namespace skein {
namespace {

std::shared_ptr<const StoredPolicy> LowLevelPolicyIn(const std::string& path) {
  std::shared_ptr<const StoredPolicy> policy = LoadLowLevelPolicy(TensorFile::Read(path), path);
  if (policy == nullptr) throw Error(fmt::format("{}: it holds no low-level policy", path));
  return policy;
}

}  // namespace

ProgramConfig RecordedConfig(const RunDirectory& directory) {
  ProgramConfig config = ReadRecord(directory.config());
  if (NeedsLowLevel(config.train.env)) {
    config.train.low_level = LowLevelPolicyIn(directory.low_level());
  }
  return config;
}

std::vector<std::string> DifferencesFromRecord(const ProgramConfig& recorded, ProgramConfig asked) {
  LearnerPrecision& precision = asked.train.learner.precision;
  if (precision == LearnerPrecision::kAuto) precision = recorded.train.learner.precision;
  return Differences(recorded, asked);
}

}  // namespace skein
