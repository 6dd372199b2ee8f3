#pragma once

#include <memory>

#include "envs/autopilot/gains.h"
#include "envs/env_config.h"
#include "envs/pilot.h"

namespace skein {

/// In which it is shown Tracking's target.
inline constexpr TrackingAxes kAutopilotErrorAxes = TrackingAxes::kHeading;

/// The traditional autopilot of an environment's aircraft: TECS and L1 every `outer_interval_s`
/// over dual-loop PID in every control step (ArduPilot's structure; docs/autopilot.md).
/// `config.task` chooses what it flies: "heading", "control" or "tracking". It sees what any agent
/// sees, the noisy observation. Throws Error on a task, an aircraft or a mode of flight control
/// that it has no gains for.
std::unique_ptr<Pilot> MakeAutopilot(const EnvConfig& config, AutopilotVariant variant);

/// The same with other gains, for any aircraft that load factor and roll rate command.
std::unique_ptr<Pilot> MakeAutopilot(const EnvConfig& config, const AutopilotGains& gains);

}  // namespace skein
