// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "src/config/program_config.h"
#include "train/policy/agent.h"

namespace skein {

/// The file of a policy that is called "policy:FILE_OR_RUN[@sampled]"; empty for other agents.
std::string PolicyFileOfAgent(const std::string& name);

/// The forms of agents' names, for people.
std::string AgentForms();

/// The agent called `name` for the environment of `config`:
///   policy:FILE_OR_RUN   a trained policy with its mean action ("@sampled" behind: as drawn)
///   autopilot            the traditional autopilot, aggressive (as a --low-level: parallel)
///   autopilot:VARIANT    or of another AutopilotVariant
///   random, random:S     uniform commands, drawn anew every second, or every S seconds
///   idle                 every command zero
/// Throws Error that lists these on any other.
Agent FindAgent(const std::string& name, const ProgramConfig& config, std::uint64_t seed);

}  // namespace skein
