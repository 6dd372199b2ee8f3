// SPDX-License-Identifier: Apache-2.0
#include "src/agents/policy_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "base/ends_with.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "envs/vec_env.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/files/installed_file.h"
#include "src/files/plain_line.h"
#include "src/files/shell_text.h"
#include "src/run/require_run.h"
#include "src/run/run_directory.h"
#include "train/policy/policy_parameters.h"

namespace skein {
namespace {

constexpr const char* kPolicyEnding = ".skein";

/// `path`; of policies/NAME that the working directory lacks, the policy that came with the
/// program.
std::string PathOrInstalledPolicy(const std::string& path) {
  if (path.rfind(kPoliciesRoot, 0) != 0 || std::filesystem::exists(path)) return path;
  const std::string installed = InstalledFile(path);
  return installed.empty() ? path : installed;
}

bool IsFile(const std::string& path) {
  std::error_code failure;
  return std::filesystem::is_regular_file(PathOrInstalledPolicy(path), failure);
}

/// The names of the policies in `directory`, without their ending.
std::vector<std::string> PoliciesIn(const std::string& directory) {
  std::vector<std::string> names;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(directory, failure)) {
    if (entry.path().extension() == kPolicyEnding) names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

bool IsPolicyThere(const std::string& path) {
  std::error_code failure;
  return path == kUntrained || std::filesystem::exists(PathOrInstalledPolicy(path), failure);
}

std::string PolicyMeant(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const bool is_name = slash == std::string::npos;
  std::string run = fmt::format("{}/{}", kRunsRoot, path);
  if (is_name && IsRunDirectory(run)) return run;
  std::string name = is_name ? path : path.substr(slash + 1);
  if (EndsWith(name, kPolicyEnding)) name.resize(name.size() - std::strlen(kPolicyEnding));
  const std::vector<std::string> directories =
      is_name ? std::vector<std::string>{"./", kPoliciesRoot}
              : std::vector<std::string>{path.substr(0, slash + 1)};
  for (const std::string& directory : directories) {
    std::string meant = directory + name + kPolicyEnding;
    if (IsFile(meant)) return meant;
  }
  for (const std::string& directory : directories) {
    const std::string nearest = NearestName(name, PoliciesIn(directory));
    if (!nearest.empty()) return directory + nearest + kPolicyEnding;
  }
  return "";
}

std::string PolicyFileOf(const std::string& path) {
  if (!IsPolicyThere(path)) {
    const std::string meant = PolicyMeant(path);
    if (!meant.empty()) {
      throw UsageError(fmt::format("{}: no such file or run; did you mean {}?", PlainLine(path),
                                   ShellWord(PlainLine(meant))));
    }
  }
  if (!std::filesystem::is_directory(path)) return PathOrInstalledPolicy(path);
  RequireRun(path);
  const std::string checkpoints = path + "/checkpoints";
  for (const char* name : {"/policy-best.skein", "/policy-final.skein"}) {
    if (std::filesystem::exists(checkpoints + name)) return checkpoints + name;
  }
  std::string newest;
  for (const Checkpoint& checkpoint : CheckpointsIn(checkpoints)) newest = checkpoint.path;
  if (newest.empty()) throw Error(fmt::format("{}: the run has not saved a policy yet", path));
  return newest;
}

std::vector<std::string> FilesOfPolicy(const std::string& path) {
  if (path.empty() || path == kUntrained) return {};
  return IsRunDirectory(path) ? FilesOfRuns({path}) : std::vector<std::string>{PolicyFileOf(path)};
}

std::string NetworksFileOf(const std::string& path) {
  if (!IsRunDirectory(path)) return PolicyFileOf(path);
  const std::vector<Checkpoint> checkpoints = CheckpointsIn(path + "/checkpoints");
  return checkpoints.empty() ? PolicyFileOf(path) : checkpoints.back().path;
}

std::shared_ptr<const TermTaskConfig> TermTaskOf(const RecurrentPolicy& policy,
                                                 const std::string& who) {
  const std::string& text = policy.parameters()->task_file;
  if (text.empty()) return nullptr;
  return std::make_shared<const TermTaskConfig>(TermTaskIn(text, who + "'s task file"));
}

RecurrentPolicy LoadPolicy(const std::string& file, const ProgramConfig& config, std::uint64_t seed,
                           std::shared_ptr<const StoredPolicy> low_level) {
  const Backend backend = config.train.learner.backend;
  if (file != kUntrained) return RecurrentPolicy::Load(file).WithBackend(backend);
  const EnvConfig& env = config.train.env;
  const VecEnv flown(env, 1, seed, 1, low_level);
  return RecurrentPolicy::Untrained(config.train.network, flown.observation_size(),
                                    flown.action_size(), seed, env.action_repeat,
                                    std::move(low_level))
      .WithBackend(backend);
}

}  // namespace skein
