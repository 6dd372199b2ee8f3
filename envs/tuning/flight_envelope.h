// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "envs/reference/plant.h"
#include "envs/reference/trim.h"

namespace skein {

/// The greatest lift that the wing has, elevator neutral.
struct GreatestLift {
  double coefficient = 0, alpha_deg = 0;
};

/// At `altitude_ft` and `true_airspeed_ft_s`, with the flap on its steady schedule; alpha from 0 to
/// the end of the tables, in steps of `alpha_step_deg`.
GreatestLift FindGreatestLift(const Plant& plant, double altitude_ft, double true_airspeed_ft_s,
                              double alpha_step_deg);

/// What bounds an envelope: the aircraft's own limits.
struct EnvelopeLimits {
  double max_speed_ft_s = 0;  ///< above what thrust gives: no limit
  double max_altitude_ft = 0;
  /// The highest alpha of level flight as a fraction of the way from zero lift to greatest lift.
  double alpha_fraction = 0.62;
};

/// Steady level flight at one altitude, from the slowest to the fastest.
struct EnvelopeRow {
  double altitude_ft = 0;
  double stall_speed_ft_s = 0;
  std::vector<TrimPoint> trims;  ///< at equal distances of speed; empty: no level flight
};

struct FlightEnvelope {
  GreatestLift greatest_lift;  ///< at the lowest altitude
  double zero_lift_alpha_deg = 0;
  std::vector<EnvelopeRow> rows;  ///< from the ground up

  std::vector<TrimPoint> AllTrims() const;
};

/// Level flight at `altitudes` heights from the ground to the highest, at `speeds` speeds each:
/// with thrust that the engine has, the elevator within nine tenths of its range and alpha below
/// the limit's.
FlightEnvelope FindEnvelope(const Plant& plant, const EnvelopeLimits& limits, int altitudes,
                            int speeds);

}  // namespace skein
