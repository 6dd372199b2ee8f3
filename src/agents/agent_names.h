// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/config/program_config.h"
#include "train/policy/agent.h"

namespace skein {

/// Whether what is given for a policy is an agent that is none: a name, unless a file is called so.
bool IsOtherAgent(const std::string& policy);

/// Whether `name` is "autopilot" or "autopilot:VARIANT".
bool IsAutopilot(const std::string& name);
/// The variant that such a name means; "autopilot" alone is the quickest, aggressive.
std::string AutopilotVariantOf(const std::string& name);

/// The names of a list that commas separate. A policy whose path has commas is one agent if it is
/// there. Throws UsageError on an empty name.
std::vector<std::string> AgentsIn(const std::string& list);

/// The file of a policy that is called "policy:FILE_OR_RUN[@sampled][@other-aircraft]"; empty for
/// other agents. Throws UsageError on an unknown suffix of a file that is there.
std::string PolicyFileOfAgent(const std::string& name);

/// The directory of the run whose policy the agent is; empty for other agents, and for a policy
/// that is to fly another aircraft than its own. Throws as PolicyFileOfAgent.
std::string RunOfAgent(const std::string& name);

/// Whether it is a policy that may fly another aircraft than its own. Throws as PolicyFileOfAgent.
bool FliesAnyAircraft(const std::string& name);

/// The files of those runs that FilesOfPolicy names.
std::vector<std::string> FilesOfRunsOfAgents(const std::vector<std::string>& names);

/// Whether the agent of that name draws its actions at random. Throws as PolicyFileOfAgent.
bool DrawsActions(const std::string& name);

/// The files of the policies among the agents of these names.
std::vector<std::string> PolicyFilesOfAgents(const std::vector<std::string>& names);

/// The FNV hash of that file's content; nothing for other agents, as their names say all.
std::string FingerprintOfAgent(const std::string& name);

/// How an agent may be called, for people.
struct AgentForm {
  std::string name;     ///< "random[:SECONDS]"
  std::string meaning;  ///< what flies
  bool is_policy = false;
};

/// Every form of an agent's name.
std::vector<AgentForm> AgentForms();
/// Their names on one line, for help and errors.
std::string AgentNames();
/// The same of those that are no policies.
std::string OtherAgentNames();

/// The agent called `name` (AgentForms) for the environment of `config`. Throws UsageError on a
/// name of no form, and Error on a policy that cannot be read or is not made for the environment.
Agent FindAgent(const std::string& name, const ProgramConfig& config, std::uint64_t seed);

}  // namespace skein
