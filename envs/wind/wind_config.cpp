// SPDX-License-Identifier: Apache-2.0
#include "envs/wind/wind_config.h"

#include "base/field_list.h"

namespace skein {

void ListFields(WindConfig& config, FieldList& list) {
  // Beyond the jet stream's.
  const Bounds speed{0, 500};
  list.AddRange("speed", "fps", &config.speed_fps, speed,
                "lowest speed of the steady wind, which is horizontal",
                "highest speed of the steady wind; each episode draws its own");
  list.AddRange("from", "deg", &config.from_deg, {-360, 360},
                "where the steady wind comes from: 0 is north, 90 east",
                "the other end of that range");
  list.AddRange("turbulence", "fps", &config.turbulence_fps, speed,
                "lowest standard deviation of Dryden turbulence",
                "highest standard deviation of Dryden turbulence; each episode draws its own");
  list.Add("turbulence_by_altitude", &config.turbulence_by_altitude,
           "true: that is the standard deviation at 20,000 ft, elsewhere it is that of "
           "MIL-F-8785C; false: it is the same at every altitude")
      .OffUnless(config.turbulence_by_altitude);
  list.Add("rotational_gusts", &config.rotational_gusts,
           "true: turbulence also turns the air about the body axes, as MIL-F-8785C has it for the "
           "aircraft's span; false: it only moves it")
      .OffUnless(config.rotational_gusts);
  list.Add(
      "step_at_reset", &config.step_at_reset,
      "true: trimmed in still air, the steady wind then is a step; false: trimmed in the wind");
  list.Add("training_speed_max_fps", &config.training_speed_max_fps, speed,
           "in training the highest speed of the steady wind, if it is higher; 0: no other")
      .TrainingOnly()
      .OffUnless(config.training_speed_max_fps > 0);
  list.Add("training_turbulence_max_fps", &config.training_turbulence_max_fps, speed,
           "in training the highest standard deviation of turbulence, if it is higher; 0: no other")
      .TrainingOnly()
      .OffUnless(config.training_turbulence_max_fps > 0);
}

}  // namespace skein
