// SPDX-License-Identifier: Apache-2.0
#include "src/run/recorded_run.h"

#include <fmt/format.h>

#include <cstring>
#include <memory>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "envs/task_registry.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "src/files/plain_line.h"
#include "train/files/tensor_file.h"
#include "train/policy/low_level_file.h"

namespace skein {
namespace {

std::shared_ptr<const StoredPolicy> LowLevelPolicyIn(const std::string& path) {
  std::shared_ptr<const StoredPolicy> policy = LoadLowLevelPolicy(TensorFile::Read(path), path);
  if (policy == nullptr) throw Error(fmt::format("{}: it holds no low-level policy", path));
  return policy;
}

/// Before the hash, at the end of the comment.
constexpr const char* kHashMark = ", hash ";

std::string HashOfFile(const std::string& path) { return HexHash(ReadFile(path, kLargestRecord)); }

}  // namespace

ProgramConfig RecordedConfig(const RunDirectory& directory) {
  ProgramConfig config = ReadRecord(directory.config());
  if (NeedsLowLevel(config.train.env)) {
    config.train.low_level = LowLevelPolicyIn(directory.low_level());
  }
  return config;
}

std::string StartComment(const std::string& words, const std::string& networks) {
  if (networks.empty()) return "";
  return fmt::format("# {}{}{}\n", PlainLine(words), kHashMark, HashOfFile(networks));
}

bool WasStartedFrom(const RunDirectory& directory, const std::string& networks) {
  const std::string record = ReadFile(directory.config());
  const std::string line = record.substr(0, record.find('\n'));
  const std::string start = "# started from ";
  const bool has_start = line.rfind(start, 0) == 0;
  if (networks.empty() || !has_start) return networks.empty() != has_start;
  const std::size_t mark = line.rfind(kHashMark);
  if (mark != std::string::npos) {
    return line.substr(mark + std::strlen(kHashMark)) == HashOfFile(networks);
  }
  return line.rfind(start + PlainLine(networks) + " (", 0) == 0;
}

std::vector<std::string> DifferencesFromRecord(const ProgramConfig& recorded, ProgramConfig asked) {
  LearnerPrecision& precision = asked.train.learner.precision;
  if (precision == LearnerPrecision::kAuto) precision = recorded.train.learner.precision;
  return Differences(recorded, asked);
}

}  // namespace skein
