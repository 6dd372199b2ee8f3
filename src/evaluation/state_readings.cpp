// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/state_readings.h"

#include "envs/state/attitude.h"

namespace skein {

std::vector<Reading> StateReadings(const FlightMoment& moment) {
  const RigidBodyState& body = moment.body;
  const EulerAngles attitude = EulerFromQuaternion(body.segment<4>(kQ0));
  return {{"north_ft", body[kNorth]},
          {"east_ft", body[kEast]},
          {"altitude_ft", -body[kDown]},
          {"u_fps", body[kU]},
          {"v_fps", body[kV]},
          {"w_fps", body[kW]},
          {"roll_deg", attitude.roll * kDegPerRad},
          {"pitch_deg", attitude.pitch * kDegPerRad},
          {"yaw_deg", attitude.yaw * kDegPerRad},
          {"p_deg_s", body[kP] * kDegPerRad},
          {"q_deg_s", body[kQ] * kDegPerRad},
          {"r_deg_s", body[kR] * kDegPerRad},
          {"alpha_deg", moment.air.alpha_rad * kDegPerRad},
          {"beta_deg", moment.air.beta_rad * kDegPerRad},
          {"true_airspeed_fps", moment.air.true_airspeed_ft_s},
          {"mach", moment.air.mach},
          {"wind_north_fps", moment.wind_ft_s.x()},
          {"wind_east_fps", moment.wind_ft_s.y()},
          {"wind_down_fps", moment.wind_ft_s.z()},
          {"load_factor_g", moment.nz},
          {"lateral_load_factor_g", moment.ny},
          {"power", moment.power},
          {"elevator_deg", moment.surfaces.elevator_deg},
          {"aileron_deg", moment.surfaces.aileron_deg},
          {"rudder_deg", moment.surfaces.rudder_deg},
          {"leading_edge_flap_deg", moment.surfaces.leading_edge_flap_deg}};
}

}  // namespace skein
