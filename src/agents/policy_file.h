// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "src/config/program_config.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// The word that stands for freshly initialised networks in place of a policy file.
inline constexpr const char* kUntrained = "untrained";

/// Where the shipped policies lie: in the working directory, or else in the installation.
inline constexpr const char* kPoliciesRoot = "policies/";

/// Whether a file or directory is there for `path`, or it is kUntrained.
bool IsPolicyThere(const std::string& path);

/// The policy or run that was meant by `path`, where nothing is: policies/heading.skein by
/// "heading", by "policies/heading" and by "policies/heding.skein", and runs/first by "first".
/// Empty if none is near.
std::string PolicyMeant(const std::string& path);

/// The file of the policy that `path` stands for: of the directory of a run its best policy, else
/// the final one, else the newest checkpoint; of policies/NAME that is not there, the policy of
/// that name that was installed with the program; otherwise `path` itself. Throws Error on a
/// directory that holds no run, or a run that has not saved a policy yet, and UsageError if
/// nothing is there and PolicyMeant knows what was meant.
std::string PolicyFileOf(const std::string& path);

/// The files that are read of the policy that `path` stands for: those of the run, or the file of
/// PolicyFileOf. None of no path, and of kUntrained. Throws as PolicyFileOf of what is no run.
std::vector<std::string> FilesOfPolicy(const std::string& path);

/// The file whose networks training starts from if it is to start from `path`: of the directory of
/// a run its newest checkpoint, which has the critic, else what PolicyFileOf finds.
std::string NetworksFileOf(const std::string& path);

/// The task of the task file that the policy, which errors call `who`, was trained for; null if it
/// was a built-in one.
std::shared_ptr<const TermTaskConfig> TermTaskOf(const RecurrentPolicy& policy,
                                                 const std::string& who);

/// The policy in `file`, or the untrained one of `config` and `seed`, a high-level policy over
/// `low_level` if that is not null; on the backend of `config`.
RecurrentPolicy LoadPolicy(const std::string& file, const ProgramConfig& config, std::uint64_t seed,
                           std::shared_ptr<const StoredPolicy> low_level = nullptr);

}  // namespace skein
