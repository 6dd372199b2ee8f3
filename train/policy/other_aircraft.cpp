// SPDX-License-Identifier: Apache-2.0
#include "train/policy/other_aircraft.h"

#include <memory>

#include "train/policy/policy_environment.h"
#include "train/policy/policy_parameters.h"

namespace skein {

RecurrentPolicy ForAnyAircraft(const RecurrentPolicy& policy) {
  auto parameters = std::make_shared<RecurrentPolicy::Parameters>(*policy.parameters());
  parameters->environment.erase(kAircraftKey);
  parameters->environment.erase(kAircraftHashKey);
  // An autopilot below says itself what it flies.
  if (const auto low_level =
          std::dynamic_pointer_cast<const RecurrentPolicy>(parameters->low_level)) {
    parameters->low_level = std::make_shared<const RecurrentPolicy>(ForAnyAircraft(*low_level));
  }
  return RecurrentPolicy(parameters, policy.backend().backend);
}

}  // namespace skein
