// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "envs/aircraft/registry.h"
#include "envs/env_config.h"
#include "envs/policy.h"

namespace skein {

/// The task that policies below a high-level policy are trained on.
inline constexpr const char* kLowLevelTask = "control";

/// By which PolicyEnvironment says the aircraft: its name, and the hash of its content.
inline constexpr const char* kAircraftKey = "aircraft";
inline constexpr const char* kAircraftHashKey = "aircraft_hash";
/// And the numbers of a task file that policies observe and fly to (EnvConfig::task_interface).
inline constexpr const char* kTaskInterfaceKey = "task_interface";

/// What gives a policy's observations and actions their meaning (PolicyRole), by configuration key
/// less "env.", as text: what it cannot fly without. The task is not among them, nor is what may
/// well differ from training: rates, conditions, targets, rewards.
std::map<std::string, std::string> PolicyEnvironment(const EnvConfig& env);

/// The aircraft of what PolicyEnvironment gave; without a name if that does not say.
AircraftIdentity AircraftMadeWith(const std::map<std::string, std::string>& made_with);

/// Sets what a policy chooses itself (PolicyRole::kChosen) to what it was made with: the axes of
/// Tracking's target, and whether a high-level policy observes means.
void AdoptView(const std::map<std::string, std::string>& made_with, EnvConfig* env);

/// Throws ChoiceError that begins with `who` and names the first difference if a policy that was
/// made with `made_with` (PolicyEnvironment) cannot fly in `env`. What that does not say is not
/// checked: untrained policies and older files say nothing.
void CheckMadeWith(const EnvConfig& env, const std::map<std::string, std::string>& made_with,
                   const std::string& who);

/// Policy::CheckMadeFor of what flies for a high-level policy in `env`.
void CheckLowLevelMadeFor(const EnvConfig& env, const Policy& low_level, const std::string& who);

}  // namespace skein
