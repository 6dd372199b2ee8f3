// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "envs/autopilot/gains.h"
#include "envs/env_config.h"
#include "envs/policy.h"

namespace skein {

/// In which it observes Tracking's target.
inline constexpr TrackingAxes kAutopilotErrorAxes = TrackingAxes::kHeading;

/// The classical autopilot of the F-16: TECS and L1 every `outer_interval_s` over dual-loop PID
/// in every control step (ArduPilot's structure; docs/reference/autopilot.md). `config.task`
/// chooses what it flies: "heading", "control" or "tracking". It takes what every policy takes, the
/// noisy observation. Throws Error on a task that it does not fly, another aircraft (its laws know
/// this one's units of observation and its speeds), a mode of flight control whose stick commands
/// ask for something else than load factor and roll rate, and Tracking in other axes.
std::unique_ptr<Policy> MakeAutopilot(const EnvConfig& config, AutopilotVariant variant);

/// The gains that it flies with: the variant's, and the throttle of level flight that the
/// environment's nominal aircraft is trimmed at. Throws Error as it does.
AutopilotGains GainsFor(const EnvConfig& config, AutopilotVariant variant);

/// The same with other gains.
std::unique_ptr<Policy> MakeAutopilot(const EnvConfig& config, const AutopilotGains& gains);

}  // namespace skein
