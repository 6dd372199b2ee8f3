// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

class FieldList;

/// What a high-level policy's full action asks of the low-level policy that flies
/// (envs/low_level_flight.h): changes of the present pitch, yaw and true airspeed. And what it
/// sees.
struct HighLevelConfig {
  double pitch_change_rad = 0.3;
  double yaw_change_rad = 0.3;
  double speed_change_fps = 30;
  /// A high-level policy sees the mean of what its low-level policy observed since its last policy
  /// step and of what is observed now. false: what is observed now.
  bool averages_observations = false;
};

/// Its settings (base/field_list.h).
void ListFields(HighLevelConfig& config, FieldList& list);

}  // namespace skein
