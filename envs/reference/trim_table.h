// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "envs/reference/plant.h"

namespace skein {

/// Wings-level steady flight at one altitude and speed, zero sideslip.
struct TrimmedStart {
  double alpha_rad = 0, bank_rad = 0, pitch_rad = 0;
  double elevator_deg = 0, aileron_deg = 0, rudder_deg = 0, leading_edge_flap_deg = 0;
  double power = 0;  ///< engine power, 0..100, clipped to what the engine has
  /// What the accelerometers read, g: in usual gravity nz = cos(pitch) cos(bank), ny = -cos(pitch)
  /// sin(bank).
  double nz = 0, ny = 0;
};

/// Float64 trims over altitude x speed, interpolated bilinearly: starts for many aircraft without a
/// trim each. The aircraft's asymmetric tables ask for a little bank, aileron and rudder
/// everywhere.
class TrimTable {
 public:
  /// Solves `altitude_nodes` x `speed_nodes` trims, evenly spaced over the given ranges. A range
  /// whose ends are equal has one node. Throws Error naming altitude and speed where no trim
  /// exists.
  TrimTable(const Plant& plant, double min_altitude_ft, double max_altitude_ft,
            double min_speed_ft_s, double max_speed_ft_s, int altitude_nodes = 9,
            int speed_nodes = 9);

  /// The interpolated trim; outside the ranges, that of the nearest point inside.
  TrimmedStart At(double altitude_ft, double true_airspeed_ft_s) const;

 private:
  std::vector<double> altitude_ft_, speed_ft_s_;
  std::vector<TrimmedStart> nodes_;  ///< [altitude][speed]
};

}  // namespace skein
