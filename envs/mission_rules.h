// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/env_config.h"
#include "envs/tasks/episode_progress.h"
#include "envs/tasks/task.h"

namespace skein {

/// When targets count and are missed in flights of `config`.
ProgressRules RulesOf(const EnvConfig& config, const Task& task);

/// Control steps after which a target is missed, `share`, in [0, 1], of the way from the first
/// limit in training to the full one.
int TimeLimitSteps(const EnvConfig& config, double share);

/// Limits what the targets of a mission's flight that began at `start` and is at `altitude_ft` ask
/// for: none leads into the ground.
void LimitDescent(const EnvConfig& config, double altitude_ft, FlightStart* start);

/// Centres the pitch of its next target on what leads back to the altitude at which it began.
void LeadBack(double altitude_ft, FlightStart* start);

/// Makes of `start` what the next target of a mission is drawn relative to that began where
/// evaluations do, drawn from `random`, and is where this flight begins by now. Targets that are
/// points (`is_point`) stay relative to where it begins.
void JoinMission(const EnvConfig& config, bool is_point, simd::RandomStream* random,
                 FlightStart* start);

}  // namespace skein
