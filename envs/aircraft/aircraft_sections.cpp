// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/aircraft_sections.h"

#include "envs/aircraft/units.h"

namespace skein {
ReferenceUnits ReadUnits(Section section) {
  double altitude_error_m = 0, altitude_m = 0, speed_m_s = 0;
  section.ReadPositive("altitude_error_m", &altitude_error_m);
  section.ReadPositive("altitude_m", &altitude_m);
  section.ReadPositive("speed_m_s", &speed_m_s);
  section.Finish();
  return {altitude_error_m * kFeetPerMetre, altitude_m * kFeetPerMetre, speed_m_s * kFeetPerMetre};
}

void LeaveOutFlap(Aircraft* aircraft) {
  constexpr Actuator kNoFlap{1, 1, 0, 1};
  aircraft->airframe.leading_edge_flap_reference_deg = 1;
  aircraft->actuators.leading_edge_flap = kNoFlap;
  aircraft->flight_control.flap_alpha_gain = 0;
  aircraft->flight_control.flap_pressure_gain_deg = 0;
  aircraft->flight_control.flap_bias_deg = 0;
}

}  // namespace skein
