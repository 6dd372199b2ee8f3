// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "envs/env_config.h"
#include "envs/policy.h"

namespace skein {

/// What gives a policy's observations and actions their meaning, by configuration key less "env.",
/// as text: what it cannot fly without. The task is not among them, nor is what may well differ
/// from training: rates, conditions, targets, rewards.
std::map<std::string, std::string> PolicyEnvironment(const EnvConfig& env);

/// Shows a policy what it was made with, as far as PolicyEnvironment said it: Tracking's target in
/// its axes, and to a high-level policy means of looks or the last look.
void AdoptView(const std::map<std::string, std::string>& made_with, EnvConfig* env);

/// Throws Error that begins with `who` and names the first difference if `pilot` was made for
/// another task or environment, or if a high-level policy's low-level policy was. What it does not
/// say is not checked: untrained policies and older files say nothing. An autopilot is asked for
/// its gains; pilots of other kinds are made for what they fly.
void CheckMadeFor(const EnvConfig& env, const Policy& pilot, const std::string& who);

/// The same of a policy that was made with `made_with` (PolicyEnvironment).
void CheckMadeWith(const EnvConfig& env, const std::map<std::string, std::string>& made_with,
                   const std::string& who);

/// The same of what flies for a high-level policy in `env`.
void CheckLowLevelMadeFor(const EnvConfig& env, const Policy& low_level, const std::string& who);

}  // namespace skein
