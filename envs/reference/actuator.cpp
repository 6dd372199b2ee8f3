// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/actuator.h"

#include <algorithm>
#include <cmath>

namespace skein {

double ReachedShare(double bandwidth_per_s, double dt) {
  return -std::expm1(-bandwidth_per_s * dt);
}

double StepActuator(const Actuator& actuator, double position_deg, double command_deg, double dt) {
  const double target = std::clamp(command_deg, actuator.min_deg, actuator.max_deg);
  const double reached = ReachedShare(actuator.bandwidth_per_s, dt);
  const double largest = actuator.rate_limit_deg_per_s * dt;
  const double change = std::clamp((target - position_deg) * reached, -largest, largest);
  return std::clamp(position_deg + change, actuator.min_deg, actuator.max_deg);
}

}  // namespace skein
