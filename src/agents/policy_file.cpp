// SPDX-License-Identifier: Apache-2.0
#include "src/agents/policy_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
#include "envs/vec_env.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/files/installed_file.h"
#include "src/run/require_run.h"
#include "src/run/run_directory.h"
#include "train/policy/policy_parameters.h"

namespace skein {

namespace {

/// `path`; of policies/NAME that the working directory lacks, the policy that came with the
/// program.
std::string PathOrInstalledPolicy(const std::string& path) {
  if (path.rfind(kPoliciesRoot, 0) != 0 || std::filesystem::exists(path)) return path;
  const std::string installed = InstalledFile(path);
  return installed.empty() ? path : installed;
}

/// The policy that is there and was meant by `path`, which is not: with the ending of policies, of
/// the shipped ones, or both. Empty if there is none.
std::string PolicyMeant(const std::string& path) {
  for (const std::string& meant :
       {path + ".skein", kPoliciesRoot + path, kPoliciesRoot + path + ".skein"}) {
    if (std::filesystem::is_regular_file(PathOrInstalledPolicy(meant))) return meant;
  }
  return "";
}

/// `path`, or the installed policy of its name; throws UsageError if neither is there and another
/// was meant. Whoever reads it complains of others that are not there.
std::string ExistingPolicy(const std::string& path) {
  const std::string file = PathOrInstalledPolicy(path);
  if (path == kUntrained || std::filesystem::exists(file)) return file;
  const std::string meant = PolicyMeant(path);
  if (meant.empty()) return file;
  throw UsageError(fmt::format("{}: no such file or run; did you mean {}?", path, meant));
}

}  // namespace

std::string PolicyFileOf(const std::string& path) {
  if (!std::filesystem::is_directory(path)) return ExistingPolicy(path);
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
