// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "envs/aircraft/f16.h"
#include "envs/reference/plant.h"

namespace skein {

/// tests/data/golden.json: points and trajectories of an independent implementation of the F-16.
inline nlohmann::json ReadGolden() {
  std::ifstream file(std::string(SKEIN_TEST_DATA) + "/golden.json");
  return nlohmann::json::parse(file);
}

/// The F-16 with the centre of gravity and engine of a record's "params".
inline Plant PlantOf(const nlohmann::json& params) {
  Aircraft aircraft = F16();
  aircraft.airframe.cg = params.at("xcg").get<double>();
  aircraft.airframe.engine_angular_momentum = params.at("heng").get<double>();
  return Plant(aircraft, AtmosphereModel::kStevensLewis);
}

inline RigidBodyState StateOf(const nlohmann::json& values) {
  RigidBodyState state;
  for (int i = 0; i < 13; ++i) state[i] = values.at(i).get<double>();
  return state;
}

inline Controls ControlsOf(const nlohmann::json& values) {
  Controls controls;
  controls.thrust_lbf = values.at(0).get<double>();
  controls.elevator_deg = values.at(1).get<double>();
  controls.aileron_deg = values.at(2).get<double>();
  controls.rudder_deg = values.at(3).get<double>();
  controls.leading_edge_flap_deg = values.at(4).get<double>();
  return controls;
}

}  // namespace skein
