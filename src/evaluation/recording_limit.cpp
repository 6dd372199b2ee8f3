// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/recording_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "envs/task_registry.h"
#include "src/config/usage_error.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

/// Control steps of one flight by each of the agents.
double StepsOfAFlight(std::size_t agents, double longest_s, const EnvConfig& env) {
  return std::max(1.0, std::round(longest_s / env.control_interval_s)) *
         static_cast<double>(agents);
}

}  // namespace

double LongestFlight(const EnvConfig& env) {
  const EnvConfig flown = EvaluationConfig(env);
  if (flown.mission.enabled()) return flown.mission.flown_length_s();
  // A target that is being held when its time is up may be held to the end.
  return flown.time_limit_steps * flown.control_interval_s + MakeTask(flown)->dwell_s() +
         flown.hold_s;
}

int MostFlights(std::size_t agents, double longest_s, const EnvConfig& env) {
  return static_cast<int>(kMostRecordedSteps / StepsOfAFlight(agents, longest_s, env));
}

void RequireRoomFor(int flights, std::size_t agents, double longest_s, const EnvConfig& env,
                    const std::string& lower) {
  const double steps = flights * StepsOfAFlight(agents, longest_s, env);
  if (steps <= kMostRecordedSteps) return;
  throw UsageError(fmt::format(
      "to record {} of up to {} s by {} takes {:.0f} control steps, and {} are the most: lower {}",
      Counted(flights, "flight"), ShortestText(longest_s),
      Counted(static_cast<int>(agents), "agent"), steps, kMostRecordedSteps, lower));
}

}  // namespace skein
